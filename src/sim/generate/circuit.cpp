// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/generate/canvas.hpp"
#include "sim/generate/corridor_things.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

constexpr double kNarrow_m = 1.0;      // door frames across a corridor
constexpr double kFurnished_m = 1.95;  // corridors narrower than this have nothing standing along them

/// A ring of corridors with six corners, passed through in the order of `spaces`.
struct CircuitPlan {
  std::vector<Space> spaces;
  std::vector<Doorway> openings;  // i: from space i to the next
};

Space corridor(const Eigen::Vector2d& least_m, const Eigen::Vector2d& most_m) {
  return {"", least_m, most_m, {}, {}, {}, {}};
}

CircuitPlan plan_circuit(Random& random) {
  const double length = uniform(random, 17.6, 20.0);
  const double width = uniform(random, 12.6, 14.4);
  std::array<double, 6> wide;  // of the corridors
  for (double& one : wide) one = uniform(random, 1.7, 2.4);
  const auto [w1, w2, w3, w4, w5, w6] = wide;
  const double notch = length * uniform(random, 0.42, 0.55);      // where the ring steps down
  const double lower = width - uniform(random, 3.6, 4.4);         // how far up it goes beyond
  const double first_frame = length * uniform(random, 0.4, 0.6);  // door frames across the two longest corridors
  const double second_frame = w6 + (notch - w6) * uniform(random, 0.4, 0.6);
  CircuitPlan plan;
  plan.spaces = {corridor({0.0, 0.0}, {first_frame, w1}),
                 corridor({first_frame, 0.0}, {length, w1}),
                 corridor({length - w2, w1}, {length, width}),
                 corridor({notch, width - w3}, {length - w2, width}),
                 corridor({notch, lower - w5}, {notch + w4, width - w3}),
                 corridor({second_frame, lower - w5}, {notch, lower}),
                 corridor({w6, lower - w5}, {second_frame, lower}),
                 corridor({0.0, w1}, {w6, lower})};
  constexpr double kAtOpening_m = 0.34;  // walls and linings on both sides
  const auto opening = [&](double x, double y, bool in_x_wall, double corridor_m) {
    plan.openings.push_back({{x, y}, in_x_wall, corridor_m - kAtOpening_m, 2.2, false});
  };
  plan.openings.push_back({{first_frame, 0.5 * w1}, false, kNarrow_m, 2.1, false});
  opening(length - 0.5 * w2, w1, true, w2);
  opening(length - w2, width - 0.5 * w3, false, w3);
  opening(notch + 0.5 * w4, width - w3, true, w4);
  opening(notch, lower - 0.5 * w5, false, w5);
  plan.openings.push_back({{second_frame, lower - 0.5 * w5}, false, kNarrow_m, 2.1, false});
  opening(w6, lower - 0.5 * w5, false, w5);
  opening(0.5 * w6, w1, true, w6);
  for (std::size_t i = 0; i < plan.spaces.size(); ++i) plan.spaces[i].name = "corridor_" + std::to_string(i + 1);
  return plan;
}

bool along_x(const Space& space) {
  const Eigen::Vector2d size_m = space.most_m - space.least_m;
  return size_m.x() > size_m.y();
}

double wide_m(const Space& space) { return (space.most_m - space.least_m).minCoeff(); }

/// Floor, walls and ceiling of its own, and windows to the outside every few metres.
void finish_corridor(SceneBuilder& scene, Space& space, const std::vector<Doorway>& openings, Side outside,
                     Random& random) {
  constexpr std::array<Rgb, 6> kWalls = {
      {{222, 210, 180}, {190, 205, 200}, {205, 185, 170}, {185, 195, 215}, {215, 200, 205}, {196, 204, 172}}};
  const Rgb wall = varied(random, kWalls[static_cast<std::size_t>(pick(random, kWalls.size()))], 10);
  if (pick(random, 2) == 0) {
    const double repeat_m = uniform(random, 2.4, 3.4);
    space.wall = {scene.add_material("wall", paint_ward_wall(random, repeat_m, kCeiling_m, wall)), repeat_m,
                  kCeiling_m};
  } else {
    space.wall = {scene.add_material("wall", paint_wallpaper(random, wall, static_cast<Wallpaper>(pick(random, 5)))),
                  1.5};
  }
  const Rgb floor = varied(random, {150, 138, 122}, 30);
  switch (pick(random, 3)) {
    case 0:
      space.floor = {scene.add_material("planks", paint_planks(random, varied(random, {165, 120, 78}, 25))), 2.0};
      break;
    case 1:
      space.floor = {scene.add_material("vinyl", paint_vinyl(random, 2.2, 2.2, floor)), 2.2};
      break;
    default:
      space.floor = {scene.add_material("tiles", paint_tiles(random, floor, varied(random, floor, 25))), 1.6};
  }
  space.ceiling = {scene.add_material("ceiling", paint_ceiling_panels(random, 2.4, 2.4, {226, 227, 225})), 2.4};
  const double length_m = wall_frame(space, outside).length_m;
  const auto passages = openings_of(space, outside, openings);
  for (double at_m = uniform(random, 1.4, 2.4); at_m + 1.3 < length_m; at_m += uniform(random, 3.2, 4.8)) {
    const WindowOpening window{outside, at_m, uniform(random, 1.1, 1.7)};
    const double half_m = 0.5 * window.width_m + 0.5;  // with its curtains
    const bool in_the_way = std::ranges::any_of(
        passages, [&](const auto& passage) { return passage.first < at_m + half_m && passage.second > at_m - half_m; });
    if (!in_the_way) space.windows.push_back(window);
  }
}

