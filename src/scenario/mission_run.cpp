// SPDX-License-Identifier: Apache-2.0
#include "scenario/mission_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/angles.hpp"
#include "driving/estimated_position.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/simulated_server.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/true_ways.hpp"
#include "scenario/world_folder.hpp"
#include "scenario/world_of_day.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

const map::Destination* destination_named(const map::TopologicalMap& map, const std::string& label) {
  const auto found = std::find_if(map.destinations.begin(), map.destinations.end(),
                                  [&](const map::Destination& destination) { return destination.label == label; });
  return found == map.destinations.end() ? nullptr : &*found;
}

/// Drives a mission with all the orders that it takes.
Result<MissionResult> drive_mission(DriveLoop& drive, SimulatedServer& server, wire::MissionOrder order) {
  for (;;) {
    std::vector<Pose2> way = server.way_of(order);
    if (const Status driven = drive.run(std::move(order), std::move(way)); !driven) return pass_on(driven);
    // What a person or a fault has stopped, only a person sets going again.
    if (drive.state().drive != wire::DriveState::kFailed) break;
    std::optional<wire::Reason> why;
    auto next = server.order_after(drive, why);
    if (!next) return pass_on(next);
    if (why && !drive.stops().empty()) {
      wire::Reason& reason = drive.stops().back().reason;
      reason = {wire::ReasonCode::kNoWayOn, {{"because", std::vector{reason}}, {"trouble", std::vector{*why}}}};
    }
    if (!*next) break;
    order = std::move(**next);
  }
  MissionResult result = result_of(drive);
  if (drive.state().drive == wire::DriveState::kFailed || drive.state().drive == wire::DriveState::kStopped) {
    if (const Status watched = drive.watch(); !watched) return pass_on(watched);
  }
  result.moved_after_stop = drive.moved_after_stop();
  result.detours = server.detours();
  return result;
}

/// What one mission is driven with.
struct Setting {
  TaughtWorld& taught;
  const MissionPlan& plan;
  const sim::RobotProfile& profile;
  const ScenarioListener& listener;
  const std::optional<recording::RecordingOptions>& record;
};

Result<SimulatedRobot> robot_for(const Setting& mission, sim::LitWorld& world, const sim::Light& light,
                                 const Pose2& start) {
  SimulatedRobotConfig config;
  config.camera = mission.taught.camera;
  config.light = light;
  config.profile = mission.profile;
  config.people = mission.plan.people;
  config.seed = mission.plan.seed;
  return SimulatedRobot::create(world, config, start);
}

/// Drives an order and those that follow it, with all that goes wrong and whoever answers.
Result<MissionResult> drive_with(const Setting& mission, const wire::MissionOrder& order, const Pose2& target,
                                 SimulatedRobot& robot, const pipeline::Eye& eye, SimulatedServer& server) {
  driving::DrivingConfig config;
  config.body = body_of(mission.profile);
  config.feature_config_id = mission.taught.map->feature_config_id;
  const auto recorder = recorder_for(mission.taught, mission.record, config, mission.listener);
  if (!recorder) return pass_on(recorder);
  DriveLoop drive(robot, eye, FaultSchedule(mission.plan.faults), config, mission.listener, recorder->get());
  drive.kidnap_to([&] { return look_alike_spot(mission.taught, robot, eye); });
  if (auto answers = answers_named(mission.plan.answers, target)) drive.answer_by(std::move(*answers));
  drive.ask_belief([&](const features::Appearance& seen, const Pose2& odometry, const auto& estimate) {
    return server.believe(seen, odometry, estimate);
  });
  return drive_mission(drive, server, order);
}

/// Finds the robot's place and drives from there, where there is a way.
Result<MissionResult> drive_from_here(const Setting& mission, const map::Destination& destination, const Pose2& target,
                                      SimulatedRobot& robot) {
  const auto eye = pipeline::Eye::create(mission.taught.camera, mission.taught.map->feature_config);
  if (!eye) return pass_on(eye);
  auto server = SimulatedServer::create(mission.taught, destination, mission.plan.speed_limit_mps);
  if (!server) return pass_on(server);
  const auto place = server->find_place(robot);
  if (!place) return pass_on(place);
  MissionResult result;
  if (!*place) {
    result.stops.push_back({0.0, {wire::ReasonCode::kPlaceUnknown}, {}});
    return result;
  }
  const auto order = server->order_from(**place);
  if (order) return drive_with(mission, *order, target, robot, *eye, *server);
  result.stops.push_back({0.0, server->why_no_order(**place, order.error()), {}});
  return result;
}

}  // namespace

