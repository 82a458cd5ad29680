// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "sim/light.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// The light that comes from a sky: linear radiance, red, green, blue; 1: what lights white paper white by day.
struct SkyLight {
  std::array<float, 3> zenith{};
  std::array<float, 3> horizon{};
  std::array<float, 3> sun{};     // added where one looks at the sun, less and less about it
  std::array<float, 3> to_sun{};  // unit vector, world frame
};

/// What a ray of this direction (unit vector, world frame) that meets nothing brings; below the horizon what the
/// horizon does.
Eigen::Array3f radiance(const SkyLight& sky, const Eigen::Vector3f& direction);

/// How much daylight a light leaves outside, 0 to 1.
float daylight_in(const Light& light);

/// A sky in so much daylight: blue by day, warm above the horizon at dusk, nearly black at night.
SkyLight sky_light(const Sky& sky, float daylight);

}  // namespace homeward::sim
