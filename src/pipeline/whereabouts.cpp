// SPDX-License-Identifier: Apache-2.0
#include "pipeline/whereabouts.hpp"

#include <cmath>

#include "core/angles.hpp"

namespace homeward::pipeline {
namespace {

// docs/experiments/drafts_by_replay.md
constexpr double kLaidOut_m = 0.5;    // how well the layout knows where a spot lies from another some metres away
constexpr double kToldApart_m = 1.5;  // from here on the layout knows in which direction
constexpr double kDirectionOff_rad = kPi / 4.0;
constexpr double kAside_m = 0.3;  // what hides a spot is so wide to both sides of it, and so far before it
constexpr double kBefore_m = 0.2;
constexpr double kHalfFree_m = 0.2;  // of a strip that sweeps saw free

}  // namespace

Whereabouts::Whereabouts(const map::TopologicalMap& map, std::span<const mapping::TourSweep> sweeps)
    : layout_(map::metric_layout(map)), floor_(sweeps, layout_) {}

std::optional<Pose2> Whereabouts::seen_from(const ImageId& a, const ImageId& b) const {
  const auto first = layout_.find(a);
  const auto second = layout_.find(b);
  if (first == layout_.end() || second == layout_.end()) return std::nullopt;
  if (first->second.component != second->second.component) return std::nullopt;
  if (!first->second.metric || !second->second.metric) return std::nullopt;
  return inverse(first->second.map_from_robot) * second->second.map_from_robot;
}

std::optional<double> Whereabouts::apart_m(const ImageId& a, const ImageId& b) const {
  const auto seen = seen_from(a, b);
  return seen ? std::optional(std::hypot(seen->x_m, seen->y_m)) : std::nullopt;
}

bool Whereabouts::may_be(const ImageId& a, const ImageId& b, double direction_rad, double turn_rad) const {
  const auto seen = seen_from(a, b);
  if (!seen) return true;
  if (std::abs(wrap_angle(turn_rad - seen->theta_rad)) > kDirectionOff_rad) return false;
  const double away_m = std::hypot(seen->x_m, seen->y_m);
  const double off_rad = std::abs(wrap_angle(direction_rad - std::atan2(seen->y_m, seen->x_m)));
  return away_m < kToldApart_m || off_rad <= kDirectionOff_rad + std::atan2(kLaidOut_m, away_m);
}

bool Whereabouts::parted(const ImageId& a, const ImageId& b) const {
  return floor_.hides(a, b, kAside_m, kBefore_m) && floor_.hides(b, a, kAside_m, kBefore_m);
}

bool Whereabouts::free_between(const ImageId& a, const ImageId& b) const {
  const auto away_m = apart_m(a, b);
  if (!away_m) return false;
  const map::LaidOutImage& from = layout_.at(a);
  const map::LaidOutImage& to = layout_.at(b);
  const double within_m = 0.5 * *away_m + kHalfFree_m;  // sweeps from between the two
  return floor_
      .strip(from.component, position_m(from.map_from_robot), position_m(to.map_from_robot), kHalfFree_m, within_m)
      .free;
}

}  // namespace homeward::pipeline
