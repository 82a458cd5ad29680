// SPDX-License-Identifier: Apache-2.0
#include "scenario/heading_only.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "matching/match.hpp"

namespace homeward::scenario {
namespace {

constexpr double kBin_rad = 0.03;
constexpr int kFewest = 8;  // matches that agree

/// By how much features are turned counter-clockwise against those of another picture: what most matches agree on.
std::optional<double> shift_rad(const features::Appearance& before, const features::Appearance& now) {
  std::vector<double> shifts_rad;
  for (const matching::Match& match : matching::match(now.sift, before.sift, {})) {
    shifts_rad.push_back(
        wrap_angle(features::azimuth_rad(now.sift, match.current) - features::azimuth_rad(before.sift, match.target)));
  }
  double best_sum_rad = 0.0;
  int best = 0;
  for (const double centre_rad : shifts_rad) {
    double sum_rad = 0.0;
    int count = 0;
    for (const double other_rad : shifts_rad) {
      if (std::abs(other_rad - centre_rad) > kBin_rad) continue;
      sum_rad += other_rad;
      ++count;
    }
    if (count <= best) continue;
    best = count;
    best_sum_rad = sum_rad;
  }
  return best >= kFewest ? std::optional(best_sum_rad / best) : std::nullopt;
}

}  // namespace

HeadingOnly::HeadingOnly(std::vector<ShownPicture> shown, const pipeline::Eye& eye, std::size_t begin, std::size_t end)
    : shown_(std::move(shown)), eye_(eye), end_(end), here_(begin), taught_from_robot_(shown_[begin].odometry) {}

/// By odometry, and on to the picture that was taken about there; what is left beside the way is forgotten.
void HeadingOnly::go_on(const Pose2& odometry) {
  constexpr double kMetresPerRad = 0.5;
  constexpr std::size_t kLook = 20;
  if (latest_) taught_from_robot_ = taught_from_robot_ * (inverse(*latest_) * odometry);
  latest_ = odometry;
  double least = 1e9;
  const std::size_t first = here_;
  for (std::size_t i = first; i < std::min(shown_.size(), first + kLook); ++i) {
    const Pose2 there = inverse(taught_from_robot_) * shown_[i].odometry;
    const double off = std::hypot(there.x_m, there.y_m, kMetresPerRad * there.theta_rad);
    if (off >= least) continue;
    least = off;
    here_ = i;
  }
  const Pose2 beside = inverse(shown_[here_].odometry) * taught_from_robot_;
  taught_from_robot_ = shown_[here_].odometry * Pose2{beside.x_m, 0.0, beside.theta_rad};
}

Result<driving::PathSight> HeadingOnly::see(const Image& picture, driving::Milliseconds taken_ms,
                                            const Pose2& odometry) {
  constexpr double kAhead_m = 2.5;
  go_on(odometry);
  const auto seen = eye_.look(picture);
  if (!seen) return pass_on(seen);
  // Features that lie farther to the left than they did: the robot is turned to the right.
  if (const auto turned_rad = shift_rad(shown_[here_].appearance, *seen)) {
    taught_from_robot_.theta_rad = wrap_angle(shown_[here_].odometry.theta_rad - *turned_rad);
  }
  driving::PathSight sight;
  sight.taken_ms = taken_ms;
  sight.odometry = odometry;
  sight.lost = false;
  sight.confidence = 1.0;
  double length_m = 0.0;
  for (std::size_t i = std::min(here_, end_); i <= end_ && length_m <= kAhead_m; ++i) {
    const Pose2 there = inverse(taught_from_robot_) * shown_[i].odometry;
    if (!sight.way.empty()) length_m += (position_m(there) - position_m(sight.way.back())).norm();
    sight.way.push_back(there);
    sight.ends = i == end_;
  }
  return sight;
}

}  // namespace homeward::scenario
