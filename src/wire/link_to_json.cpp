// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <nlohmann/json.hpp>

#include "wire/camera_json.hpp"
#include "wire/json_write.hpp"
#include "wire/link_companion.hpp"
#include "wire/link_messages.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

json start(const char* type) { return {{"type", type}, {"v", kLinkVersion}}; }

json write(const Hello& m) {
  json value = start("hello");
  value["agent"] = m.agent;
  value["robot_name"] = m.robot_name;
  value["session"] = m.session;
  value["camera"] = camera_to_json(m.camera);
  value["radius_m"] = m.radius_m;
  value["max_speed_mps"] = m.max_speed_mps;
  if (m.explores) value["explores"] = true;
  if (m.repeats) value["repeats"] = true;
  return value;
}

json write(const Frame& m) {
  json value = start("frame");
  value["seq"] = m.seq;
  value["t_us"] = m.t_us;
  value["jpeg"] = json::binary(m.jpeg);
  if (m.odometry) {
    value["odometry"] = {{"x_m", m.odometry->x_m}, {"y_m", m.odometry->y_m}, {"theta_rad", m.odometry->theta_rad}};
  }
  return value;
}

json estimate_to_json(const EstimateReport& estimate) {
  return {{"place", estimate.place.str()}, {"probability", estimate.probability}};
}

json write(const AgentStatus& m) {
  json value = start("status");
  value["seq"] = m.seq;
  value["t_us"] = m.t_us;
  value["state"] = drive_state_name(m.state);
  value["mission"] = or_null(m.mission);
  value["epoch"] = m.epoch;
  value["path_index"] = m.path_index;
  value["reason"] = reason_to_json(m.reason);
  value["speed_mps"] = m.speed_mps;
  value["home"] = nullptr;
  if (m.home) {
    value["home"] = {
        {"bearing_rad", m.home->bearing_rad}, {"confidence", m.home->confidence}, {"inliers", m.home->inliers}};
  }
  value["min_range_m"] = or_null(m.min_range_m);
  value["vectors_per_s"] = m.vectors_per_s;
  value["arrival_probability"] = or_null(m.arrival_probability);
  value["estimate"] = nullptr;
  if (m.estimate) value["estimate"] = estimate_to_json(*m.estimate);
  value["possible_places"] = json::array();
  for (const EstimateReport& place : m.possible_places) value["possible_places"].push_back(estimate_to_json(place));
  value["question"] = nullptr;
  if (m.question) value["question"] = question_to_json(*m.question);
  value["displaced"] = m.displaced;
  value["astray"] = m.astray;
  return value;
}

json write(const Stopped& m) {
  json value = start("stopped");
  value["stop_id"] = m.stop_id;
  value["t_us"] = m.t_us;
  return value;
}

void add_order(json& value, const Order& order) {
  value["epoch"] = order.epoch;
  value["seq"] = order.seq;
}

json write(const MissionRefused& m) {
  json value = start("mission_refused");
  value["mission"] = m.mission.str();
  add_order(value, m.order);
  value["reason"] = reason_to_json(m.reason);
  return value;
}

json write(const Welcome& m) {
  json value = start("welcome");
  value["server"] = m.server;
  value["robot"] = m.robot.str();
  value["epoch"] = m.epoch;
  value["frame_period_ms"] = m.frame_period_ms;
  return value;
}

json edge_to_json(const std::optional<PathEdge>& edge) {
  if (!edge) return nullptr;
  json value = {{"bearing_rad", or_null(edge->bearing_rad)},
                {"turn_rad", or_null(edge->turn_rad)},
                {"length_m", or_null(edge->length_m)},
                {"weak", edge->weak}};
  if (edge->shortcut) value["shortcut"] = true;
  return value;
}

json pose_to_json(const Pose2& pose) { return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}}; }

json surroundings_to_json(const Surroundings& around) {
  json value = {{"path", json::array()},
                {"final", pose_to_json(around.final_pose)},
                {"spread_m", around.spread_m},
                {"start_probability", around.start_probability},
                {"nearby", json::array()}};
  for (const Pose2& pose : around.path) value["path"].push_back(pose_to_json(pose));
  for (const PlacedView& view : around.nearby) {
    value["nearby"].push_back({{"place", view.place.str()},
                               {"image", view.image.str()},
                               {"pose", pose_to_json(view.map_from_view)},
                               {"appearance", json::binary(view.appearance)}});
  }
  if (!around.ways.empty()) value["ways"] = around.ways;
  return value;
}

