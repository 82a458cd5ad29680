// SPDX-License-Identifier: Apache-2.0
#include "mapping/seen_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/angles.hpp"

namespace homeward::mapping {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_to_line(const Eigen::Vector2d& point_m, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const Eigen::Vector2d line_m = to_m - from_m;
  const double along = line_m.squaredNorm() > 1e-12 ? (point_m - from_m).dot(line_m) / line_m.squaredNorm() : 0.0;
  return (from_m + std::clamp(along, 0.0, 1.0) * line_m - point_m).norm();
}

/// The ranges of the two rays beside a direction in the scanner's frame; nothing where it does not look.
std::optional<std::pair<double, double>> ranges_beside(const std::vector<double>& ranges_m, double angle_min_rad,
                                                       double angle_step_rad, double angle_rad) {
  const auto rays = static_cast<double>(ranges_m.size());
  const double whole = 2.0 * kPi / std::abs(angle_step_rad);
  double ray = (angle_rad - angle_min_rad) / angle_step_rad;
  ray -= whole * std::floor(ray / whole);
  const bool all_around = rays + 1e-6 >= std::floor(whole);
  if (ray >= rays - 1.0 && !(all_around && ray < rays + 1e-6)) return std::nullopt;
  const auto low = std::min(static_cast<std::size_t>(ray), ranges_m.size() - 1);
  return std::pair(ranges_m[low], ranges_m[(low + 1) % ranges_m.size()]);
}

}  // namespace

SeenFloor::SeenFloor(std::span<const TourSweep> sweeps, const map::MetricLayout& layout) {
  for (const TourSweep& taken : sweeps) {
    const auto at = layout.find(taken.image);
    const RangeSweep& sweep = taken.sweep;
    if (at == layout.end() || !at->second.metric || sweep.ranges_m.size() < 2 || sweep.angle_step_rad == 0.0) continue;
    Placed placed;
    placed.image = taken.image;
    placed.component = at->second.component;
    placed.map_from_scan = at->second.map_from_robot * sweep.robot_from_scan;
    placed.angle_min_rad = sweep.angle_min_rad;
    placed.angle_step_rad = sweep.angle_step_rad;
    for (std::size_t i = 0; i < sweep.ranges_m.size(); ++i) {
      const auto range_m = static_cast<double>(sweep.ranges_m[i]);
      const bool hit = std::isfinite(range_m) && range_m > 0.0 && range_m < sweep.range_max_m;
      placed.ranges_m.push_back(hit ? range_m : kInfinity);
      if (!hit) continue;
      const double angle_rad = sweep.angle_min_rad + static_cast<double>(i) * sweep.angle_step_rad;
      placed.hits_map.push_back(
          position_m(placed.map_from_scan * Pose2{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0}));
    }
    sweeps_.push_back(std::move(placed));
  }
}

const SeenFloor::Placed* SeenFloor::find(const ImageId& image) const {
  const auto found = std::ranges::find(sweeps_, image, &Placed::image);
  return found == sweeps_.end() ? nullptr : &*found;
}

/// Whether both rays beside a point went on beyond it.
bool SeenFloor::sees_free(const Placed& sweep, const Eigen::Vector2d& point_m) {
  constexpr double kBeyond_m = 0.05;
  constexpr double kOwnBody_m = 0.3;  // where the robot itself stood
  const Pose2 seen = inverse(sweep.map_from_scan) * Pose2{point_m.x(), point_m.y(), 0.0};
  const double distance_m = std::hypot(seen.x_m, seen.y_m);
  if (distance_m < kOwnBody_m) return true;
  const auto ranges_m =
      ranges_beside(sweep.ranges_m, sweep.angle_min_rad, sweep.angle_step_rad, std::atan2(seen.y_m, seen.x_m));
  if (!ranges_m || !std::isfinite(ranges_m->first) || !std::isfinite(ranges_m->second)) return false;
  return std::min(ranges_m->first, ranges_m->second) > distance_m + kBeyond_m;
}

