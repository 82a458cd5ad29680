// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/pose2.hpp"
#include "sim/box.hpp"
#include "sim/people.hpp"
#include "sim/ray_scene.hpp"

namespace homeward::sim {

struct LaserConfig {
  std::vector<double> heights_m = {0.3};  // of its layers; a ray's range is the shortest of them
  double range_max_m = 12.0;
  double noise_m = 0.01;
  int rays = 360;  // ray i points 2 pi i / rays counter-clockwise from forward
};

/// Ranges of one sweep at a robot pose, metres; infinity where nothing stands within range. People and
/// boxes are seen.
std::vector<float> scan(const RayScene& rays, const Pose2& robot, const std::vector<Person>& people,
                        const LaserConfig& config, std::uint64_t noise_seed, const std::vector<Box>& boxes = {});

}  // namespace homeward::sim
