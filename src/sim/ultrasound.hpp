// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "raycast/ray_scene.hpp"
#include "sim/box.hpp"
#include "sim/people.hpp"

namespace homeward::sim {

/// A ring of ultrasound sensors in a body's outline. Each tells how near the nearest thing in its cone is.
struct UltrasoundConfig {
  std::vector<double> heights_m;  // of the rays that a cone is made of, like a laser's layers
  int sensors = 16;
  double cone_rad = 0.5236;  // 30 degrees
  int rays = 9;              // across a cone
  double range_min_m = 0.2;  // what is nearer reads as this
  double range_max_m = 3.0;
  double noise_m = 0.01;
};

/// Where they are on the robot, looking outwards: so far inside of the outline that what touches the body is just as
/// far as they can measure.
std::vector<Pose2> ultrasound_ring(const Outline& outline, const UltrasoundConfig& config);

/// Their readings at a robot pose, metres; infinity where nothing is within range. People are seen.
std::vector<float> ultrasound(const raycast::RayScene& rays, const Pose2& robot, const std::vector<Pose2>& ring,
                              const std::vector<Person>& people, const UltrasoundConfig& config,
                              std::uint64_t noise_seed, const std::vector<Box>& boxes = {});

}  // namespace homeward::sim