SeenStrip SeenFloor::strip(int component, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double half_m,
                           double within_m) const {
  constexpr double kStep_m = 0.1;
  const Eigen::Vector2d middle_m = 0.5 * (from_m + to_m);
  std::vector<const Placed*> near;
  double nearest_m = 0.5 * kWidest_m;
  for (const Placed& sweep : sweeps_) {
    if (sweep.component != component || (position_m(sweep.map_from_scan) - middle_m).norm() > within_m) continue;
    near.push_back(&sweep);
    for (const Eigen::Vector2d& hit_m : sweep.hits_map)
      nearest_m = std::min(nearest_m, distance_to_line(hit_m, from_m, to_m));
  }
  SeenStrip seen;
  seen.clear_m = near.empty() ? 0.0 : 2.0 * nearest_m;
  if (near.empty() || nearest_m < half_m) return seen;
  const double length_m = (to_m - from_m).norm();
  const Eigen::Vector2d ahead =
      length_m > 1e-9 ? Eigen::Vector2d((to_m - from_m) / length_m) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  const int along = static_cast<int>(std::ceil((length_m + 2.0 * half_m) / kStep_m));
  const int across = static_cast<int>(std::ceil(2.0 * half_m / kStep_m));
  for (int i = 0; i <= along; ++i) {
    const double ahead_m = -half_m + (length_m + 2.0 * half_m) * i / along;
    for (int j = 0; j <= across; ++j) {
      const double aside_m = -half_m + 2.0 * half_m * j / across;
      const Eigen::Vector2d point_m = from_m + ahead_m * ahead + aside_m * aside;
      if (distance_to_line(point_m, from_m, to_m) > half_m) continue;  // its ends are round, as the body is
      if (std::ranges::none_of(near, [&](const Placed* sweep) { return sees_free(*sweep, point_m); })) return seen;
    }
  }
  seen.free = true;
  return seen;
}

std::optional<double> SeenFloor::agreement(const ImageId& first, const ImageId& second, int least_hits) const {
  constexpr double kSame_m = 0.15;
  const Placed* one = find(first);
  const Placed* other = find(second);
  if (one == nullptr || other == nullptr || one->component != other->component) return std::nullopt;
  int same = 0;
  int seen_past = 0;
  const Pose2 one_from_map = inverse(one->map_from_scan);
  for (const Eigen::Vector2d& hit_m : other->hits_map) {
    const Pose2 hit = one_from_map * Pose2{hit_m.x(), hit_m.y(), 0.0};
    const double distance_m = std::hypot(hit.x_m, hit.y_m);
    const auto ranges_m =
        ranges_beside(one->ranges_m, one->angle_min_rad, one->angle_step_rad, std::atan2(hit.y_m, hit.x_m));
    if (!ranges_m || !std::isfinite(ranges_m->first) || !std::isfinite(ranges_m->second)) continue;
    const auto [near_m, far_m] = std::minmax(ranges_m->first, ranges_m->second);
    if (near_m - kSame_m <= distance_m && distance_m <= far_m + kSame_m) ++same;
    if (distance_m < near_m - kSame_m) ++seen_past;
  }
  if (same + seen_past < least_hits) return std::nullopt;
  return static_cast<double>(same) / static_cast<double>(same + seen_past);
}

bool SeenFloor::hides(const ImageId& first, const ImageId& second, double aside_m, double before_m) const {
  const Placed* one = find(first);
  const Placed* other = find(second);
  if (one == nullptr || other == nullptr || one->component != other->component) return false;
  const Pose2 spot = inverse(one->map_from_scan) * other->map_from_scan;
  const double distance_m = std::hypot(spot.x_m, spot.y_m);
  const double towards_rad = std::atan2(spot.y_m, spot.x_m);
  int towards = 0;
  for (std::size_t i = 0; i < one->ranges_m.size(); ++i) {
    const double off_rad = wrap_angle(one->angle_min_rad + static_cast<double>(i) * one->angle_step_rad - towards_rad);
    if (std::cos(off_rad) <= 0.0 || std::abs(distance_m * std::sin(off_rad)) > aside_m) continue;
    ++towards;
    if (!(one->ranges_m[i] < distance_m - before_m)) return false;
  }
  return towards > 0;
}

}  // namespace homeward::mapping
