// SPDX-License-Identifier: Apache-2.0
#include "wire/scenario_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "wire/camera_json.hpp"
#include "wire/json_reader.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr int kMaxRandom = 10'000;
constexpr double kUsualSlip = 0.5;
constexpr double kMostSlip = 0.95;

std::string light_of(ObjectReader& reader) {
  if (!reader.has("light")) return "day";
  const std::string light = reader.text("light", 40);
  constexpr std::array kNames = {"day", "night", "half"};
  if (std::ranges::find(kNames, light) == kNames.end() && !daylight_of(light)) {
    reader.problem("light", "'light' must be day, night, half or daylight:LEVEL with a level from 0 to 1, not '" +
                                shown(light) + "'.");
  }
  return light;
}

ScenarioFault read_fault(ObjectReader& outer, const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  ScenarioFault fault;
  fault.kind = reader.choice("kind", kFaultKindNames);
  const bool slips = fault.kind == FaultKind::kWheelSlip;
  if (slips) fault.share = kUsualSlip;
  fault.at_s = reader.number("at_s", 0.0, 1e5);
  if (reader.has("for_s")) fault.for_s = reader.number("for_s", 0.0, 1e5);
  if (reader.has("share")) fault.share = reader.number("share", 0.0, slips ? kMostSlip : 1.0);
  if (fault.kind == FaultKind::kKidnapped) fault.for_s = 0.0;  // lifted and put down in a moment
  outer.close(reader);
  return fault;
}

/// What only paths that are repeated have.
void read_repeat(ObjectReader& reader, ScenarioMission& mission) {
  if (reader.has("times")) mission.times = static_cast<int>(reader.integer("times", 1, kMaxRandom));
  if (reader.has("start_beside_m")) mission.start_beside_m = reader.number("start_beside_m", 0.0, 2.0);
  if (reader.has("start_turned_rad")) mission.start_turned_rad = reader.number("start_turned_rad", 0.0, 3.15);
  if (reader.has("rounds")) mission.rounds = static_cast<int>(reader.integer("rounds", 0, 1000));
  if (reader.has("steering")) mission.steering = reader.choice("steering", kRepeatSteeringNames);
}

ScenarioMission read_mission(ObjectReader& outer, const json& value, const std::string& path, ScenarioMode mode) {
  ObjectReader reader(value, path);
  ScenarioMission mission;
  if (mode == ScenarioMode::kRepeat) read_repeat(reader, mission);
  if (mode == ScenarioMode::kHome && reader.has("random")) {
    mission.random = static_cast<int>(reader.integer("random", 1, kMaxRandom));
  } else {
    mission.from = reader.text("from", 200);
    mission.to = reader.text("to", 200);
  }
  mission.light = light_of(reader);
  if (reader.has("people")) mission.people = static_cast<int>(reader.integer("people", 0, 100));
  if (reader.has("moved_furniture"))
    mission.moved_furniture = static_cast<int>(reader.integer("moved_furniture", 0, 1000));
  if (reader.has("answers")) mission.answers = reader.choice("answers", {"nobody", "right", "yes"});
  if (reader.has("faults")) {
    const std::vector<json> faults = reader.array("faults", 100);
    for (std::size_t i = 0; i < faults.size(); ++i) {
      mission.faults.push_back(read_fault(reader, faults[i], reader.path_of("faults") + "/" + std::to_string(i)));
    }
  }
  outer.close(reader);
  return mission;
}

/// {"model": name} alone is the usual camera of that model; with more it is a whole camera.json; text is the path of
/// one.
void read_camera(ObjectReader& outer, ScenarioFile& scenario) {
  const json& value = outer.value("camera");
  if (value.is_string()) {
    scenario.camera_file = outer.text("camera", 1000);
    return;
  }
  if (value.is_object() && value.size() > 1) {
    scenario.camera = outer.take(camera_from_json(value, outer.path_of("camera")));
    return;
  }
  ObjectReader reader(value, outer.path_of("camera"));
  scenario.camera_model = reader.choice("model", {"hyperbolic_mirror", "equirectangular", "pinhole"});
  outer.close(reader);
}

void read_rooms(ObjectReader& tour, std::vector<std::string>& rooms) {
  for (const json& room : tour.array("rooms", 1000)) {
    if (!room.is_string()) {
      tour.problem("rooms", "Each of 'rooms' must be a room's name.");
      break;
    }
    rooms.push_back(room.get<std::string>());
  }
}

void read_tour(ObjectReader& outer, ScenarioFile& scenario) {
  ObjectReader reader(outer.value("tour"), outer.path_of("tour"));
  if (reader.value("rooms").is_string()) {
    scenario.tour_explored = reader.choice("rooms", {"all", "explored"}) == "explored";
    scenario.tours_all_rooms = true;
  } else {
    read_rooms(reader, scenario.tour_rooms);
  }
  scenario.tour_light = light_of(reader);
  if (reader.has("step_m")) scenario.tour_step_m = reader.number("step_m", 0.05, 5.0);
  if (reader.has("shortcuts")) scenario.tour_shortcuts = reader.boolean("shortcuts");
  outer.close(reader);
}

}  // namespace

std::optional<double> daylight_of(const std::string& light) {
  constexpr std::string_view kPrefix = "daylight:";
  if (!light.starts_with(kPrefix)) return std::nullopt;
  const std::string_view level = std::string_view(light).substr(kPrefix.size());
  const bool is_plain = level.find_first_not_of("0123456789.") == std::string_view::npos && !level.ends_with('.');
  if (!is_plain || (level.size() > 1 && level[1] != '.')) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(level.data(), level.data() + level.size(), value);
  if (error != std::errc() || end != level.data() + level.size() || value > 1.0) return std::nullopt;
  return value;
}

Result<ScenarioFile> scenario_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-scenario", 1);
  ScenarioFile scenario;
  scenario.world = reader.text("world", 1000);
  scenario.seed = reader.integer("seed", 0, 1'000'000'000);
  if (reader.has("mode")) scenario.mode = reader.choice("mode", kScenarioModeNames);
  read_camera(reader, scenario);
  if (reader.has("robot")) scenario.robot = reader.choice("robot", {"disc", "chair"});
  if (reader.has("ranges")) scenario.ranges = reader.choice("ranges", {"laser", "ultrasound"});
  if (reader.has("speed_limit_mps")) scenario.speed_limit_mps = reader.number("speed_limit_mps", 0.05, 2.0);
  read_tour(reader, scenario);
  const std::vector<json> missions = reader.array("missions", 10'000);
  for (std::size_t i = 0; i < missions.size(); ++i) {
    scenario.missions.push_back(
        read_mission(reader, missions[i], reader.path_of("missions") + "/" + std::to_string(i), scenario.mode));
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return scenario;
}

Result<ScenarioFile> parse_scenario(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return scenario_from_json(*value, where);
}

}  // namespace homeward::wire
