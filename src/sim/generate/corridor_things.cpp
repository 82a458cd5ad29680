// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/corridor_things.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

enum class Thing {
  kDoor,
  kPicture,
  kPictures,
  kBoard,
  kRadiator,
  kExtinguisher,
  kCoats,
  kPoster,
  kBench,
  kPiece,
  kPlant
};

/// One thing in the making, in the frame of its place at the wall.
struct Place : FramedBoxes {
  const CorridorMaterials& of;
  Random& random;

  [[nodiscard]] int one_of(const std::vector<int>& materials) const {
    return materials[static_cast<std::size_t>(pick(random, static_cast<int>(materials.size())))];
  }
  [[nodiscard]] Surface one_of(const std::vector<Surface>& surfaces) const {
    return surfaces[static_cast<std::size_t>(pick(random, static_cast<int>(surfaces.size())))];
  }
  void sheet(double x_m, double z_m, double width_m, double height_m, int material, double deep_m = 0.012) const {
    box(x_m - 0.5 * width_m, x_m + 0.5 * width_m, 0.002, deep_m, z_m - 0.5 * height_m, z_m + 0.5 * height_m,
        {material, 0.0}, of.frame);
  }
};

/// Up to so far a thing reaches along its wall.
double width_m(Thing thing) {
  switch (thing) {
    case Thing::kDoor:
      return 1.3;
    case Thing::kPicture:
      return 0.85;
    case Thing::kPictures:
      return 1.25;
    case Thing::kBoard:
      return 1.5;
    case Thing::kRadiator:
      return 1.2;
    case Thing::kExtinguisher:
      return 0.45;
    case Thing::kCoats:
      return 1.1;
    case Thing::kPoster:
      return 0.6;
    case Thing::kBench:
      return 1.4;
    case Thing::kPiece:
      return 1.5;
    case Thing::kPlant:
      return 0.5;
  }
  return 0.0;
}

bool is_furniture(Thing thing) { return thing == Thing::kBench || thing == Thing::kPiece || thing == Thing::kPlant; }

/// A door with the plate of its room beside it.
void build_door(const Place& at) {
  constexpr double kHalf_m = 0.44;
  constexpr double kTop_m = 2.05;
  at.box(-kHalf_m, kHalf_m, 0.0, 0.03, 0.0, kTop_m, at.one_of(at.of.doors), at.of.wood);
  for (const double x : {-kHalf_m - 0.08, kHalf_m}) at.box(x, x + 0.08, 0.0, 0.05, 0.0, kTop_m + 0.08, at.of.wood);
  at.box(-kHalf_m, kHalf_m, 0.0, 0.05, kTop_m, kTop_m + 0.08, at.of.wood);
  at.sheet(0.6, 1.5, 0.17, 0.13, at.one_of(at.of.notices));
  if (pick(at.random, 2) == 0)
    at.sheet(uniform(at.random, -0.1, 0.1), 1.45, 0.21, 0.29, at.one_of(at.of.notices), 0.034);
}

void build_picture(const Place& at, double x_m, double most_m) {
  const double width_m = uniform(at.random, 0.65, 1.0) * most_m;
  at.sheet(x_m, uniform(at.random, 1.4, 1.62), width_m, 0.8 * width_m, at.one_of(at.of.pictures), 0.03);
}

/// A board of cork with sheets of paper on it.
void build_board(const Place& at) {
  constexpr double kHalf_m = 0.62;
  at.box(-kHalf_m, kHalf_m, 0.0, 0.02, 1.0, 1.9, at.of.cork, at.of.wood);
  for (int column = 0; column < 4; ++column) {
    for (const double z_m : {1.24, 1.66}) {
      if (pick(at.random, 5) == 0) continue;
      at.sheet(-0.45 + 0.3 * column + uniform(at.random, -0.03, 0.03), z_m + uniform(at.random, -0.05, 0.05),
               uniform(at.random, 0.17, 0.26), uniform(at.random, 0.2, 0.32), at.one_of(at.of.notices), 0.024);
    }
  }
}

void build_radiator(const Place& at) {
  at.box(-0.5, 0.5, 0.02, 0.1, 0.14, 0.72, at.of.radiator);
  at.box(0.5, 0.56, 0.04, 0.08, 0.2, 0.26, at.of.steel);
  build_picture(at, 0.0, 0.7);
}

