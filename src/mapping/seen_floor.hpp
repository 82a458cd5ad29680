// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "map/metric_layout.hpp"

namespace homeward::mapping {

/// What a range sensor saw where a picture was taken.
struct TourSweep {
  ImageId image;
  RangeSweep sweep;
};

/// A straight strip of floor as sweeps saw it.
struct SeenStrip {
  double clear_m = 0.0;  // width without a hit, the line in its middle; at most kWidest_m
  bool free = false;     // all of the wanted width was seen, and nothing in it
};

/// The floor as the sweeps of tours saw it, put where the map's layout has their pictures. What no ray passed is
/// unknown, and unknown is not free; a ray that came back with nothing says nothing.
/// What rays show to be free: Moravec & Elfes, High resolution maps from wide angle sonar (1985), here without a grid.
class SeenFloor {
 public:
  static constexpr double kWidest_m = 3.0;

  /// Sweeps of pictures that the layout does not have, or not in metres, are left out.
  SeenFloor(std::span<const TourSweep> sweeps, const map::MetricLayout& layout);

  /// The strip from one point of a component of the layout to another, `half_m` on each side of the line and beyond
  /// both ends, by the sweeps taken within `within_m` of its middle.
  [[nodiscard]] SeenStrip strip(int component, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
                                double half_m, double within_m) const;

  /// How well the sweeps of two pictures agree about where things stand, with the pictures where the layout has them:
  /// of what the second one's hits and the first one could see, the share that stands where the first saw it, and not
  /// where it saw past it. Nothing where one of them has no sweep, or less than `least_hits` of the first's are seen.
  [[nodiscard]] std::optional<double> agreement(const ImageId& first, const ImageId& second, int least_hits) const;

  /// Whether something stands before the spot of the second picture: every ray of the first one's sweep that passes
  /// within `aside_m` of that spot ended `before_m` and more before it. False where nobody can tell.
  [[nodiscard]] bool hides(const ImageId& first, const ImageId& second, double aside_m, double before_m) const;

 private:
  struct Placed {
    ImageId image;
    int component = 0;
    Pose2 map_from_scan;
    double angle_min_rad = 0.0;
    double angle_step_rad = 0.0;
    std::vector<double> ranges_m;           // infinity: nothing came back
    std::vector<Eigen::Vector2d> hits_map;  // metres
  };
  [[nodiscard]] const Placed* find(const ImageId& image) const;
  static bool sees_free(const Placed& sweep, const Eigen::Vector2d& point_m);

  std::vector<Placed> sweeps_;
};

}  // namespace homeward::mapping
