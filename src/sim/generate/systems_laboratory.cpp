// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <numbers>

#include "sim/floor.hpp"
#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/furnish.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

constexpr double kWidth_m = 10.0;  // Ferdaus (2008, §4.2): "the lab was 10m x 12m"
constexpr double kDepth_m = 12.0;
constexpr double kCorner_m = 1.0;      // of the free corners' points, from both walls
constexpr double kDoorAlong_m = 2.94;  // along the east wall

/// What stands along the walls; distances of its middle from the wall's left end. A place is 1.9 m wide or more and no
/// piece wider than 1.4 m, so that none meets another wherever it is moved to.
struct Place {
  Piece piece;
  Side side;
  double along_m;
};
constexpr double kMovedMost_m = 0.2;
constexpr std::array kPlaces = {
    Place{Piece::kBookshelf, Side::kSouth, 3.0},  Place{Piece::kFileCabinets, Side::kSouth, 4.94},
    Place{Piece::kBookshelf, Side::kSouth, 6.88}, Place{Piece::kDesk, Side::kEast, 4.94},
    Place{Piece::kBookshelf, Side::kEast, 6.9},   Place{Piece::kFileCabinets, Side::kEast, 8.8},
    Place{Piece::kDesk, Side::kEast, 10.8},       Place{Piece::kDesk, Side::kNorth, 2.0},
    Place{Piece::kDesk, Side::kNorth, 3.96},      Place{Piece::kDesk, Side::kNorth, 5.92},
    Place{Piece::kDesk, Side::kNorth, 7.88},      Place{Piece::kFileCabinets, Side::kWest, 1.0},
    Place{Piece::kDesk, Side::kWest, 2.9},        Place{Piece::kDesk, Side::kWest, 4.85},
    Place{Piece::kBookshelf, Side::kWest, 6.8},   Place{Piece::kFileCabinets, Side::kWest, 8.7},
};

Space room_of(SceneBuilder& scene, Random& random) {
  constexpr std::array<Rgb, 4> kWalls = {{{222, 216, 198}, {204, 212, 210}, {216, 206, 196}, {200, 206, 216}}};
  const Rgb paint = varied(random, kWalls[static_cast<std::size_t>(pick(random, kWalls.size()))], 10);
  const Surface wall{scene.add_material("wall", paint_wallpaper(random, paint, Wallpaper::kPlaster)), 1.8};
  const Surface floor{
      scene.add_material("floor", paint_tiles(random, varied(random, {146, 142, 136}, 25), {160, 157, 150})), 2.4};
  const Surface ceiling{scene.add_material("ceiling", paint_tiles(random, {228, 228, 226}, {222, 222, 220})), 3.0};
  return {"laboratory",
          {0.0, 0.0},
          {kWidth_m, kDepth_m},
          floor,
          wall,
          ceiling,
          {{Side::kNorth, 3.0, 1.6}, {Side::kNorth, 6.9, 1.6}}};
}

/// A table with panels down to the floor, 2.4 m by 1.2 m around the frame's origin: a scanner sees it as it is.
void build_study_table(const FramedBoxes& at, Random& random) {
  const Rgb colour = varied(random, {168, 130, 88}, 25);
  const Surface wood{at.scene.add_material("wood", paint_wood(random, colour)), 0.7};
  const Surface drawers{at.scene.add_material("drawers", paint_cabinet(random, colour, 2, 3)), 0.0};
  at.box(-1.2, 1.2, -0.6, 0.6, 0.72, 0.76, wood);
  at.box(-1.1, 1.1, -0.5, 0.5, 0.0, 0.72, drawers, wood);
  for (const double x : {-0.7, 0.1}) {
    const Surface books{at.scene.add_material("books", paint_books(random, 1, colour)), 0.0};
    at.box(x, x + 0.5, -0.12, 0.12, 0.76, 1.0, books, wood);
  }
}

/// A box to sit on with a back, 0.44 m by 0.44 m around the frame's origin, looking along +y.
void build_chair(const FramedBoxes& at, Random& random) {
  const Surface cloth{
      at.scene.add_material("cloth", paint_fabric(random, rich_colour(random), static_cast<Weave>(pick(random, 4)))),
      0.5};
  at.box(-0.22, 0.22, -0.22, 0.22, 0.0, 0.47, cloth);
  at.box(-0.22, 0.22, -0.22, -0.17, 0.47, 0.92, cloth);
}

