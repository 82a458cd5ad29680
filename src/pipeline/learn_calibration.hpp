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
Result<map::BeliefCalibration> learn_calibration(const map::TopologicalMap& map,
                                                 std::span<const features::Appearance> appearances,
                                                 std::span<const int> tour_of, int threads,
                                                 const std::function<void(double)>& progress,
                                                 const std::stop_token& stop);

}  // namespace homeward::pipeline
