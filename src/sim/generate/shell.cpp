// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

using Eigen::Vector3d;

constexpr double kSill_m = 0.9;
constexpr double kWindowTop_m = 2.15;
constexpr double kRailBottom_m = 0.76;
constexpr double kRailTop_m = 0.88;
constexpr double kRailDeep_m = 0.05;
constexpr double kLiningDeep_m = kHalfWall_m + 0.015;  // from the wall's middle
constexpr double kLeaf_m = 0.85;
constexpr double kHalfLeaf_m = 0.02;  // of its thickness

/// A rectangle of wall from x0 to x1 and z0 to z1, `y` in front of the wall's plane. Looks into the room.
void wall_piece(SceneBuilder& scene, const Pose2& frame, double x0, double x1, double z0, double z1, Surface surface,
                double y = 0.0) {
  if (x1 - x0 < 1e-6 || z1 - z0 < 1e-6) return;
  scene.quad(frame, {Vector3d(x1, y, z1), {x0, y, z1}, {x0, y, z0}, {x1, y, z0}}, surface);
}

struct Hole {
  double from_m;
  double to_m;
  double sill_m;
  double top_m;
};

std::vector<Hole> holes_of(const Space& space, Side side, const std::vector<Doorway>& doorways) {
  std::vector<Hole> holes;
  for (const Doorway& doorway : doorways) {
    for (const auto& [from, to] : openings_of(space, side, {doorway}))
      holes.push_back({from, to, doorway.sill_m, doorway.height_m});
  }
  for (const WindowOpening& window : space.windows) {
    if (window.side != side) continue;
    holes.push_back(
        {window.centre_m - 0.5 * window.width_m, window.centre_m + 0.5 * window.width_m, kSill_m, kWindowTop_m});
  }
  std::sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.from_m < b.from_m; });
  return holes;
}

void build_wall(SceneBuilder& scene, const Space& space, Side side, const std::vector<Doorway>& doorways,
                Surface skirting) {
  const WallFrame wall = wall_frame(space, side);
  double done_m = 0.0;
  const auto rail = [&](double from_m, double to_m) {
    if (!space.rail || to_m - from_m < 1e-6) return;
    // Front and top: rails are long, light is gathered at every 0.3 m of them, and nobody looks from below.
    wall_piece(scene, wall.frame, from_m, to_m, kRailBottom_m, kRailTop_m, *space.rail, kRailDeep_m);
    scene.quad(wall.frame,
               {Vector3d(to_m, 0.0, kRailTop_m),
                {from_m, 0.0, kRailTop_m},
                {from_m, kRailDeep_m, kRailTop_m},
                {to_m, kRailDeep_m, kRailTop_m}},
               *space.rail);
  };
  const auto solid = [&](double from_m, double to_m) {
    wall_piece(scene, wall.frame, from_m, to_m, 0.0, kCeiling_m, space.wall);
    wall_piece(scene, wall.frame, from_m, to_m, 0.0, 0.11, skirting, 0.012);
    rail(from_m, to_m);
  };
  for (const Hole& hole : holes_of(space, side, doorways)) {
    solid(done_m, hole.from_m);
    wall_piece(scene, wall.frame, hole.from_m, hole.to_m, hole.top_m, kCeiling_m, space.wall);
    wall_piece(scene, wall.frame, hole.from_m, hole.to_m, 0.0, hole.sill_m, space.wall);
    if (hole.sill_m >= kRailTop_m) rail(hole.from_m, hole.to_m);
    done_m = hole.to_m;
  }
  solid(done_m, wall.length_m);
}

void build_window(SceneBuilder& scene, const Space& space, const WindowOpening& window, Random& random) {
  const WallFrame wall = wall_frame(space, window.side);
  const double x0 = window.centre_m - 0.5 * window.width_m;
  const double x1 = window.centre_m + 0.5 * window.width_m;
  const int pane = scene.add_material("window", paint_window(random), MaterialRole::kWindow);
  wall_piece(scene, wall.frame, x0, x1, kSill_m, kWindowTop_m, {pane, 0.0}, -0.08);
  const Surface frame{scene.add_material("window frame", paint_wood(random, {225, 222, 215})), 0.8};
  scene.box(wall.frame, {x0 - 0.06, -0.08, kSill_m - 0.05}, {x1 + 0.06, 0.14, kSill_m}, {frame, frame});
  scene.box(wall.frame, {x0 - 0.06, -0.08, kWindowTop_m}, {x1 + 0.06, 0.02, kWindowTop_m + 0.06}, {frame, frame});
  scene.box(wall.frame, {x0 - 0.06, -0.08, kSill_m}, {x0, 0.02, kWindowTop_m}, {frame, frame});
  scene.box(wall.frame, {x1, -0.08, kSill_m}, {x1 + 0.06, 0.02, kWindowTop_m}, {frame, frame});
  const Surface curtain{
      scene.add_material("curtain", paint_fabric(random, rich_colour(random), static_cast<Weave>(1 + pick(random, 3)))),
      0.6};
  constexpr double kCurtain_m = 0.32;
  constexpr double kBeforeSill_m = 0.16;
  if (window.curtains_drawn) {
    scene.box(wall.frame, {x0 - kCurtain_m, kBeforeSill_m, 0.72}, {x1 + kCurtain_m, kBeforeSill_m + 0.05, 2.35},
              {curtain, curtain});
  } else {
    scene.box(wall.frame, {x0 - kCurtain_m, 0.03, 0.75}, {x0, 0.08, 2.35}, {curtain, curtain});
    scene.box(wall.frame, {x1, 0.03, 0.75}, {x1 + kCurtain_m, 0.08, 2.35}, {curtain, curtain});
  }
  const Surface radiator{scene.add_material("radiator", paint_cabinet(random, {215, 215, 212}, 8, 1)), 0.0};
  scene.box(wall.frame, {x0 + 0.2, 0.02, 0.15}, {x1 - 0.2, 0.1, 0.7}, {radiator, radiator});
}