/// The table in the middle of the room, chairs at it and elsewhere.
std::vector<Furniture> furnish_middle(SceneBuilder& scene, Random& random) {
  std::vector<Furniture> furniture;
  const auto put = [&](const Pose2& frame, const auto& build) {
    const Eigen::Index first = scene.triangles();
    build(FramedBoxes{scene, frame}, random);
    furniture.push_back({"", first, scene.triangles() - first, true});
  };
  const auto moved = [&](double x_m, double y_m, double by_m) {
    const double moved_x_m = x_m + uniform(random, -by_m, by_m);
    return Pose2{moved_x_m, y_m + uniform(random, -by_m, by_m), 0.0};
  };
  const Pose2 table = moved(0.5 * kWidth_m, 0.5 * kDepth_m, 0.3);
  put(table, build_study_table);
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-0.6, 0.6}) {
      const double facing_rad = (side > 0.0 ? std::numbers::pi : 0.0) + uniform(random, -0.3, 0.3);
      put(table * moved(x, 1.0 * side, 0.06) * Pose2{0.0, 0.0, facing_rad}, build_chair);
    }
  }
  constexpr std::array<std::array<double, 2>, 4> kChairs = {{{2.5, 3.4}, {7.6, 3.0}, {7.5, 8.9}, {2.5, 9.1}}};
  for (const auto& [x_m, y_m] : kChairs) {
    const Pose2 at = moved(x_m, y_m, 0.3);
    put(at * Pose2{0.0, 0.0, uniform(random, -std::numbers::pi, std::numbers::pi)}, build_chair);
  }
  return furniture;
}

std::vector<Furniture> furnish(SceneBuilder& scene, const Space& room, Random& random) {
  // Nothing hangs on the door, which is none to go through.
  const Doorway door{{kWidth_m, kHalfWall_m + kDoorAlong_m}, false, 0.85};
  Furnisher furnisher(scene, room, {door});
  for (const Place& place : kPlaces) {
    const double along_m = place.along_m + uniform(random, -kMovedMost_m, kMovedMost_m);
    furnisher.place_at(place.piece, place.side, along_m, random);
  }
  furnisher.hang_pictures(5, random);
  std::vector<Furniture> furniture = furnisher.furniture();
  const std::vector<Furniture> middle = furnish_middle(scene, random);
  furniture.insert(furniture.end(), middle.begin(), middle.end());
  return furniture;
}

std::vector<Lamp> light(SceneBuilder& scene, Random& random) {
  std::vector<Lamp> lamps;
  for (const double x_share : {0.25, 0.75}) {
    for (const double y_share : {1.0 / 6.0, 0.5, 5.0 / 6.0}) {
      lamps.push_back(build_lamp(scene, {x_share * kWidth_m, y_share * kDepth_m}, 1.0, random));
    }
  }
  return lamps;
}

/// The room's quarters, so that there are places to name in it.
std::vector<Space> quarters_of(const Space& room) {
  const Eigen::Vector2d middle_m = 0.5 * (room.least_m + room.most_m);
  std::vector<Space> quarters;
  for (const bool upper : {false, true}) {
    for (const bool right : {false, true}) {
      Space quarter = room;
      quarter.name = std::string(upper ? "upper" : "lower") + (right ? "_right" : "_left");
      (right ? quarter.least_m : quarter.most_m).x() = middle_m.x();
      (upper ? quarter.least_m : quarter.most_m).y() = middle_m.y();
      quarters.push_back(quarter);
    }
  }
  return quarters;
}

/// The start in the lower left corner, looking into the room; the point of the lower right quarter in the other one.
bool start_in_corner(World& world) {
  world.start = {kCorner_m, kCorner_m, 0.25 * std::numbers::pi};
  bool free = true;
  for (std::size_t corner = 0; corner < 2; ++corner) {
    Room& room = world.rooms[corner];
    room.x_m = corner == 0 ? kCorner_m : kWidth_m - kCorner_m;
    room.y_m = kCorner_m;
    free = free && is_set(world.drivable, {room.x_m, room.y_m});
  }
  return free;
}

}  // namespace

World generate_systems_laboratory(std::uint64_t seed) {
  // Furniture may, rarely, shut off a quarter; the next draw of the same seed is then taken.
  constexpr std::uint64_t kDraws = 20;
  World world;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    Random random(seed * 6841 + draw * 104729 + 23);
    SceneBuilder scene;
    const Space room = room_of(scene, random);
    build_shell(scene, room, {}, random);
    build_shut_door(scene, wall_frame(room, Side::kEast).frame * Pose2{kDoorAlong_m, 0.0, 0.0}, random);
    world = World();
    world.name = "laboratory:" + std::to_string(seed);
    world.furniture = furnish(scene, room, random);
    world.lamps = light(scene, random);
    world.scene = scene.take();
    if (finish_world(world, quarters_of(room)) && start_in_corner(world)) break;
  }
  name_rooms_of(world);
  return world;
}

}  // namespace homeward::sim