void build_extinguisher(const Place& at) {
  at.scene.cylinder(at.frame, {0.0, 0.1, 0.55}, 0.075, 0.48, at.of.red);
  at.scene.cylinder(at.frame, {0.0, 0.1, 1.03}, 0.03, 0.07, at.of.steel);
  at.sheet(0.0, 1.55, 0.22, 0.22, at.one_of(at.of.notices));
  at.sheet(0.0, 1.85, 0.2, 0.2, at.of.red.material);
}

void build_bench(const Place& at) {
  const Surface seat = at.one_of(at.of.cloths);
  for (const double x : {-0.58, 0.54}) {
    for (const double y : {0.06, 0.36}) at.box(x, x + 0.04, y, y + 0.04, 0.0, 0.42, at.of.steel);
  }
  at.box(-0.62, 0.62, 0.04, 0.42, 0.42, 0.48, seat);
  at.box(-0.62, 0.62, 0.02, 0.06, 0.56, 0.88, seat);
  if (pick(at.random, 2) == 0) at.box(-0.45, -0.1, 0.1, 0.36, 0.48, 0.7, at.one_of(at.of.cloths));  // a bag
}

void build(Thing thing, const Place& at) {
  constexpr std::array kPieces = {Piece::kBookshelf, Piece::kSideboard, Piece::kConsole, Piece::kTelevision};
  switch (thing) {
    case Thing::kDoor:
      return build_door(at);
    case Thing::kPicture:
      return build_picture(at, 0.0, 0.8);
    case Thing::kPictures:
      for (const double x_m : {-0.32, 0.32}) build_picture(at, x_m, 0.55);
      return;
    case Thing::kBoard:
      return build_board(at);
    case Thing::kRadiator:
      return build_radiator(at);
    case Thing::kExtinguisher:
      return build_extinguisher(at);
    case Thing::kCoats:
      return build_piece(at.scene, Piece::kCoats, at.frame, at.random);
    case Thing::kPoster:
      return at.sheet(0.0, uniform(at.random, 1.3, 1.6), 0.5, 0.7,
                      at.one_of(pick(at.random, 2) == 0 ? at.of.pictures : at.of.notices));
    case Thing::kBench:
      return build_bench(at);
    case Thing::kPiece:
      return build_piece(at.scene, kPieces[static_cast<std::size_t>(pick(at.random, kPieces.size()))], at.frame,
                         at.random);
    case Thing::kPlant:
      return build_plant(at.scene, at.frame * Pose2{0.0, 0.23, 0.0}, uniform(at.random, 1.0, 1.5), at.random);
  }
}

/// The parts of a wall in front of which things may stand, from and to, from its left end.
std::vector<std::pair<double, double>> free_stretches(const Space& space, Side side,
                                                      const std::vector<Doorway>& doorways) {
  constexpr double kAtDoor_m = 0.25;
  constexpr double kAtWindow_m = 0.42;  // curtains
  std::vector<std::pair<double, double>> taken;
  for (const auto& [from, to] : openings_of(space, side, doorways))
    taken.emplace_back(from - kAtDoor_m, to + kAtDoor_m);
  for (const WindowOpening& window : space.windows) {
    if (window.side != side) continue;
    const double half_m = 0.5 * window.width_m + kAtWindow_m;
    taken.emplace_back(window.centre_m - half_m, window.centre_m + half_m);
  }
  std::ranges::sort(taken);
  std::vector<std::pair<double, double>> free;
  double at_m = 0.08;
  const double end_m = wall_frame(space, side).length_m - 0.08;
  for (const auto& [from, to] : taken) {
    if (from > at_m) free.emplace_back(at_m, from);
    at_m = std::max(at_m, to);
  }
  if (end_m > at_m) free.emplace_back(at_m, end_m);
  return free;
}

}  // namespace

