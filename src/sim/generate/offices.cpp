// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/furnish.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

constexpr int kOffices = 8;
constexpr double kWidth_m = 4.0;
constexpr double kDepth_m = 4.4;
constexpr double kCorridor_m = 2.2;

/// Furniture and its textures are drawn from the same seed in every office; only the small things are its own.
std::vector<Furniture> furnish_office(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways,
                                      bool south, bool mirrored, std::uint64_t seed, int number) {
  Random common(seed * 31 + 5);
  Random own(seed * 977 + static_cast<std::uint64_t>(number) * 131 + 3);
  Furnisher furnisher(scene, space, doorways);
  // Sides as seen by somebody who comes in through the door.
  const Side far = south ? Side::kSouth : Side::kNorth;
  const Side right = south != mirrored ? Side::kWest : Side::kEast;
  const Side left = south != mirrored ? Side::kEast : Side::kWest;
  // Along a side wall the left end is at the far wall or at the door, which mirroring exchanges.
  const double side_length_m = wall_frame(space, right).length_m;
  const auto from_far = [&](Side side, double distance_m) {
    const bool left_end_is_far = (side == Side::kWest) != south;
    return left_end_is_far ? distance_m : side_length_m - distance_m;
  };
  furnisher.place_at(Piece::kDesk, right, from_far(right, 1.5), common);
  furnisher.place_at(Piece::kWhiteboard, left, from_far(left, 1.4), common);
  furnisher.place_at(Piece::kArmchair, far, mirrored ? 3.2 : 0.6, common);
  // The shelf is the same, the order of its books is not.
  furnisher.place_at(Piece::kBookshelf, left, from_far(left, 3.0), own);
  const double along_m = from_far(right, 3.0);
  furnisher.hang_at(right, along_m, 0.7, paint_picture(own));
  if (number % 2 == 1) furnisher.place_at(Piece::kPlant, far, mirrored ? 0.4 : 3.4, own);
  return furnisher.furniture();
}

}  // namespace

World generate_offices(std::uint64_t seed) {
  Random random(seed * 6151 + 11);
  SceneBuilder scene;
  const double length_m = kWidth_m * kOffices / 2.0;
  // The carpet runs on from room to room: what is alike two metres on is alike in the next office too.
  const Surface floor{
      .material = scene.add_material("carpet", paint_carpet(random, varied(random, {132, 138, 150}, 20))),
      .tile_m = 2.0,
      .from_origin = true};
  const Surface wall{scene.add_material("wall", paint_wallpaper(random, {214, 214, 206}, Wallpaper::kPlaster)), 2.0};
  const Surface ceiling{scene.add_material("ceiling", paint_tiles(random, {228, 228, 226}, {224, 224, 222})), 3.0};
  std::vector<Space> spaces;
  std::vector<Doorway> doorways;
  spaces.push_back({"corridor", {0.0, 0.0}, {length_m, kCorridor_m}, floor, wall, ceiling, {}});
  for (int i = 0; i < kOffices; ++i) {
    const bool south = i >= kOffices / 2;
    const double x0 = kWidth_m * (i % (kOffices / 2));
    const double y0 = south ? -kDepth_m : kCorridor_m;
    const double window_at_m = 0.5 * kWidth_m - kHalfWall_m;
    spaces.push_back({"office_" + std::to_string(i + 1),
                      {x0, y0},
                      {x0 + kWidth_m, y0 + kDepth_m},
                      floor,
                      wall,
                      ceiling,
                      {{south ? Side::kSouth : Side::kNorth, window_at_m, 1.6}}});
    doorways.push_back({{x0 + 0.5 * kWidth_m, south ? 0.0 : kCorridor_m}, true, 1.15, 2.1, false});
  }
  World world;
  world.doors = build_like_shells(scene, spaces, doorways, seed);
  for (std::size_t i = 1; i < spaces.size(); ++i) {
    const int number = static_cast<int>(i);
    const auto placed =
        furnish_office(scene, spaces[i], doorways, number > kOffices / 2, number == kOffices, seed, number);
    world.furniture.insert(world.furniture.end(), placed.begin(), placed.end());
  }
  Furnisher corridor(scene, spaces.front(), doorways);
  corridor.hang_pictures(4, random);
  for (const Space& space : spaces) {
    const Eigen::Vector2d middle_m = 0.5 * (space.least_m + space.most_m);
    Random same(seed * 19 + 3);
    if (space.name != "corridor") {
      world.lamps.push_back(build_lamp(scene, middle_m, 1.0, same));
      continue;
    }
    for (int i = 0; i < 4; ++i) {
      world.lamps.push_back(build_lamp(scene, {(i + 0.5) * length_m / 4.0, middle_m.y()}, 1.0, same));
    }
  }
  world.name = "offices:" + std::to_string(seed);
  world.scene = scene.take();
  finish_world(world, spaces);
  return world;
}

}  // namespace homeward::sim
