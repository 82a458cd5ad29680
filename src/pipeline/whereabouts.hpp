// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"
#include "mapping/seen_floor.hpp"

namespace homeward::pipeline {

/// Where the pictures of a map were taken, by its metric layout, and what their sweeps saw between them. Ours.
class Whereabouts {
 public:
  Whereabouts(const map::TopologicalMap& map, std::span<const mapping::TourSweep> sweeps);

  /// Of the spots of two pictures. Nothing where the map cannot tell.
  [[nodiscard]] std::optional<double> apart_m(const ImageId& a, const ImageId& b) const;

  /// Whether the motion that two pictures tell, `b` seen from `a`, may be that between their spots. Of rooms that look
  /// alike it is not. True where the map cannot tell.
  [[nodiscard]] bool may_be(const ImageId& a, const ImageId& b, double direction_rad, double turn_rad) const;

  /// Whether something stands between two spots, as wide as a door and seen from both. False without sweeps.
  [[nodiscard]] bool parted(const ImageId& a, const ImageId& b) const;

  /// Whether sweeps saw that nothing stands along the line between two spots. False without sweeps.
  [[nodiscard]] bool free_between(const ImageId& a, const ImageId& b) const;

 private:
  [[nodiscard]] std::optional<Pose2> seen_from(const ImageId& a, const ImageId& b) const;

  map::MetricLayout layout_;
  mapping::SeenFloor floor_;
};

}  // namespace homeward::pipeline