json write(const MissionOrder& m) {
  json value = start("mission");
  value["mission"] = m.mission.str();
  add_order(value, m.order);
  value["map"] = m.map.str();
  value["revision"] = m.revision;
  value["feature_config_id"] = m.feature_config_id;
  value["valid_for_ms"] = m.valid_for_ms;
  value["speed_limit_mps"] = m.speed_limit_mps;
  value["label"] = m.label;
  value["path"] = json::array();
  for (const PathPlace& place : m.path) {
    value["path"].push_back({{"place", place.place.str()},
                             {"image", place.image.str()},
                             {"appearance", json::binary(place.appearance)},
                             {"next", edge_to_json(place.next)}});
  }
  value["final"] = {{"image", m.final_image.str()}, {"appearance", json::binary(m.final_appearance)}, {"dock", m.dock}};
  if (m.surroundings) value["surroundings"] = surroundings_to_json(*m.surroundings);
  return value;
}

json write(const Permit& m) {
  json value = start("permit");
  value["mission"] = m.mission.str();
  add_order(value, m.order);
  value["valid_for_ms"] = m.valid_for_ms;
  return value;
}

json write(const StopOrder& m) {
  json value = start("stop");
  value["stop_id"] = m.stop_id;
  value["epoch"] = m.epoch;
  value["seq"] = m.seq;
  value["reason"] = reason_to_json(m.reason);
  value["by"] = m.by;
  return value;
}

json write(const BeliefReport& m) {
  json value = start("belief");
  value["frame_seq"] = m.frame_seq;
  value["place"] = or_null(m.place);
  value["probability"] = m.probability;
  value["lost"] = m.lost;
  return value;
}

json write(const Answer& m) {
  json value = start("answer");
  value["mission"] = m.mission.str();
  value["question"] = m.question;
  value["here"] = m.here;
  return value;
}

json write(const Explored& m) {
  json value = start("explored");
  value["exploration"] = exploration_to_json(m.exploration);
  return value;
}

json write(const ExploreOrder& m) {
  json value = start("explore");
  value["mission"] = m.mission.str();
  add_order(value, m.order);
  value["valid_for_ms"] = m.valid_for_ms;
  value["speed_limit_mps"] = m.speed_limit_mps;
  value["exploration"] = m.exploration.str();
  value["goes_on"] = m.goes_on;
  value["limit_m"] = or_null(m.limit_m);
  value["limit_s"] = or_null(m.limit_s);
  value["back_after_s"] = or_null(m.back_after_s);
  return value;
}

json write(const RepeatOrder& m) {
  json value = start("repeat");
  value["mission"] = m.mission.str();
  add_order(value, m.order);
  value["map"] = m.map.str();
  value["revision"] = m.revision;
  value["valid_for_ms"] = m.valid_for_ms;
  value["speed_limit_mps"] = m.speed_limit_mps;
  value["label"] = m.label;
  value["image"] = m.image.str();
  value["rounds"] = m.rounds;
  return value;
}

json write(const Fences& m) {
  json value = start("fences");
  value["exploration"] = m.exploration.str();
  value["fences"] = fences_to_json(m.fences_m);
  return value;
}

json write(const Finish& m) {
  json value = start("finish");
  value["exploration"] = m.exploration.str();
  return value;
}

json write(const Companion& m) {
  json value = start("companion");
  add_fields(value, m);
  return value;
}

json write(const CompanionView& m) {
  json value = start("companion_view");
  add_fields(value, m);
  return value;
}

json write(const CompanionState& m) {
  json value = start("companion_state");
  add_fields(value, m);
  return value;
}

json write(const LinkError& m) {
  json value = start("error");
  value["code"] = m.code;
  value["message"] = m.message;
  return value;
}

}  // namespace

std::string_view drive_state_name(DriveState state) {
  constexpr std::array<std::string_view, 5> kNames = {"idle", "driving", "arrived", "stopped", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

json question_to_json(const QuestionReport& question) {
  return {{"number", question.number},
          {"place", question.place.str()},
          {"label", question.label},
          {"left_s", question.left_s}};
}

json to_json(const AgentMessage& message) {
  return std::visit([](const auto& m) { return write(m); }, message);
}

json to_json(const ServerMessage& message) {
  return std::visit([](const auto& m) { return write(m); }, message);
}

}  // namespace homeward::wire
