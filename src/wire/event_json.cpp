// SPDX-License-Identifier: Apache-2.0
#include "wire/event_json.hpp"

#include <nlohmann/json.hpp>

namespace homeward::wire {
namespace {

using nlohmann::json;

json body(const Snapshot& snapshot) {
  json value = {{"type", "snapshot"},
                {"build", snapshot.build},
                {"robots", json::array()},
                {"jobs", json::array()},
                {"maps", json::array()}};
  for (const RobotView& robot : snapshot.robots) value["robots"].push_back(robot_to_json(robot));
  for (const JobView& job : snapshot.jobs) value["jobs"].push_back(job_to_json(job));
  for (const MapInfoView& map : snapshot.maps) value["maps"].push_back(map_info_to_json(map));
  return value;
}

json body(const RobotView& robot) { return {{"type", "robot"}, {"robot", robot_to_json(robot)}}; }
json body(const JobView& job) { return {{"type", "job"}, {"job", job_to_json(job)}}; }
json body(const MapInfoView& map) { return {{"type", "map"}, {"map", map_info_to_json(map)}}; }
json body(const MissionView& mission) { return {{"type", "mission"}, {"mission", mission_to_json(mission)}}; }
json body(const DraftView& draft) { return {{"type", "draft"}, {"draft", draft_to_json(draft)}}; }
json body(const DraftGone& gone) {
  return {{"type", "draft_gone"}, {"map", gone.map.str()}, {"draft", gone.draft.str()}};
}
json body(const ExplorationView& view) {
  return {
      {"type", "exploration"}, {"robot", view.robot.str()}, {"exploration", exploration_to_json(*view.exploration)}};
}
json body(const PlanPoseTold& told) { return {{"type", "plan_pose"}, {"pose", plan_pose_to_json(*told.pose)}}; }
json body(const Heartbeat&) { return {{"type", "heartbeat"}}; }

}  // namespace

json event_to_json(const Event& event, std::int64_t seq) {
  json value = std::visit([](const auto& what) { return body(what); }, event);
  value["v"] = kEventVersion;
  value["seq"] = seq;
  return value;
}

}  // namespace homeward::wire