CorridorMaterials corridor_materials(SceneBuilder& scene, Random& random) {
  constexpr int kPictures = 14;
  constexpr int kNotices = 10;
  CorridorMaterials of;
  for (int i = 0; i < kPictures; ++i) of.pictures.push_back(scene.add_material("picture", paint_picture(random)));
  for (int i = 0; i < kNotices; ++i) {
    const Rgb paper = i % 3 == 0 ? scaled(rich_colour(random), 1.4) : varied(random, {236, 234, 226}, 8);
    of.notices.push_back(scene.add_material("notice", paint_notes(random, paper)));
  }
  for (int i = 0; i < 4; ++i) {
    of.doors.push_back({scene.add_material("door", paint_door(random, varied(random, rich_colour(random), 20))), 0.0});
  }
  for (const Weave weave : {Weave::kPlain, Weave::kChecks, Weave::kStripes, Weave::kFlowers}) {
    of.cloths.push_back({scene.add_material("cloth", paint_fabric(random, rich_colour(random), weave)), 0.5});
  }
  of.wood = {scene.add_material("wood", paint_wood(random, varied(random, {150, 112, 76}, 25))), 0.8};
  of.steel = {scene.add_material("steel", std::array<float, 3>{0.42F, 0.43F, 0.45F}), 0.0};
  of.radiator = {scene.add_material("radiator", paint_cabinet(random, {215, 215, 212}, 8, 1)), 0.0};
  of.red = {scene.add_material("red", paint_wood(random, {190, 32, 28})), 0.6};
  of.cork = {scene.add_material("cork", paint_vinyl(random, 0.8, 0.8, {176, 132, 88})), 0.8};
  of.frame = {scene.add_material("frame", std::array<float, 3>{0.12F, 0.08F, 0.05F}), 0.0};
  return of;
}

std::vector<Furniture> dress_wall(SceneBuilder& scene, const Space& space, Side side,
                                  const std::vector<Doorway>& doorways, bool deep, const CorridorMaterials& of,
                                  Random& random) {
  using enum Thing;
  constexpr std::array kShallow = {kDoor,         kPicture, kPictures, kBoard, kRadiator,
                                   kExtinguisher, kDoor,    kCoats,    kPoster};
  constexpr std::array kDeep = {kBench, kPiece, kPlant, kPiece};
  constexpr int kTries = 6;
  constexpr double kApart_m = 0.6;
  constexpr double kWidestDeep_m = 1.5;
  std::vector<Furniture> furniture;
  const Pose2 wall = wall_frame(space, side).frame;
  for (const auto& [from_m, to_m] : free_stretches(space, side, doorways)) {
    double at_m = from_m;
    std::optional<Thing> last;
    int tries = 0;
    while (tries < kTries) {
      // Nothing that reaches into the corridor stands beside a doorway or where the way turns off.
      const bool apart = at_m >= from_m + kApart_m && at_m + kWidestDeep_m <= to_m - kApart_m;
      const bool is_deep = deep && apart && pick(random, 2) == 0;
      const Thing thing = is_deep ? kDeep[static_cast<std::size_t>(pick(random, kDeep.size()))]
                                  : kShallow[static_cast<std::size_t>(pick(random, kShallow.size()))];
      const double wide_m = width_m(thing);
      if (at_m + wide_m > to_m || thing == last) {
        ++tries;
        continue;
      }
      const Eigen::Index first = scene.triangles();
      build(thing, {{scene, wall * Pose2{at_m + 0.5 * wide_m, 0.0, 0.0}}, of, random});
      if (is_furniture(thing)) furniture.push_back({space.name, first, scene.triangles() - first, true});
      last = thing;
      at_m += wide_m + uniform(random, 0.1, 0.6);
    }
  }
  return furniture;
}

void build_open_leaf(SceneBuilder& scene, const Doorway& doorway, const CorridorMaterials& of, Random& random) {
  const Pose2 frame{doorway.centre_m.x(), doorway.centre_m.y(), doorway.in_x_wall ? 0.0 : 0.5 * std::numbers::pi};
  const double side_m = 0.5 * doorway.width_m + 0.02;
  constexpr double kLeaf_m = 0.9;
  const Pose2 hinge = frame * Pose2{side_m, kHalfWall_m + 0.02, 0.5 * std::numbers::pi};
  const Place at{{scene, hinge}, of, random};
  at.box(0.0, kLeaf_m, -0.04, 0.0, 0.01, 2.05, at.one_of(of.doors), of.wood);
}

}  // namespace homeward::sim