/// Doormats and runners, which give the floor something to look at.
void lay_mats(SceneBuilder& scene, const Space& space, const std::vector<int>& rugs, Random& random) {
  const Eigen::Vector2d middle_m = 0.5 * (space.least_m + space.most_m);
  const double length_m = (space.most_m - space.least_m).maxCoeff();
  const Pose2 frame{middle_m.x(), middle_m.y(), along_x(space) ? 0.0 : 0.5 * std::numbers::pi};
  for (double at_m = -0.5 * length_m + 1.6; at_m < 0.5 * length_m - 1.4; at_m += uniform(random, 2.8, 4.2)) {
    const double half_x = uniform(random, 0.6, 1.0);
    const double half_y = uniform(random, 0.3, 0.4);
    constexpr double kThick_m = 0.008;
    scene.quad(frame,
               {Eigen::Vector3d(at_m - half_x, half_y, kThick_m),
                {at_m + half_x, half_y, kThick_m},
                {at_m + half_x, -half_y, kThick_m},
                {at_m - half_x, -half_y, kThick_m}},
               {rugs[static_cast<std::size_t>(pick(random, static_cast<int>(rugs.size())))], 0.0});
  }
}

std::vector<Lamp> hang_lamps(SceneBuilder& scene, const Space& space, Random& random) {
  std::vector<Lamp> lamps;
  const Eigen::Vector2d middle_m = 0.5 * (space.least_m + space.most_m);
  const double length_m = (space.most_m - space.least_m).maxCoeff();
  const int count = std::max(1, static_cast<int>(std::lround(length_m / 3.6)));
  for (int i = 0; i < count; ++i) {
    const double at_m = ((i + 0.5) / count - 0.5) * length_m;
    const Eigen::Vector2d off_m = along_x(space) ? Eigen::Vector2d(at_m, 0.0) : Eigen::Vector2d(0.0, at_m);
    lamps.push_back(build_lamp(scene, middle_m + off_m, 0.8, random));
  }
  return lamps;
}

}  // namespace

World generate_circuit(std::uint64_t seed) {
  Random random(seed * 9176 + 23);
  SceneBuilder scene;
  CircuitPlan plan = plan_circuit(random);
  constexpr std::array kOutside = {Side::kSouth, Side::kSouth, Side::kEast,  Side::kNorth,
                                   Side::kWest,  Side::kNorth, Side::kNorth, Side::kWest};
  for (std::size_t i = 0; i < plan.spaces.size(); ++i)
    finish_corridor(scene, plan.spaces[i], plan.openings, kOutside[i], random);
  World world;
  for (const Space& space : plan.spaces) build_shell(scene, space, plan.openings, random);
  world.doors = build_linings(scene, plan.openings, random);
  const CorridorMaterials materials = corridor_materials(scene, random);
  constexpr int kRugs = 4;
  std::vector<int> rugs;
  rugs.reserve(kRugs);
  for (int i = 0; i < kRugs; ++i) rugs.push_back(scene.add_material("rug", paint_rug(random)));
  for (const Doorway& doorway : plan.openings) {
    if (doorway.width_m == kNarrow_m) build_open_leaf(scene, doorway, materials, random);
  }
  for (const Space& space : plan.spaces) {
    const bool furnished = wide_m(space) >= kFurnished_m;
    const Side first = along_x(space) ? Side::kSouth : Side::kEast;
    const Side second = along_x(space) ? Side::kNorth : Side::kWest;
    const bool first_is_deep = pick(random, 2) == 0;
    for (const bool is_first : {true, false}) {
      const auto placed = dress_wall(scene, space, is_first ? first : second, plan.openings,
                                     furnished && is_first == first_is_deep, materials, random);
      world.furniture.insert(world.furniture.end(), placed.begin(), placed.end());
    }
    // The ends, where the way turns off.
    for (const Side end :
         along_x(space) ? std::array{Side::kEast, Side::kWest} : std::array{Side::kSouth, Side::kNorth})
      dress_wall(scene, space, end, plan.openings, false, materials, random);
    lay_mats(scene, space, rugs, random);
    const auto lamps = hang_lamps(scene, space, random);
    world.lamps.insert(world.lamps.end(), lamps.begin(), lamps.end());
  }
  world.name = "circuit:" + std::to_string(seed);
  world.round = true;
  world.scene = scene.take();
  finish_world(world, plan.spaces);
  return world;
}

}  // namespace homeward::sim
