// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "sim/people.hpp"
#include "sim/tour_path.hpp"

namespace homeward::sim {

/// How long whoever leads a tour takes from one of its poses to the next, seconds: at 0.5 m/s along the straight way
/// or, where that takes longer, turning at 0.8 rad/s; at least 0.1 s. Ours, a constant walking pace.
double tour_seconds(const Pose2& from, const Pose2& to);

/// Who is about when a picture of a tour is taken.
struct TourMoment {
  double seconds = 0.0;  // since the picture before; 0 of the first
  std::vector<Person> people;
};

/// So many people stroll while a tour is driven, and keep clear of the robot, a disc of 0.35 m radius: a moment for
/// each stop. The tour keeps to its way and waits while the next piece of it would lead nearer than 0.65 m to somebody.
/// Where somebody is cornered and cannot make room within a minute, other people are drawn for the whole tour. Ours.
/// Errors: kConflict where that happens to twenty draws.
Result<std::vector<TourMoment>> people_along(const World& world, const std::vector<TourStop>& stops, int count,
                                             std::uint64_t seed);

}  // namespace homeward::sim
