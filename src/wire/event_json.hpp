// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "wire/draft_json.hpp"
#include "wire/exploration_json.hpp"
#include "wire/job_json.hpp"
#include "wire/map_info_json.hpp"
#include "wire/mission_json.hpp"
#include "wire/plan_pose_json.hpp"
#include "wire/robot_json.hpp"

namespace homeward::wire {

inline constexpr int kEventVersion = 1;

/// The first message to every dashboard: everything there is, but for drafts, which those ask for who look at a map.
struct Snapshot {
  std::string build;  // of the server, so that a page made for another one can reload itself
  std::vector<RobotView> robots;
  std::vector<JobView> jobs;
  std::vector<MapInfoView> maps;
};

/// How far a robot's exploration is.
struct ExplorationView {
  RobotId robot;
  std::shared_ptr<const ExplorationReport> exploration;  // never null; large, and the same for all who hear of it
};

/// Where a robot is on the plan that its map lies on.
struct PlanPoseTold {
  std::shared_ptr<const PlanPoseView> pose;  // never null; large, and the same for all who hear of it
};

/// Says that the server lives, where nothing else is to be said.
struct Heartbeat {};

using Event = std::variant<Snapshot, RobotView, JobView, MapInfoView, MissionView, DraftView, DraftGone,
                           ExplorationView, PlanPoseTold, Heartbeat>;

/// One message to dashboards (proto/schemas/event.schema.json): {type, v, seq, ...}. `seq` rises by one with each
/// message of a running server.
nlohmann::json event_to_json(const Event& event, std::int64_t seq);

}  // namespace homeward::wire
