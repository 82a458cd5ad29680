// SPDX-License-Identifier: Apache-2.0
#include "geometry/sweep_surface.hpp"

#include <cmath>
#include <optional>

#include "core/angles.hpp"
#include "core/pose2.hpp"

namespace homeward::geometry {
namespace {

using Hit = std::optional<Eigen::Vector2d>;

std::vector<Hit> believed_hits(const RangeSweep& sweep, const SweepFilter& filter) {
  std::vector<Hit> hits(sweep.ranges_m.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const auto range_m = static_cast<double>(sweep.ranges_m[i]);
    if (!std::isfinite(range_m) || range_m < filter.nearest_m) continue;
    if (range_m >= sweep.range_max_m || range_m > filter.farthest_m) continue;
    const double angle_rad = sweep.angle_min_rad + static_cast<double>(i) * sweep.angle_step_rad;
    hits[i] =
        position_m(sweep.robot_from_scan * Pose2{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0});
  }
  return hits;
}

bool goes_all_around(const RangeSweep& sweep) {
  return static_cast<double>(sweep.ranges_m.size() + 1) * std::abs(sweep.angle_step_rad) > 2.0 * kPi;
}

}  // namespace

std::vector<SurfacePoint> surface_of(const RangeSweep& sweep, const SweepFilter& filter) {
  const std::vector<Hit> hits = believed_hits(sweep, filter);
  const std::size_t count = hits.size();
  const bool around = goes_all_around(sweep);
  const Eigen::Vector2d scanner_m = position_m(sweep.robot_from_scan);
  const auto joined = [&](std::size_t i, std::size_t j) -> const Hit& {
    static const Hit kNone;
    if (!hits[j]) return kNone;
    const double most_m = filter.joined_m + filter.joined_per_m * (*hits[i] - scanner_m).norm();
    return (*hits[i] - *hits[j]).norm() <= most_m ? hits[j] : kNone;
  };
  std::vector<SurfacePoint> surface;
  for (std::size_t i = 0; i < count; ++i) {
    if (!hits[i]) continue;
    const bool first = i == 0 && !around;
    const bool last = i + 1 == count && !around;
    const Hit before = first ? Hit() : joined(i, (i + count - 1) % count);
    const Hit after = last ? Hit() : joined(i, (i + 1) % count);
    if (!before && !after) continue;
    const Eigen::Vector2d along = after.value_or(*hits[i]) - before.value_or(*hits[i]);
    if (along.norm() < 1e-6) continue;
    Eigen::Vector2d normal = Eigen::Vector2d(-along.y(), along.x()).normalized();
    if (normal.dot(scanner_m - *hits[i]) < 0.0) normal = -normal;
    surface.push_back({*hits[i], normal});
  }
  return surface;
}

}  // namespace homeward::geometry
