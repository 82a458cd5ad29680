// SPDX-License-Identifier: Apache-2.0
#include "geometry/match_rows.hpp"

#include <numbers>

#include "geometry/match_row_loops.hpp"
#include "geometry/tilted_motion.hpp"

namespace homeward::geometry {
namespace {

namespace loops = match_row_loops;

loops::Nine nine(const Eigen::Matrix3d& e) {
  return {e(0, 0), e(0, 1), e(0, 2), e(1, 0), e(1, 1), e(1, 2), e(2, 0), e(2, 1), e(2, 2)};
}

loops::Rows pointers(const std::array<std::vector<double>, 9>& rows, std::size_t count) {
  return {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data(), rows[4].data(),
          rows[5].data(), rows[6].data(), rows[7].data(), rows[8].data(), count};
}

}  // namespace

MatchRows::MatchRows(std::span<const Correspondence> matches) : matches_(matches) {
  for (std::vector<double>& row : rows_) row.resize(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Correspondence& match = matches[i];
    for (std::size_t k = 0; k < 3; ++k) {
      rows_[k][i] = match.current[static_cast<Eigen::Index>(k)];
      rows_[3 + k][i] = match.target[static_cast<Eigen::Index>(k)];
    }
    rows_[6][i] = match.log_scale_ratio;
    rows_[7][i] = match.odds;
    rows_[8][i] = match.log_scale_ratio == 0.0 ? 0.0 : 1.0;
  }
}

void MatchRows::errors(const EpipolarError& of, std::vector<double>& into) const {
  into.resize(size());
  const loops::Rows r = pointers(rows_, size());
  const loops::Nine e = nine(of.essential());
  loops::errors(r, e, into.data());
}

void MatchRows::errors_and_slopes(const EpipolarError& of, std::vector<double>& errors,
                                  std::vector<double>& slopes) const {
  errors.resize(size());
  slopes.resize(5 * size());
  const loops::Rows r = pointers(rows_, size());
  const loops::Nine e = nine(of.essential());
  loops::Slopes s{};
  for (std::size_t angle = 0; angle < s.size(); ++angle) {
    for (std::size_t k = 0; k < 9; ++k) {
      s[angle][k] = of.slopes()(static_cast<Eigen::Index>(angle), static_cast<Eigen::Index>(k));
    }
  }
  loops::errors_and_slopes(r, e, s, errors.data(), slopes.data());
}

void MatchRows::chances(const EpipolarError& of, double window_rad, double least, std::vector<double>& into) const {
  into.resize(size());
  const loops::Rows r = pointers(rows_, size());
  const loops::Nine e = nine(of.essential());
  // Both bearings share the error, so that the distance of one to its line may be sqrt(2) times as large.
  const double window = window_rad * std::numbers::sqrt2;
  loops::chances(r, e, window, least, into.data());
}

void MatchRows::judge(const Gaze& gaze, Seen& seen) const {
  for (auto* row : {&seen.share, &seen.belief, &seen.gain, &seen.pull, &seen.telling}) row->resize(size());
  const loops::Rows r = pointers(rows_, size());
  const Eigen::Vector3d& here = gaze.direction_in_current;
  const Eigen::Vector3d& there = gaze.direction_in_target;
  const loops::GazeNumbers g{
      {here.x(), here.y(), here.z()}, {there.x(), there.y(), there.z()}, gaze.spread_rad, gaze.share};
  const loops::SeenNumbers s{seen.error_rad.data(), seen.chance.data(), seen.possible.data(), seen.share.data(),
                             seen.belief.data(),    seen.gain.data(),   seen.pull.data(),     seen.telling.data()};
  loops::judge(r, g, s);
}

}  // namespace homeward::geometry
