// SPDX-License-Identifier: Apache-2.0
#include "repeat/known_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.hpp"
#include "geometry/triangulation.hpp"
#include "repeat/arc_pose.hpp"

namespace homeward::repeat {
namespace {

constexpr double kWorstLogKnown = 0.5;  // of the logarithm of a distance: beyond, it is not known
constexpr double kLeastLogKnown = 0.02;
constexpr double kSeenSpread_px = 0.5;
constexpr double kMostOff = 3.0;  // of one point's log likelihood

double radians_per_px(const geometry::SeenPoint& seen) { return seen.bearing_per_px.norm() / std::sqrt(2.0); }

/// How long the way is in units of the structure: what most points say.
std::optional<double> length_of(std::span<const KnownPair> seen, const geometry::ViewMotion& motion) {
  std::vector<double> logs;
  for (const KnownPair& one : seen) {
    const auto rays = geometry::triangulate(motion, one.pair.current.bearing, one.pair.target.bearing);
    if (rays.nearness > 0.0 && rays.from_target > 0.0) logs.push_back(std::log(rays.nearness / one.landmark.nearness));
  }
  if (2 * logs.size() < seen.size()) return std::nullopt;
  return std::exp(median(std::move(logs)));
}

double log_likelihood_at(std::span<const KnownPair> seen, const ArcPose& pose) {
  double sum = 0.0;
  for (const KnownPair& one : seen) {
    const Expected expected = expected_at(pose, one.landmark);
    const double off_px = geometry::offset_px(one.pair.target, expected.bearing).norm();
    const double open_px = expected.spread_rad / radians_per_px(one.pair.target);
    const double variance = kSeenSpread_px * kSeenSpread_px + open_px * open_px;
    const double off = 0.5 * off_px * off_px / variance;
    sum -= std::isfinite(off) ? std::min(off, kMostOff) : kMostOff;
  }
  return sum;
}

}  // namespace

KnownStructure KnownStructure::of(const map::PathArc& arc) {
  KnownStructure known;
  if (!arc.has_baseline || is_doubtful(arc)) return known;
  for (const map::ArcMatch& match : arc.matches) {
    if (!(match.to_nearness > 0.0) || !(match.distance_spread < kWorstLogKnown)) continue;
    Landmark landmark;
    landmark.feature = match.feature;
    landmark.bearing = match.to_bearing;
    landmark.nearness = match.to_nearness;
    landmark.nearness_spread = match.to_nearness * std::max(match.distance_spread, kLeastLogKnown);
    landmark.has_distance = true;
    known.landmarks_.push_back(landmark);
  }
  std::ranges::sort(known.landmarks_, {}, &Landmark::feature);
  return known;
}

const Landmark* KnownStructure::landmark(int feature) const {
  const auto found = std::ranges::lower_bound(landmarks_, feature, {}, &Landmark::feature);
  return found != landmarks_.end() && found->feature == feature ? &*found : nullptr;
}

std::optional<geometry::ViewMotion> motion_by_structure(std::span<const KnownPair> seen,
                                                        std::span<const geometry::ViewMotion> starts) {
  if (seen.empty()) return std::nullopt;
  ArcSurroundings around;
  std::vector<double> nearnesses;
  std::vector<SeenLandmark> landmarks;
  for (const KnownPair& one : seen) {
    nearnesses.push_back(one.landmark.nearness);
    landmarks.push_back({one.landmark, one.pair.target});
  }
  around.nearness = median(std::move(nearnesses));
  PoseFitConfig config;
  config.driving = geometry::DrivingPrior{};
  std::optional<PoseFit> best;
  for (const geometry::ViewMotion& start : starts) {
    PoseFit fit = fit_pose(landmarks, around, {start.current_from_target, Eigen::Vector3d::Zero()}, config);
    if (!best || fit.agreeing > best->agreeing) best = std::move(fit);
  }
  const double way = best ? best->pose.position.norm() : 0.0;
  if (!(way > 0.0) || 2 * best->agreeing < static_cast<int>(seen.size())) return std::nullopt;
  return geometry::ViewMotion{best->pose.local_from_current, best->pose.position / way};
}

double structure_log_likelihood(std::span<const KnownPair> seen, const geometry::ViewMotion& motion) {
  constexpr std::array<double, 5> kAbout{0.85, 0.95, 1.0, 1.05, 1.15};
  const auto length = length_of(seen, motion);
  if (!length) return -kMostOff * static_cast<double>(seen.size());
  double best = -kMostOff * static_cast<double>(seen.size());
  for (const double share : kAbout) {
    const Eigen::Vector3d position = share * *length * motion.target_in_current;
    best = std::max(best, log_likelihood_at(seen, {motion.current_from_target, position}));
  }
  return best;
}

}  // namespace homeward::repeat
