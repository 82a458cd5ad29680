// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/furnish.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

struct Plan {
  std::vector<Space> spaces;
  std::vector<Doorway> doorways;
};

struct Recipe {
  std::vector<Piece> along_walls;
  std::vector<Piece> central;
  int pictures = 2;
  bool rug = true;
  bool tiled = false;
};

Recipe recipe_of(const std::string& room) {
  using enum Piece;
  if (room == "kitchen") return {{kCounter, kFridge, kSideboard, kPlant}, {kTableWithChairs}, 2, false, true};
  if (room == "living_room")
    return {{kSofa, kTelevision, kBookshelf, kArmchair, kPlant, kSideboard}, {}, 4, true, false};
  if (room == "bedroom") return {{kBed, kWardrobe, kNightstand, kArmchair, kPlant}, {}, 3, true, false};
  if (room == "study") return {{kDesk, kBookshelf, kBookshelf, kArmchair, kPlant}, {}, 3, true, false};
  if (room == "dining_room") return {{kSideboard, kBookshelf, kPlant}, {kTableWithChairs}, 4, false, false};
  if (room == "bathroom") return {{kBath, kBasin, kWashingMachine, kPlant}, {}, 1, false, true};
  if (room == "guest_room") return {{kBed, kDesk, kWardrobe, kNightstand}, {}, 3, true, false};
  if (room == "music_room") return {{kPiano, kSofa, kBookshelf, kConsole, kPlant}, {}, 4, true, false};
  return {};
}

Surface material(SceneBuilder& scene, const char* name, Image texture, double tile_m) {
  return {scene.add_material(name, std::move(texture)), tile_m};
}

void dress(SceneBuilder& scene, Space& space, bool tiled, Random& random) {
  constexpr std::array<Rgb, 7> kWalls = {{{222, 210, 180},
                                          {190, 205, 200},
                                          {205, 185, 170},
                                          {185, 195, 215},
                                          {215, 200, 205},
                                          {196, 204, 172},
                                          {226, 220, 208}}};
  const Rgb wall = varied(random, kWalls[static_cast<std::size_t>(pick(random, kWalls.size()))], 10);
  if (tiled) {
    space.wall = material(scene, "wall tiles", paint_tiles(random, wall, varied(random, wall, 14)), 1.3);
    space.floor =
        material(scene, "floor tiles", paint_tiles(random, varied(random, {150, 145, 140}, 25), {185, 182, 176}), 1.7);
  } else {
    space.wall =
        material(scene, "wallpaper", paint_wallpaper(random, wall, static_cast<Wallpaper>(pick(random, 5))), 1.5);
    space.floor = material(scene, "planks", paint_planks(random, varied(random, {165, 120, 78}, 25)), 2.0);
  }
  space.ceiling = material(scene, "ceiling", paint_wallpaper(random, {232, 230, 224}, Wallpaper::kPlaster), 2.5);
}

/// Two corridors: one from west to east, one from its middle to the south; rooms on all sides.
Plan plan_house(SceneBuilder& scene, double door_m, Random& random) {
  const double width = uniform(random, 18.2, 19.2);
  constexpr double kCorridor_m = 2.0;
  const double north = kCorridor_m + uniform(random, 4.5, 5.0);
  const double side_west = uniform(random, 6.8, 7.4);
  const double side_east = side_west + kCorridor_m;
  const double middle = -uniform(random, 4.3, 4.7);
  const double south = middle - uniform(random, 4.2, 4.6);
  const std::array<double, 5> x = {0.0, uniform(random, 4.4, 4.9), uniform(random, 9.4, 10.1),
                                   uniform(random, 13.9, 14.5), width};
  Plan plan;
  const auto add = [&](const std::string& name, double x0, double y0, double x1, double y1) {
    plan.spaces.push_back({name, {x0, y0}, {x1, y1}, {}, {}, {}, {}});
  };
  const auto door = [&](double at_x, double at_y, bool in_x_wall) {
    plan.doorways.push_back({{at_x, at_y}, in_x_wall, door_m, 2.1, true});
  };
  add("hall", 0.0, 0.0, width, kCorridor_m);
  add("", side_west, south, side_east, 0.0);
  plan.doorways.push_back({{side_west + 0.5 * kCorridor_m, 0.0}, true, 1.7, 2.3, false});
  const std::array<std::string, 4> upper = {"kitchen", "living_room", "study", "bedroom"};
  for (std::size_t i = 0; i < 4; ++i) {
    add(upper[i], x[i], kCorridor_m, x[i + 1], north);
    door(x[i] + uniform(random, 1.3, x[i + 1] - x[i] - 1.9), kCorridor_m, true);
  }
  add("dining_room", 0.0, middle, side_west, 0.0);
  door(uniform(random, 2.0, side_west - 2.2), 0.0, true);
  add("bathroom", 1.6, south, side_west, middle);
  door(side_west, 0.5 * (south + middle) + uniform(random, -0.6, 0.6), false);
  const double split = uniform(random, 13.8, 14.4);
  add("guest_room", side_east, middle, split, 0.0);
  door(side_east, 0.5 * middle + uniform(random, -0.5, 0.5), false);
  add("music_room", side_east, south, split, middle);
  door(side_east, 0.5 * (south + middle) + uniform(random, -0.6, 0.6), false);
  for (Space& space : plan.spaces) {
    const Recipe recipe = recipe_of(space.name);
    dress(scene, space, recipe.tiled, random);
    const double along_x = space.most_m.x() - space.least_m.x() - 2.0 * kHalfWall_m;
    const double along_y = space.most_m.y() - space.least_m.y() - 2.0 * kHalfWall_m;
    const bool is_upper = space.least_m.y() > 1.0;
    if (is_upper) space.windows.push_back({Side::kNorth, along_x * uniform(random, 0.35, 0.65), 1.7});
    if (space.name == "kitchen" || space.name == "dining_room")
      space.windows.push_back({Side::kWest, 0.5 * along_y, 1.5});
    if (space.name == "bedroom" || space.name == "guest_room")
      space.windows.push_back({Side::kEast, 0.5 * along_y, 1.5});
    if (space.name == "bathroom") space.windows.push_back({Side::kSouth, 0.4 * along_x, 1.2});
    if (space.name == "music_room") space.windows.push_back({Side::kSouth, 0.6 * along_x, 1.8});
    if (space.name == "hall") space.windows.push_back({Side::kEast, 0.5 * along_y, 0.9});
  }
  return plan;
}

