// SPDX-License-Identifier: Apache-2.0
#include "wire/mission_json.hpp"

#include <array>
#include <limits>

#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 6> kMissionStates = {"accepted", "driving", "arrived",
                                                            "refused",  "stopped", "failed"};
constexpr EnumNames<MissionKind, 2> kKinds({"drive", "explore"});
constexpr int kMissionVersion = 2;  // version 1 had words instead of reasons
constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();

std::vector<PlaceId> read_path(ObjectReader& reader) {
  std::vector<PlaceId> path;
  for (const json& item : reader.array("path", 2000)) {
    if (!item.is_string()) reader.problem("path", "'path' must list ids of places.");
    path.emplace_back(item.is_string() ? item.get<std::string>() : std::string());
  }
  return path;
}

}  // namespace

std::string_view mission_state_name(MissionState state) { return kMissionStates[static_cast<std::size_t>(state)]; }

std::optional<MissionState> mission_state(std::string_view name) {
  for (std::size_t i = 0; i < kMissionStates.size(); ++i) {
    if (kMissionStates[i] == name) return static_cast<MissionState>(i);
  }
  return std::nullopt;
}

std::string_view mission_kind_name(MissionKind kind) { return kKinds.name(kind); }

std::optional<MissionKind> mission_kind(std::string_view name) { return kKinds.find(name); }

json mission_to_json(const MissionView& mission) {
  return {{"format", "homeward-mission"},
          {"version", kMissionVersion},
          {"id", mission.id.str()},
          {"robot", mission.robot.str()},
          {"kind", mission_kind_name(mission.kind)},
          {"exploration", or_null(mission.exploration)},
          {"map", mission.map.empty() ? json() : json(mission.map.str())},
          {"revision", mission.revision},
          {"destination", or_null(mission.destination)},
          {"place", mission.place.empty() ? json() : json(mission.place.str())},
          {"state", mission_state_name(mission.state)},
          {"reason", reason_to_json(mission.reason)},
          {"epoch", mission.epoch},
          {"seq", mission.seq},
          {"path", ids_to_json(mission.path)},
          {"path_index", mission.path_index},
          {"arrival_probability", or_null(mission.arrival_probability)},
          {"created_us", mission.created_us},
          {"ended_us", or_null(mission.ended_us)},
          {"by", mission.by}};
}

Result<MissionView> mission_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-mission", kMissionVersion);
  MissionView mission;
  mission.id = MissionId(reader.text("id", 100));
  mission.robot = RobotId(reader.text("robot", 100));
  mission.kind = reader.choice("kind", kKinds);
  if (!reader.value("exploration").is_null()) mission.exploration = ExplorationId(reader.text("exploration", 100));
  if (!reader.value("map").is_null()) mission.map = MapId(reader.text("map", 100));
  mission.revision = reader.integer("revision", 0, kLargest);
  if (!reader.value("destination").is_null()) mission.destination = DestinationId(reader.text("destination", 100));
  if (!reader.value("place").is_null()) mission.place = PlaceId(reader.text("place", 100));
  const std::string state = reader.choice("state", {kMissionStates.begin(), kMissionStates.end()});
  mission.state = mission_state(state).value_or(MissionState::kFailed);
  if (const json& reason = reader.value("reason"); !reason.is_null())
    mission.reason = reader.take(reason_from_json(reason, reader.path_of("reason")));
  mission.epoch = reader.integer("epoch", 0, kLargest);
  mission.seq = reader.integer("seq", 0, kLargest);
  mission.path = read_path(reader);
  mission.path_index = reader.integer("path_index", 0, 2000);
  if (!reader.value("arrival_probability").is_null())
    mission.arrival_probability = reader.number("arrival_probability", 0.0, 1.0);
  mission.created_us = reader.integer("created_us", 0, kLargest);
  if (!reader.value("ended_us").is_null()) mission.ended_us = reader.integer("ended_us", 0, kLargest);
  mission.by = reader.text("by", 200);
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return mission;
}

}  // namespace homeward::wire
