// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/street_things.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/painting.hpp"
#include "sim/generate/painting_outdoors.hpp"

namespace homeward::sim {
namespace {

using Eigen::Vector3d;

constexpr double kDrawnIn_m = 0.01;

enum class SidePiece { kHouse, kHedge, kWall, kFence, kBay };
enum class StreetThing { kTree, kBench, kPlanter, kStall, kSign, kBin, kPostBox, kColumn, kCrates };

template <class T>
const T& one_of(const std::vector<T>& all, Random& random) {
  return all[static_cast<std::size_t>(pick(random, static_cast<int>(all.size())))];
}

void build_house(const FramedBoxes& at, const Facade& front, const StreetMaterials& of, Random& random) {
  const double half = 0.5 * front.width_m;
  const double top = front.height_m;
  constexpr double kDeep_m = 4.0;
  at.scene.quad(at.frame, {Vector3d(half, 0.0, top), {-half, 0.0, top}, {-half, 0.0, 0.0}, {half, 0.0, 0.0}},
                {front.material, 0.0});
  // At a street's corner one piece's end would lie in the front of the next: it is drawn in a little.
  for (const double x : {-half + kDrawnIn_m, half - kDrawnIn_m}) {
    at.scene.quad(at.frame, {Vector3d(x, -kDeep_m, top), {x, 0.0, top}, {x, 0.0, 0.0}, {x, -kDeep_m, 0.0}}, of.bricks);
  }
  at.box(-half, half, -0.3, 0.3, top, top + 0.2, of.stone);
  at.scene.quad(at.frame,
                {Vector3d(half, -kDeep_m, top + 2.2),
                 {-half, -kDeep_m, top + 2.2},
                 {-half, 0.3, top + 0.2},
                 {half, 0.3, top + 0.2}},
                of.red);
  // Some of its windows are lit when it is dark.
  const int columns = std::max(1, static_cast<int>(front.width_m / 1.9));
  for (int i = 0; i < columns; ++i) {
    if (pick(random, 3) != 0) continue;
    const double x = half - (i + 0.5) * front.width_m / columns;
    constexpr double kMiddle_m = 4.5;
    at.box(x - 0.4, x + 0.4, 0.0, 0.01, kMiddle_m - 0.6, kMiddle_m + 0.6, {one_of(of.lit_windows, random), 0.0},
           of.stone);
  }
}

void build_fence(const FramedBoxes& at, double length_m, const StreetMaterials& of) {
  const double half = 0.5 * length_m;
  for (const double z : {0.15, 0.6, 1.05}) at.box(-half, half, -0.06, -0.02, z, z + 0.09, of.wood);
  const int posts = std::max(2, static_cast<int>(length_m / 0.45));
  for (int i = 0; i <= posts; ++i) {
    const double x = -half + length_m * i / posts;
    at.box(std::max(-half, x - 0.05), std::min(half, x + 0.05), -0.02, 0.0, 0.0, 1.2, of.wood);
  }
}

void build_bay(const FramedBoxes& at, double length_m, const StreetMaterials& of, Random& random) {
  const double half = 0.5 * length_m;
  at.box(-half, half, -2.9, -2.2, 0.0, 1.5, one_of(of.leaves, random));
  for (const double x : {-half, half - 0.2}) at.box(x, x + 0.2, -2.2, 0.0, 0.0, 1.1, of.bricks);
  const Surface side{one_of(of.cars, random), 0.0};
  const Surface glass{side.material, 1.5};
  at.box(-2.0, 2.0, -1.9, -0.25, 0.25, 0.95, side);
  at.box(-1.3, 1.2, -1.75, -0.4, 0.95, 1.45, glass, of.steel);
}

double length_of(SidePiece piece, const Facade& front, Random& random) {
  switch (piece) {
    case SidePiece::kHouse:
      return front.width_m;
    case SidePiece::kBay:
      return 5.2;
    default:
      return uniform(random, 3.0, 6.0);
  }
}

void build(SidePiece piece, const FramedBoxes& at, double length_m, const Facade& front, const StreetMaterials& of,
           Random& random) {
  const double half = 0.5 * length_m - kDrawnIn_m;
  const double high = uniform(random, 1.1, 2.0);
  switch (piece) {
    case SidePiece::kHouse:
      return build_house(at, {front.material, length_m, front.height_m}, of, random);
    case SidePiece::kHedge:
      at.box(-half, half, -0.9, 0.0, 0.0, high, one_of(of.leaves, random));
      break;
    case SidePiece::kWall:
      at.box(-half, half, -0.25, -0.02, 0.0, high, of.bricks);
      at.box(-half, half, -0.3, 0.0, high, high + 0.08, of.stone);
      break;
    case SidePiece::kFence:
      build_fence(at, 2.0 * half, of);
      break;
    case SidePiece::kBay:
      build_bay(at, 2.0 * half, of, random);
      break;
  }
  const double behind_m = piece == SidePiece::kBay ? -4.2 : -2.4;
  for (double x = -half + 1.2; x < half; x += uniform(random, 2.6, 4.2)) {
    build_tree(at.scene, at.frame * Pose2{x, behind_m + uniform(random, -0.6, 0.6), 0.0}, uniform(random, 3.6, 6.0), of,
               random);
  }
}

double width_of(StreetThing thing) {
  switch (thing) {
    case StreetThing::kBench:
    case StreetThing::kStall:
      return 1.9;
    case StreetThing::kTree:
    case StreetThing::kColumn:
    case StreetThing::kCrates:
      return 1.0;
    default:
      return 0.7;
  }
}

double depth_of(StreetThing thing) {
  switch (thing) {
    case StreetThing::kTree:
      return 0.7;
    case StreetThing::kBench:
      return 0.65;
    case StreetThing::kStall:
    case StreetThing::kColumn:
      return 0.95;
    default:
      return 0.6;
  }
}

void build_bench(const FramedBoxes& at, const StreetMaterials& of) {
  for (const double x : {-0.75, 0.65}) at.box(x, x + 0.1, 0.12, 0.55, 0.0, 0.42, of.stone);
  for (const double y : {0.12, 0.28, 0.44}) at.box(-0.85, 0.85, y, y + 0.12, 0.42, 0.46, of.wood);
  for (const double z : {0.58, 0.76}) at.box(-0.85, 0.85, 0.08, 0.12, z, z + 0.12, of.wood);
}

void build_stall(const FramedBoxes& at, const StreetMaterials& of, Random& random) {
  at.box(-0.85, 0.85, 0.1, 0.85, 0.75, 0.82, of.wood);
  at.box(-0.85, 0.85, 0.14, 0.8, 0.05, 0.75, one_of(of.cloths, random));
  for (const double x : {-0.85, 0.79}) at.box(x, x + 0.06, 0.1, 0.16, 0.0, 2.2, of.wood);
  at.box(-0.95, 0.95, 0.05, 0.95, 2.2, 2.26, one_of(of.cloths, random));
  at.box(-0.95, 0.95, 0.93, 0.95, 2.0, 2.2, one_of(of.cloths, random));
  for (int crate = 0; crate < 4; ++crate) {
    const double x = -0.75 + 0.4 * crate;
    at.box(x, x + 0.32, 0.2, 0.7, 0.82, 0.82 + uniform(random, 0.12, 0.25), one_of(of.leaves, random), of.wood);
  }
}

void build_sign(const FramedBoxes& at, const StreetMaterials& of, Random& random) {
  at.scene.cylinder(at.frame, {0.0, 0.25, 0.0}, 0.04, 2.3, of.steel);
  at.box(-0.3, 0.3, 0.29, 0.31, 1.5, 2.2, {one_of(of.notices, random), 0.0}, of.steel);
  at.box(-0.25, 0.25, 0.29, 0.31, 1.05, 1.4, {one_of(of.notices, random), 0.0}, of.steel);
}

void build(StreetThing thing, const FramedBoxes& at, const StreetMaterials& of, Random& random) {
  switch (thing) {
    case StreetThing::kTree:
      return build_tree(at.scene, at.frame * Pose2{0.0, 0.42, 0.0}, uniform(random, 3.6, 5.2), of, random);
    case StreetThing::kBench:
      return build_bench(at, of);
    case StreetThing::kPlanter:
      at.box(-0.28, 0.28, 0.05, 0.55, 0.0, 0.5, of.stone);
      at.box(-0.22, 0.22, 0.1, 0.5, 0.5, uniform(random, 0.8, 1.3), one_of(of.leaves, random));
      return;
    case StreetThing::kStall:
      return build_stall(at, of, random);
    case StreetThing::kSign:
      return build_sign(at, of, random);
    case StreetThing::kBin:
      return at.scene.cylinder(at.frame, {0.0, 0.3, 0.0}, 0.22, 0.95, one_of(of.cloths, random));
    case StreetThing::kPostBox:
      at.box(-0.05, 0.05, 0.2, 0.3, 0.0, 0.7, of.steel);
      at.box(-0.22, 0.22, 0.1, 0.42, 0.7, 1.3, {one_of(of.notices, random), 0.0}, of.red);
      return;
    case StreetThing::kColumn:
      at.scene.cylinder(at.frame, {0.0, 0.5, 0.0}, 0.4, 0.5, of.stone);
      at.scene.cylinder(at.frame, {0.0, 0.5, 0.5}, 0.38, 1.9, {one_of(of.notices, random), 0.0});
      return;
    case StreetThing::kCrates:
      for (int crate = 0; crate < 3; ++crate) {
        const double z = 0.36 * crate;
        at.box(-0.35 + 0.08 * crate, 0.3, 0.08, 0.5, z, z + 0.34, {one_of(of.notices, random), 0.0}, of.wood);
      }
      return;
  }
}

}  // namespace

StreetMaterials street_materials(SceneBuilder& scene, Random& random) {
  constexpr std::array<Rgb, 7> kWalls = {{{176, 96, 72},
                                          {206, 190, 158},
                                          {188, 170, 150},
                                          {168, 120, 92},
                                          {196, 198, 190},
                                          {210, 168, 120},
                                          {150, 158, 166}}};
  constexpr int kFacades = 12;
  StreetMaterials of;
  for (int i = 0; i < kFacades; ++i) {
    const Rgb wall = varied(random, kWalls[static_cast<std::size_t>(i) % kWalls.size()], 14);
    const double width_m = uniform(random, 5.5, 8.5);
    const double height_m = uniform(random, 6.2, 9.2);
    of.facades.push_back(
        {scene.add_material("facade", paint_facade(random, width_m, height_m, wall)), width_m, height_m});
  }
  for (int i = 0; i < 3; ++i)
    of.lit_windows.push_back(scene.add_material("lit window", paint_lit_window(random), MaterialRole::kLamp));
  for (int i = 0; i < 8; ++i)
    of.notices.push_back(scene.add_material("notice", pick(random, 2) == 0
                                                          ? paint_picture(random)
                                                          : paint_notes(random, scaled(rich_colour(random), 1.3))));
  for (int i = 0; i < 4; ++i) of.cars.push_back(scene.add_material("car", paint_car(random)));
  for (int i = 0; i < 3; ++i) of.leaves.push_back({scene.add_material("leaves", paint_leaves(random)), 0.9});
  for (const Weave weave : {Weave::kStripes, Weave::kChecks, Weave::kFlowers})
    of.cloths.push_back({scene.add_material("cloth", paint_fabric(random, rich_colour(random), weave)), 0.6});
  of.bricks = {scene.add_material("bricks", paint_bricks(random, varied(random, {168, 92, 70}, 18))), 1.5};
  of.bark = {scene.add_material("bark", paint_bark(random)), 0.0};
  of.wood = {scene.add_material("wood", paint_wood(random, varied(random, {132, 98, 66}, 20))), 0.8};
  of.steel = {scene.add_material("steel", std::array<float, 3>{0.2F, 0.22F, 0.24F}), 0.0};
  of.red = {scene.add_material("red", paint_bricks(random, {170, 60, 44})), 2.0};
  of.stone = {scene.add_material("stone", paint_slabs(random, {176, 172, 162})), 1.2};
  of.lamp = scene.add_material("lamp", std::array<float, 3>{0.95F, 0.9F, 0.8F}, MaterialRole::kLamp);
  return of;
}

void build_tree(SceneBuilder& scene, const Pose2& frame, double height_m, const StreetMaterials& of, Random& random) {
  constexpr double kTrunk_m = 2.1;
  scene.cylinder(frame, {0.0, 0.0, 0.0}, uniform(random, 0.11, 0.17), kTrunk_m + 0.3, of.bark);
  const Surface leaves = one_of(of.leaves, random);
  constexpr int kTufts = 7;
  for (int tuft = 0; tuft < kTufts; ++tuft) {
    const double share = (tuft + 0.5) / kTufts;
    const double reach_m = 0.75 * std::sin(std::numbers::pi * (0.15 + 0.8 * share));
    const Pose2 at = frame * Pose2{uniform(random, -reach_m, reach_m), uniform(random, -reach_m, reach_m),
                                   uniform(random, 0.0, std::numbers::pi)};
    const double half = uniform(random, 0.4, 0.7);
    const double z = kTrunk_m + share * (height_m - kTrunk_m - 0.6);
    scene.box(at, {-half, -half, z - 0.1}, {half, half, z + half}, {leaves, leaves});
  }
}

Lamp build_lamp_post(SceneBuilder& scene, const Pose2& frame, const StreetMaterials& of) {
  constexpr double kHigh_m = 3.6;
  scene.cylinder(frame, {0.0, 0.0, 0.0}, 0.06, kHigh_m, of.steel);
  // Narrow: the shade must not hide its own lamp, of which the last 15 cm are open.
  scene.cylinder(frame, {0.0, 0.0, kHigh_m}, 0.1, 0.25, {of.lamp, 0.0});
  scene.cylinder(frame, {0.0, 0.0, kHigh_m + 0.25}, 0.15, 0.06, of.steel);
  return {{frame.x_m, frame.y_m, kHigh_m + 0.1}, 1.0};
}

void build_street_side(SceneBuilder& scene, const Pose2& frame, double length_m, int houses, const StreetMaterials& of,
                       Random& random) {
  using enum SidePiece;
  constexpr std::array kOthers = {kHedge, kWall, kFence, kBay, kHedge};
  constexpr double kShortest_m = 2.4;
  double at_m = 0.0;
  while (length_m - at_m > 1e-6) {
    const double left_m = length_m - at_m;
    const Facade& front = one_of(of.facades, random);
    SidePiece piece =
        pick(random, 10) < houses ? kHouse : kOthers[static_cast<std::size_t>(pick(random, kOthers.size()))];
    double wide_m = length_of(piece, front, random);
    // What is left over is a hedge; nothing shorter than that remains.
    if (wide_m + kShortest_m > left_m) {
      if (wide_m > left_m || piece == kBay) piece = kHedge;
      if (piece != kHouse) wide_m = left_m;
    }
    build(piece, {scene, frame * Pose2{at_m + 0.5 * wide_m, 0.0, 0.0}}, wide_m, front, of, random);
    at_m += wide_m;
  }
}

void dress_street_side(SceneBuilder& scene, const Pose2& frame, double length_m, double deep_m,
                       const StreetMaterials& of, Random& random) {
  using enum StreetThing;
  constexpr std::array kThings = {kTree, kBench, kPlanter, kStall, kSign, kBin, kPostBox, kColumn, kCrates, kPlanter};
  constexpr double kFromEnds_m = 1.4;
  for (double at_m = kFromEnds_m; at_m < length_m - kFromEnds_m;) {
    const StreetThing thing = kThings[static_cast<std::size_t>(pick(random, kThings.size()))];
    const double wide_m = width_of(thing);
    const bool fits = depth_of(thing) <= deep_m && at_m + wide_m < length_m - kFromEnds_m;
    if (fits) build(thing, {scene, frame * Pose2{at_m + 0.5 * wide_m, 0.0, 0.0}}, of, random);
    at_m += fits ? wide_m + uniform(random, 0.5, 2.4) : 0.7;
  }
}

}  // namespace homeward::sim
