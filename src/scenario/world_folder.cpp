// SPDX-License-Identifier: Apache-2.0
#include "scenario/world_folder.hpp"

#include <array>
#include <charconv>
#include <optional>

#include "files/grey_map.hpp"
#include "files/read_file.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/mesh_import.hpp"
#include "wire/scenario_json.hpp"
#include "wire/world_json.hpp"

namespace homeward::scenario {

namespace fs = std::filesystem;

namespace {

/// The seed behind "house:" and the like, or nothing when the name is not of this kind.
Result<std::optional<std::uint64_t>> seed_after(const std::string& name, const std::string& kind) {
  if (!name.starts_with(kind + ":")) return std::optional<std::uint64_t>();
  const std::string digits = name.substr(kind.size() + 1);
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
    return fail(ErrorCode::kInvalidInput, "'" + digits + "' is no seed: a number is wanted after '" + kind + ":'.",
                name);
  }
  return std::optional(seed);
}

Result<sim::FloorGrid> read_grid(const fs::path& folder, const wire::FloorPicture& picture) {
  const auto grey = files::read_grey_map(folder / picture.image);
  if (!grey) return pass_on(grey);
  sim::FloorGrid grid;
  grid.width = grey->width_px;
  grid.height = grey->height_px;
  grid.resolution_m = picture.resolution_m;
  grid.origin_m = picture.origin_m;
  grid.robot_radius_m = picture.robot_radius_m;
  grid.cells = grey->data;
  return grid;
}

Result<sim::World> read_world(const fs::path& file) {
  const auto text = files::read_text(file);
  if (!text) return pass_on(text);
  const auto described = wire::parse_world(*text, file.string());
  if (!described) return pass_on(described);
  const fs::path folder = file.parent_path();
  const fs::path mesh = folder / described->mesh;
  const auto bytes = files::read_text(mesh);
  if (!bytes) return pass_on(bytes);
  std::string extension = mesh.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  auto scene = sim::import_mesh({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()}, extension,
                                described->mesh_y_up ? sim::MeshUp::kY : sim::MeshUp::kZ, mesh.string());
  if (!scene) return pass_on(scene);
  sim::World world;
  world.name = described->name;
  world.scene = std::move(*scene);
  world.start = described->start;
  for (const wire::WorldRoom& room : described->rooms) {
    world.rooms.push_back({room.name, room.x_m, room.y_m, room.outline_m});
  }
  for (const wire::WorldLamp& lamp : described->lamps) world.lamps.push_back({lamp.position_m, lamp.strength});
  if (described->occupancy) {
    auto grid = read_grid(folder, *described->occupancy);
    if (!grid) return pass_on(grid);
    for (std::uint8_t& cell : grid->cells) cell = cell == 0 ? 255 : 0;
    world.occupied = std::move(*grid);
  } else {
    world.occupied = sim::occupied_cells(world.scene, 0.05);
  }
  if (described->drivable) {
    auto grid = read_grid(folder, *described->drivable);
    if (!grid) return pass_on(grid);
    world.drivable = std::move(*grid);
  } else {
    constexpr double kRadius_m = 0.35;
    world.drivable = sim::drivable_cells(world.occupied, kRadius_m, world.start);
  }
  return world;
}

}  // namespace

Result<sim::World> load_world(const std::string& name) {
  struct Kind {
    const char* name;
    sim::World (*generate)(std::uint64_t seed);
  };
  constexpr std::array kKinds = {Kind{"house", sim::generate_house},
                                 Kind{"narrow_house", sim::generate_narrow_house},
                                 Kind{"offices", sim::generate_offices},
                                 Kind{"wards", sim::generate_wards},
                                 Kind{"laboratory", sim::generate_systems_laboratory},
                                 Kind{"circuit", sim::generate_circuit},
                                 Kind{"course", sim::generate_course}};
  for (const Kind& kind : kKinds) {
    const auto seed = seed_after(name, kind.name);
    if (!seed) return pass_on(seed);
    if (*seed) return kind.generate(**seed);
  }
  std::error_code error;
  return read_world(fs::is_directory(name, error) ? fs::path(name) / "world.json" : fs::path(name));
}

Result<sim::Light> light_named(const std::string& name) {
  if (name == "day") return sim::LightPreset::kDay;
  if (name == "night") return sim::LightPreset::kNight;
  if (name == "half") return sim::LightPreset::kHalf;
  if (const auto level = wire::daylight_of(name)) return sim::Light::of_daylight(*level);
  if (name.starts_with("daylight:")) {
    return fail(ErrorCode::kInvalidInput,
                "'" + name.substr(std::string("daylight:").size()) +
                    "' is no level of daylight: a number from 0 (night) to 1 (day) is wanted after 'daylight:'.",
                "light");
  }
  return fail(ErrorCode::kInvalidInput,
              "The light '" + name + "' is not known; there are day, night, half and daylight:0 to daylight:1.",
              "light");
}

}  // namespace homeward::scenario
