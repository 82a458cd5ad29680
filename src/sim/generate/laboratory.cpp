// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/laboratory.hpp"

#include <array>

#include "sim/floor.hpp"
#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/furnish.hpp"

namespace homeward::sim {
namespace {

constexpr double kLength_m = 7.6;
constexpr double kWidth_m = 5.4;
constexpr double kCorridor_m = 1.8;
constexpr double kRowLength_m = 4.5;
constexpr double kRowsAcross_m = 1.8;

/// Independent draws for each part, so that what changes in one leaves the others as they are.
Random part_of(std::uint64_t seed, std::uint64_t part) { return Random(seed * 9176 + part * 7907 + 29); }

enum Part : std::uint64_t { kShell, kLinings, kDoor, kHeavy, kPictures, kLamps, kCorridor, kFirstLight = 100 };

std::vector<Space> spaces_of(SceneBuilder& scene, const LaboratoryState& state, Random& random) {
  constexpr std::array<Rgb, 5> kWalls = {
      {{222, 214, 190}, {200, 208, 204}, {212, 200, 188}, {196, 202, 214}, {224, 220, 210}}};
  const Rgb paint = varied(random, kWalls[static_cast<std::size_t>(pick(random, kWalls.size()))], 10);
  const Surface wall{scene.add_material("wall", paint_wallpaper(random, paint, Wallpaper::kPlaster)), 1.8};
  const Surface floor{scene.add_material("floor", paint_tiles(random, varied(random, {142, 140, 136}, 25),
                                                              varied(random, {156, 152, 146}, 20))),
                      2.4};
  const Surface ceiling{scene.add_material("ceiling", paint_tiles(random, {228, 228, 226}, {222, 222, 220})), 3.0};
  const double wall_m = kWidth_m - 2.0 * kHalfWall_m;
  const std::vector<WindowOpening> windows = {{Side::kWest, 0.26 * wall_m, 1.5, state.curtains_drawn},
                                              {Side::kWest, 0.74 * wall_m, 1.5, state.curtains_drawn}};
  return {{"laboratory", {0.0, 0.0}, {kLength_m, kWidth_m}, floor, wall, ceiling, windows},
          {"", {0.0, -kCorridor_m}, {kLength_m, 0.0}, floor, wall, ceiling, {}}};
}

void hang_door(SceneBuilder& scene, const Doorway& doorway, bool open, Random random) {
  const Surface door{scene.add_material("door", paint_door(random, varied(random, {165, 130, 95}, 40))), 0.0};
  const double half = 0.5 * doorway.width_m;
  const Pose2 frame{doorway.centre_m.x(), doorway.centre_m.y(), 0.0};
  if (!open) {
    scene.box(frame, {-half, -0.02, 0.0}, {half, 0.02, doorway.height_m}, {door, door});
    return;
  }
  // Swung into the room, against the wall.
  scene.box(frame, {half + 0.08, kHalfWall_m + 0.03, 0.01},
            {half + 0.08 + doorway.width_m, kHalfWall_m + 0.07, doorway.height_m}, {door, door});
}

/// False when a piece found no place.
bool furnish(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways, std::uint64_t seed,
             std::uint64_t arrangement) {
  using enum Piece;
  Furnisher furnisher(scene, space, doorways);
  Random heavy = part_of(seed, kHeavy);
  for (const Piece piece : {kBookshelf, kWhiteboard, kWardrobe, kBookshelf}) furnisher.place(piece, heavy);
  constexpr int kPicturesOnTheWalls = 5;
  Random pictures = part_of(seed, kPictures);
  furnisher.hang_pictures(kPicturesOnTheWalls, pictures);
  Random where(seed * 5077 + arrangement * 8861 + 41);
  std::uint64_t part = kFirstLight;
  for (const Piece piece : {kDesk, kDesk, kConsole, kSideboard, kArmchair, kPlant, kPlant}) {
    Random looks = part_of(seed, part++);
    if (!furnisher.place(piece, where, looks)) return false;
  }
  return true;
}

std::vector<Lamp> light(SceneBuilder& scene, const LaboratoryState& state, std::uint64_t seed) {
  constexpr double kStrength = 0.55;
  std::vector<Lamp> lamps;
  Random random = part_of(seed, kLamps);
  for (int along = 0; along < 3; ++along) {
    for (int across = 0; across < 2; ++across) {
      const Eigen::Vector2d at_m((along + 0.5) * kLength_m / 3.0, (across + 0.5) * kWidth_m / 2.0);
      if (!state.only_window_lamps || along == 0) {
        lamps.push_back(build_lamp(scene, at_m, kStrength, random));
        continue;
      }
      const Surface dark{scene.add_material("lamp out", std::array<float, 3>{0.8F, 0.78F, 0.72F}), 0.0};
      scene.cylinder({at_m.x(), at_m.y(), 0.0}, {0, 0, kCeiling_m - 0.16}, uniform(random, 0.14, 0.2), 0.12, dark);
    }
  }
  if (!state.only_window_lamps)
    lamps.push_back(build_lamp(scene, {0.5 * kLength_m, -0.5 * kCorridor_m}, kStrength, random));
  return lamps;
}

bool rows_are_free(const World& world) {
  constexpr double kStep_m = 0.15;
  for (double along_m = 0.0; along_m <= kRowLength_m; along_m += kStep_m) {
    for (double across_m = 0.0; across_m <= kRowsAcross_m; across_m += kStep_m) {
      const Pose2 point = laboratory_point(along_m, across_m, 0.0);
      if (!is_set(world.drivable, {point.x_m, point.y_m})) return false;
    }
  }
  return true;
}

}  // namespace

World generate_laboratory(std::uint64_t seed, const LaboratoryState& state) {
  // A draw that leaves no place for a piece, or puts one in the rows' way, is followed by the next.
  constexpr std::uint64_t kDraws = 40;
  World world;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    SceneBuilder scene;
    Random shell = part_of(seed, kShell);
    const std::vector<Space> spaces = spaces_of(scene, state, shell);
    const Doorway doorway{{0.68 * kLength_m, 0.0}, true, 1.0, 2.1, false};
    build_shell(scene, spaces[0], {doorway}, shell);
    build_shell(scene, spaces[1], {doorway}, shell);
    Random linings = part_of(seed, kLinings);
    build_linings(scene, {doorway}, linings);
    hang_door(scene, doorway, state.door_open, part_of(seed, kDoor));
    const bool furnished = furnish(scene, spaces[0], {doorway}, seed, state.arrangement + 1000 * draw);
    Furnisher corridor(scene, spaces[1], {doorway});
    Random things = part_of(seed, kCorridor);
    corridor.hang_pictures(3, things);
    world = World();
    world.name = "rows_laboratory:" + std::to_string(seed);
    world.lamps = light(scene, state, seed);
    world.scene = scene.take();
    if (finish_world(world, spaces) && furnished && rows_are_free(world)) break;
  }
  return world;
}

LightSettings laboratory_light(const LaboratoryState& state) {
  LightSettings settings;
  settings.lamp_colour = {1.0F, 0.97F, 0.92F};
  settings.lamp_intensity = 1.1F;
  settings.window_radiance = static_cast<float>(state.daylight);
  constexpr float kNightSky = 0.02F;
  constexpr float kPaneShare = 0.28F;  // of the daylight that arrives: what a pane itself shows
  settings.window_shown = kNightSky + kPaneShare * static_cast<float>(state.daylight);
  settings.noise_levels = 1.5F;
  settings.gather_rays = 64;  // few lamps in a large room: every ray that meets one shows
  return settings;
}

Pose2 laboratory_point(double along_m, double across_m, double theta_rad) {
  return {0.5 * (kLength_m - kRowLength_m) + along_m, 0.5 * (kWidth_m - kRowsAcross_m) + across_m, theta_rad};
}

}  // namespace homeward::sim
