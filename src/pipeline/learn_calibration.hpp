// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// How sure a belief in this map may be: the tours' own pictures, prototypes left out, are localised in short runs
/// from a uniform start, and it is counted how often the answer is the picture's place or a neighbour of it. Long tours
/// are sampled. Odometry counts where a tour has it, as it will when a robot has it. `appearances`, `tour_of`: of
/// map.images. The answer does not depend on `threads`. Errors: kCancelled.
/// The function: localisation/calibration.hpp (Platt 1999); to learn it on the tour itself is ours.
Result<map::BeliefCalibration> learn_calibration(const map::TopologicalMap& map,
                                                 std::span<const features::Appearance> appearances,
                                                 std::span<const int> tour_of, int threads,
                                                 const std::function<void(double)>& progress,
                                                 const std::stop_token& stop);

/// The same for a map that new tours joined: `appearances` and `tour_of` are of its last images, those of the new
/// tours; the older ones are gone. What they told is map.calibration. They count as many as they were, with beliefs
/// like those that the new pictures hold, and right as often as the old calibration says of such beliefs.
Result<map::BeliefCalibration> relearn_calibration(const map::TopologicalMap& map,
                                                   std::span<const features::Appearance> appearances,
                                                   std::span<const int> tour_of, int threads,
                                                   const std::function<void(double)>& progress,
                                                   const std::stop_token& stop);

}  // namespace homeward::pipeline
