// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"

namespace homeward::map {

/// Where a person says that a picture was taken, on a drawn plan of the building. Kept by its picture, so that it
/// outlives a rebuild of the map.
struct PlanPin {
  ImageId image;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  // frame of the plan
  std::optional<double> theta_rad;  // where the robot faced, from +x of the plan; nothing: not said
};

/// Where a place lies on the plan.
struct PlacedOnPlan {
  PlaceId place;
  Pose2 plan_from_robot;             // of a robot that stands where the prototype was taken
  bool pinned = false;               // a pin says so; else the layout of the map
  std::optional<double> residual_m;  // how far the layout would have a pinned place from there
};

/// A map on a plan.
struct MapOnPlan {
  std::vector<PlacedOnPlan> places;                // in the order of the map
  std::vector<PlaceId> unplaced;                   // of parts of the map with too few pins
  std::vector<std::optional<PlaceId>> pin_places;  // which place has the picture of each pin; nothing: none any more
  std::optional<double> rms_m;                     // root mean square of what pins are off; nothing: nothing is placed
};

/// Lays a map onto a plan: each part of its layout is turned and shifted, as a whole, to where its pins are off least
/// by squares (K. S. Arun, T. S. Huang, S. D. Blostein, "Least-squares fitting of two 3-D point sets", 1987, in the
/// plane). A heading that is off by a radian counts like a metre (ours). A part that odometry did not measure is also
/// scaled (S. Umeyama, 1991), as its lengths are guesses. Needs in each part two pins half a metre apart, or a heading;
/// a place with a pin lies where that says, and the others beside it stay where the whole has them.
MapOnPlan lay_on_plan(const TopologicalMap& map, const MetricLayout& layout, const std::vector<PlanPin>& pins);

/// Whether a person may have meant these pins. Errors, each with the field `where` of the pins or of one of them:
/// kNotFound (no place has the picture), kInvalidInput (fewer than two places, a place pinned twice, no part of the map
/// with two pins half a metre apart, pins that the layout fits only as in a mirror).
Status check_pins(const TopologicalMap& map, const MetricLayout& layout, const std::vector<PlanPin>& pins,
                  const std::string& where);

}  // namespace homeward::map
