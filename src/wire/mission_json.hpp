// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// kAccepted: sent, not yet confirmed by the robot. The last four are final.
enum class MissionState { kAccepted, kDriving, kArrived, kRefused, kStopped, kFailed };

/// "accepted", "driving", "arrived", "refused", "stopped", "failed".
std::string_view mission_state_name(MissionState state);
std::optional<MissionState> mission_state(std::string_view name);

/// "drive": to a place of a map; "explore": through a building that the robot maps by itself.
enum class MissionKind { kDrive, kExplore };

std::string_view mission_kind_name(MissionKind kind);
std::optional<MissionKind> mission_kind(std::string_view name);

/// One drive of a robot (proto/schemas/mission.schema.json). One that explores has neither map, place nor path.
struct MissionView {
  MissionId id;
  RobotId robot;
  MissionKind kind = MissionKind::kDrive;
  std::optional<ExplorationId> exploration = std::nullopt;
  MapId map;
  std::int64_t revision = 0;                 // of the map that the path was planned on
  std::optional<DestinationId> destination;  // nothing when a place was asked for
  PlaceId place;
  MissionState state = MissionState::kAccepted;
  std::optional<Reason> reason;  // why it ended without arriving, or what was not right when it arrived
  std::int64_t epoch = 0;
  std::int64_t seq = 0;
  std::vector<PlaceId> path;
  std::int64_t path_index = 0;  // the place in `path` that the robot drives to
  /// What the robot states of being within half a metre of its destination: while it drives as of now, afterwards as it
  /// ended. Nothing: not known.
  std::optional<double> arrival_probability = std::nullopt;
  TimeUs created_us = 0;
  std::optional<TimeUs> ended_us = std::nullopt;  // nothing: it has not, or nobody knows when
  std::string by;                                 // user name
};

nlohmann::json mission_to_json(const MissionView& mission);

/// Strict. Errors: kInvalidInput, kUnsupportedFormat.
Result<MissionView> mission_from_json(const nlohmann::json& value, const std::string& path = "mission");

}  // namespace homeward::wire