Surface lining_of(SceneBuilder& scene, Random& random) {
  return {scene.add_material("lining", paint_wood(random, {190, 170, 140})), 0.7};
}

Surface leaf_of(SceneBuilder& scene, Random& random) {
  return {scene.add_material("door", paint_door(random, varied(random, {185, 160, 125}, 40))), 0.0};
}

/// The sill of a glazed panel, its bars every 0.7 m or so and one across.
void build_bars(SceneBuilder& scene, const Pose2& frame, const Doorway& panel, Surface wood) {
  const double half = 0.5 * panel.width_m;
  constexpr double kBar_m = 0.02;  // half of one
  scene.box(frame, {-half - 0.07, -kLiningDeep_m, panel.sill_m - 0.05}, {half + 0.07, kLiningDeep_m, panel.sill_m},
            {wood, wood});
  const int panes = std::max(2, static_cast<int>(std::lround(panel.width_m / 0.7)));
  for (int bar = 1; bar < panes; ++bar) {
    const double x = -half + panel.width_m * bar / panes;
    scene.box(frame, {x - kBar_m, -kBar_m, panel.sill_m}, {x + kBar_m, kBar_m, panel.height_m}, {wood, wood});
  }
  const double across_m = panel.height_m - 0.3;
  scene.box(frame, {-half, -kBar_m, across_m - kBar_m}, {half, kBar_m, across_m + kBar_m}, {wood, wood});
}

}  // namespace

WallFrame wall_frame(const Space& space, Side side) {
  const double x0 = space.least_m.x() + kHalfWall_m;
  const double y0 = space.least_m.y() + kHalfWall_m;
  const double x1 = space.most_m.x() - kHalfWall_m;
  const double y1 = space.most_m.y() - kHalfWall_m;
  constexpr double kPi = std::numbers::pi;
  switch (side) {
    case Side::kSouth:
      return {{x0, y0, 0.0}, x1 - x0};
    case Side::kEast:
      return {{x1, y0, 0.5 * kPi}, y1 - y0};
    case Side::kNorth:
      return {{x1, y1, kPi}, x1 - x0};
    case Side::kWest:
      return {{x0, y1, -0.5 * kPi}, y1 - y0};
  }
  return {};
}

std::vector<std::pair<double, double>> openings_of(const Space& space, Side side,
                                                   const std::vector<Doorway>& doorways) {
  const WallFrame wall = wall_frame(space, side);
  const bool along_x = side == Side::kSouth || side == Side::kNorth;
  std::vector<std::pair<double, double>> openings;
  for (const Doorway& doorway : doorways) {
    if (doorway.in_x_wall != along_x) continue;
    const Pose2 here = inverse(wall.frame) * Pose2{doorway.centre_m.x(), doorway.centre_m.y(), 0.0};
    if (std::abs(here.y_m) > 0.2 || here.x_m < 0.0 || here.x_m > wall.length_m) continue;
    openings.emplace_back(here.x_m - 0.5 * doorway.width_m, here.x_m + 0.5 * doorway.width_m);
  }
  return openings;
}

void build_shell(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways, Random& random) {
  const double x0 = space.least_m.x();
  const double y0 = space.least_m.y();
  const double x1 = space.most_m.x();
  const double y1 = space.most_m.y();
  std::array<Vector3d, 4> floor = {Vector3d(x0, y1, 0), {x1, y1, 0}, {x1, y0, 0}, {x0, y0, 0}};
  std::array<Vector3d, 4> ceiling = {
      Vector3d(x0, y0, kCeiling_m), {x1, y0, kCeiling_m}, {x1, y1, kCeiling_m}, {x0, y1, kCeiling_m}};
  if (space.turned) {
    std::ranges::rotate(floor, floor.begin() + 2);
    std::ranges::rotate(ceiling, ceiling.begin() + 2);
  }
  scene.quad({}, floor, space.floor);
  scene.quad({}, ceiling, space.ceiling);
  const Surface skirting{scene.add_material("skirting", paint_wood(random, {205, 195, 180})), 1.0};
  for (const Side side : {Side::kSouth, Side::kEast, Side::kNorth, Side::kWest}) {
    build_wall(scene, space, side, doorways, skirting);
  }
  for (const WindowOpening& window : space.windows) build_window(scene, space, window, random);
}

