// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/floor.hpp"
#include "sim/generate/builder.hpp"
#include "sim/scene.hpp"

namespace homeward::testing {

/// A room from (-2, -1.5) to (2, 1.5), 2.5 m high: red ahead (+x), green on the left (+y), blue behind, yellow on the
/// right; grey floor and ceiling, a lamp in the middle. With `wall` a half wall at x = 0 leaves the passage y < 0.
inline sim::World box_world(bool wall = false) {
  constexpr double kX_m = 2.0;
  constexpr double kY_m = 1.5;
  constexpr double kUp_m = 2.5;
  sim::SceneBuilder scene;
  const auto paint = [&](const char* name, std::array<float, 3> colour) {
    return sim::Surface{scene.add_material(name, colour), 0.0};
  };
  const sim::Surface red = paint("red", {0.8F, 0.05F, 0.05F});
  const sim::Surface green = paint("green", {0.05F, 0.7F, 0.05F});
  const sim::Surface blue = paint("blue", {0.05F, 0.05F, 0.8F});
  const sim::Surface yellow = paint("yellow", {0.7F, 0.7F, 0.05F});
  const sim::Surface grey = paint("grey", {0.5F, 0.5F, 0.5F});
  // Corners clockwise from the upper left as seen from inside.
  scene.quad({}, {{{kX_m, kY_m, kUp_m}, {kX_m, -kY_m, kUp_m}, {kX_m, -kY_m, 0.0}, {kX_m, kY_m, 0.0}}}, red);
  scene.quad({}, {{{-kX_m, kY_m, kUp_m}, {kX_m, kY_m, kUp_m}, {kX_m, kY_m, 0.0}, {-kX_m, kY_m, 0.0}}}, green);
  scene.quad({}, {{{-kX_m, -kY_m, kUp_m}, {-kX_m, kY_m, kUp_m}, {-kX_m, kY_m, 0.0}, {-kX_m, -kY_m, 0.0}}}, blue);
  scene.quad({}, {{{kX_m, -kY_m, kUp_m}, {-kX_m, -kY_m, kUp_m}, {-kX_m, -kY_m, 0.0}, {kX_m, -kY_m, 0.0}}}, yellow);
  scene.quad({}, {{{-kX_m, kY_m, 0.0}, {kX_m, kY_m, 0.0}, {kX_m, -kY_m, 0.0}, {-kX_m, -kY_m, 0.0}}}, grey);
  scene.quad({}, {{{kX_m, kY_m, kUp_m}, {-kX_m, kY_m, kUp_m}, {-kX_m, -kY_m, kUp_m}, {kX_m, -kY_m, kUp_m}}}, grey);
  if (wall) scene.box({}, {-0.05, 0.0, 0.0}, {0.05, kY_m, kUp_m}, {grey, grey});
  sim::World world;
  world.name = "box";
  world.scene = scene.take();
  world.start = {-1.0, 0.7, 0.0};
  world.rooms = {{"west", -1.0, 0.7, {{-kX_m, -kY_m}, {0.0, -kY_m}, {0.0, kY_m}, {-kX_m, kY_m}}},
                 {"east", 1.0, 0.7, {{0.0, -kY_m}, {kX_m, -kY_m}, {kX_m, kY_m}, {0.0, kY_m}}}};
  world.lamps = {{{0.0, -0.3, 2.3}, 1.0}};
  world.occupied = sim::occupied_cells(world.scene, 0.05);
  world.drivable = sim::drivable_cells(world.occupied, 0.35, world.start);
  return world;
}

}  // namespace homeward::testing