std::vector<Furniture> furnish(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways,
                               Random& random) {
  Furnisher furnisher(scene, space, doorways);
  const bool corridor = space.name.empty() || space.name == "hall";
  const Eigen::Vector2d middle_m = 0.5 * (space.least_m + space.most_m);
  if (corridor) {
    const bool along_x = space.name == "hall";
    const double length_m = along_x ? space.most_m.x() - space.least_m.x() : space.most_m.y() - space.least_m.y();
    for (double at = 2.2; at < length_m - 1.5; at += uniform(random, 4.0, 5.5)) {
      const Eigen::Vector2d centre_m = along_x ? Eigen::Vector2d(space.least_m.x() + at, middle_m.y())
                                               : Eigen::Vector2d(middle_m.x(), space.least_m.y() + at);
      furnisher.lay_rug(centre_m, along_x ? Eigen::Vector2d(2.6, 0.9) : Eigen::Vector2d(0.9, 2.6), random);
    }
    furnisher.place(Piece::kConsole, random);
    furnisher.place(Piece::kCoats, random);
    furnisher.place(Piece::kConsole, random);
    if (along_x) furnisher.place(Piece::kCoats, random);
    furnisher.hang_pictures(along_x ? 12 : 7, random);
    return furnisher.furniture();
  }
  const Recipe recipe = recipe_of(space.name);
  for (const Piece piece : recipe.along_walls) furnisher.place(piece, random);
  for (const Piece piece : recipe.central) furnisher.place_central(piece, random);
  if (recipe.rug) {
    furnisher.lay_rug(middle_m + Eigen::Vector2d(uniform(random, -0.4, 0.4), uniform(random, -0.4, 0.4)),
                      {uniform(random, 1.9, 2.5), uniform(random, 1.3, 1.8)}, random);
  }
  furnisher.hang_pictures(recipe.pictures, random);
  return furnisher.furniture();
}

std::vector<Lamp> light(SceneBuilder& scene, const std::vector<Space>& spaces, Random& random) {
  std::vector<Lamp> lamps;
  for (const Space& space : spaces) {
    const Eigen::Vector2d size_m = space.most_m - space.least_m;
    const int along_x = std::max(1, static_cast<int>(size_m.x() / 4.5));
    const int along_y = std::max(1, static_cast<int>(size_m.y() / 5.5));
    for (int i = 0; i < along_x; ++i) {
      for (int j = 0; j < along_y; ++j) {
        const Eigen::Vector2d at_m(space.least_m.x() + (i + 0.5) * size_m.x() / along_x,
                                   space.least_m.y() + (j + 0.5) * size_m.y() / along_y);
        lamps.push_back(build_lamp(scene, at_m, 1.0, random));
      }
    }
  }
  return lamps;
}

World generate(std::uint64_t seed, double door_m) {
  // Furniture may, rarely, shut off a room; the next draw of the same seed is then taken.
  constexpr std::uint64_t kDraws = 20;
  World world;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    Random random(seed * 7919 + draw * 104729 + 17);
    SceneBuilder scene;
    const Plan plan = plan_house(scene, door_m, random);
    for (const Space& space : plan.spaces) build_shell(scene, space, plan.doorways, random);
    const std::vector<DoorOpening> doors = build_linings(scene, plan.doorways, random);
    world = World();
    world.doors = doors;
    for (const Space& space : plan.spaces) {
      const std::vector<Furniture> placed = furnish(scene, space, plan.doorways, random);
      world.furniture.insert(world.furniture.end(), placed.begin(), placed.end());
    }
    world.lamps = light(scene, plan.spaces, random);
    world.scene = scene.take();
    if (finish_world(world, plan.spaces)) break;
  }
  return world;
}

}  // namespace

World generate_house(std::uint64_t seed) {
  World world = generate(seed, 1.15);
  world.name = "house:" + std::to_string(seed);
  return world;
}

World generate_narrow_house(std::uint64_t seed) {
  World world = generate(seed, 0.85);
  world.name = "narrow_house:" + std::to_string(seed);
  return world;
}

}  // namespace homeward::sim