MissionResult result_of(DriveLoop& drive) {
  const double ended_s = drive.elapsed_s();
  MissionResult result;
  result.arrived = drive.state().drive == wire::DriveState::kArrived;
  if (result.arrived && drive.state().mission && drive.state().mission->homes()) {
    result.arrival_probability =
        driving::arrival_probability(drive.state().follow, drive.state().mission->path, driving::FollowConfig{});
  }
  result.stops = drive.stops();
  result.duration_s = ended_s;
  result.vectors_per_s = drive.vectors() / std::max(kScenarioCycle_s, ended_s);
  result.moved_after_stop = drive.moved_after_stop();
  result.kidnapped_at_s = drive.kidnapped_at_s();
  result.noticed_after_s = drive.noticed_after_s();
  result.belief_apart_s = drive.belief_apart_s();
  result.asked = static_cast<int>(drive.state().asking.number);
  return result;
}

Result<MissionResult> drive_order(SimulatedRobot& robot, const pipeline::Eye& eye, const wire::MissionOrder& order,
                                  const MissionPlan& plan, const driving::DrivingConfig& config,
                                  const ScenarioListener& listener, recording::Recorder* recorder) {
  DriveLoop drive(robot, eye, FaultSchedule(plan.faults), config, listener, recorder);
  if (const Status driven = drive.run(order); !driven) return pass_on(driven);
  return result_of(drive);
}

void judge(const sim::Vehicle& vehicle, const Pose2& target, MissionResult& result) {
  result.final_error_m = std::hypot(vehicle.pose().x_m - target.x_m, vehicle.pose().y_m - target.y_m);
  result.final_error_rad = std::abs(wrap_angle(vehicle.pose().theta_rad - target.theta_rad));
  result.path_m = vehicle.path_m();
  result.min_clearance_m = vehicle.min_clearance_m();
  result.collisions = vehicle.collisions();
}

Result<MissionResult> run_mission(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                  const ScenarioListener& listener,
                                  const std::optional<recording::RecordingOptions>& record) {
  const map::Destination* destination = destination_named(*taught.map, plan.to);
  const auto target = taught.destination_poses.find(plan.to);
  if (destination == nullptr || target == taught.destination_poses.end()) {
    return fail(ErrorCode::kInvalidInput, "The tour does not visit '" + plan.to + "', so it is no destination.",
                "missions");
  }
  const auto light = light_named(plan.light);
  if (!light) return pass_on(light);
  const Setting mission{taught, plan, profile, listener, record};
  const auto day = world_of_day(taught, plan, profile, *light);
  if (!day) return pass_on(day);
  const sim::World& world = day->world->world();
  const auto from_m = sim::room_point(world, plan.from);
  if (!from_m) return pass_on(from_m);
  const auto start = starting_pose(world, *from_m, profile, plan.seed);
  if (!start) return pass_on(start);
  auto robot = robot_for(mission, *day->world, *light, *start);
  if (!robot) return pass_on(robot);
  auto driven = drive_from_here(mission, *destination, target->second, *robot);
  if (!driven) return pass_on(driven);
  MissionResult result = std::move(*driven);
  result.from = plan.from;
  result.to = plan.to;
  result.moved_furniture = day->moved_furniture;
  result.shortest_m = sim::length_m(
      sim::shortest_way(world.drivable, {start->x_m, start->y_m}, {target->second.x_m, target->second.y_m}));
  result.tour_graph_m =
      way_over_edges_m(*taught.map, taught.picture_poses, {start->x_m, start->y_m}, *destination, false);
  judge(robot->vehicle(), target->second, result);
  return result;
}

}  // namespace homeward::scenario