std::vector<DoorOpening> build_linings(SceneBuilder& scene, const std::vector<Doorway>& doorways, Random& random) {
  std::vector<DoorOpening> openings;
  for (const Doorway& doorway : doorways) {
    const Surface wood = lining_of(scene, random);
    Pose2 frame{doorway.centre_m.x(), doorway.centre_m.y(), doorway.in_x_wall ? 0.0 : 0.5 * std::numbers::pi};
    if (doorway.turned) frame.theta_rad += std::numbers::pi;
    const double half = 0.5 * doorway.width_m;
    const double foot = doorway.sill_m;
    constexpr double kDeep_m = kLiningDeep_m;
    scene.box(frame, {-half - 0.07, -kDeep_m, foot}, {-half, kDeep_m, doorway.height_m + 0.07}, {wood, wood});
    scene.box(frame, {half, -kDeep_m, foot}, {half + 0.07, kDeep_m, doorway.height_m + 0.07}, {wood, wood});
    scene.box(frame, {-half, -kDeep_m, doorway.height_m}, {half, kDeep_m, doorway.height_m + 0.07}, {wood, wood});
    if (foot > 0.0) build_bars(scene, frame, doorway, wood);
    if (foot == 0.0) openings.push_back({frame, doorway.width_m, doorway.height_m, scene.triangles(), 0});
    if (!doorway.leaf) continue;
    // The leaf stands open against the wall, on the side that the frame's +y points to.
    const Surface door = leaf_of(scene, random);
    scene.box(frame, {half + 0.08, kDeep_m + 0.01, 0.01}, {half + 0.08 + kLeaf_m, kDeep_m + 0.05, 2.05}, {door, door});
    if (foot == 0.0) openings.back().count = scene.triangles() - openings.back().first;
  }
  return openings;
}

std::vector<DoorOpening> build_like_shells(SceneBuilder& scene, const std::vector<Space>& spaces,
                                           const std::vector<Doorway>& doorways, std::uint64_t seed) {
  std::vector<DoorOpening> openings;
  for (const Space& space : spaces) {
    Random same(seed * 13 + 1);  // the same windows, curtains and skirting everywhere
    build_shell(scene, space, doorways, same);
  }
  for (const Doorway& doorway : doorways) {
    Random same(seed * 17 + 2);
    const std::vector<DoorOpening> built = build_linings(scene, {doorway}, same);
    openings.insert(openings.end(), built.begin(), built.end());
  }
  return openings;
}

void build_shut_door(SceneBuilder& scene, const Pose2& frame, Random& random) {
  const Surface wood = lining_of(scene, random);
  const Surface door = leaf_of(scene, random);
  constexpr double kHalf_m = 0.5 * kLeaf_m;
  constexpr double kTop_m = 2.05;
  // In front of the rail, which so ends at the door.
  scene.box(frame, {-kHalf_m, 0.0, 0.0}, {kHalf_m, kRailDeep_m + 0.01, kTop_m}, {door, door});
  scene.box(frame, {-kHalf_m - 0.07, 0.0, 0.0}, {-kHalf_m, kRailDeep_m + 0.025, kTop_m + 0.07}, {wood, wood});
  scene.box(frame, {kHalf_m, 0.0, 0.0}, {kHalf_m + 0.07, kRailDeep_m + 0.025, kTop_m + 0.07}, {wood, wood});
  scene.box(frame, {-kHalf_m, 0.0, kTop_m}, {kHalf_m, kRailDeep_m + 0.025, kTop_m + 0.07}, {wood, wood});
}

void build_leaf(SceneBuilder& scene, const DoorOpening& door, Random& random) {
  const Surface leaf = leaf_of(scene, random);
  const double half = 0.5 * door.width_m;
  scene.box(door.frame, {-half, -kHalfLeaf_m, 0.01}, {half, kHalfLeaf_m, door.height_m}, {leaf, leaf});
}

Lamp build_lamp(SceneBuilder& scene, const Eigen::Vector2d& position_m, double strength, Random& random) {
  const int shade = scene.add_material("lamp", std::array<float, 3>{0.95F, 0.9F, 0.8F}, MaterialRole::kLamp);
  const Pose2 frame{position_m.x(), position_m.y(), 0.0};
  const double radius_m = uniform(random, 0.14, 0.2);
  scene.cylinder(frame, {0, 0, kCeiling_m - 0.16}, radius_m, 0.12, {shade, 0.0});
  return {{position_m.x(), position_m.y(), kCeiling_m - 0.3}, strength};
}

}  // namespace homeward::sim
