// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/ids.hpp"
#include "wire/belief_json.hpp"
#include "wire/link_messages.hpp"
#include "wire/mission_json.hpp"

namespace homeward::wire {

/// Who may drive a robot, and for how long without a sign of life.
struct LeaseView {
  std::optional<std::string> id;  // told to the holder alone
  std::string holder;             // user name
  std::int64_t epoch = 0;
  std::int64_t expires_in_ms = 0;
};

/// A robot as the dashboard sees it (proto/schemas/robot.schema.json).
struct RobotView {
  RobotId id;
  std::string name;
  bool online = false;
  std::optional<MapId> map;
  std::optional<DriveState> state;  // as last told by the agent
  std::optional<Reason> reason;     // why the agent stopped or failed
  std::optional<double> speed_mps;
  std::optional<HomeReport> home;
  std::optional<double> min_range_m;
  std::optional<BeliefView> belief;
  std::optional<MissionView> mission;                     // the latest one
  std::optional<QuestionReport> question = std::nullopt;  // nothing: it asks nothing, or somebody has answered
  std::optional<LeaseView> lease;
  std::optional<std::int64_t> status_age_ms;  // since the agent's last status
};

/// With the key "id" only where the view has one.
nlohmann::json lease_to_json(const LeaseView& lease);
nlohmann::json robot_to_json(const RobotView& robot);

}  // namespace homeward::wire
