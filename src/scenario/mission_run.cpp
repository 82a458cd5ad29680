// SPDX-License-Identifier: Apache-2.0
#include "scenario/mission_run.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/version.hpp"
#include "driving/estimated_position.hpp"
#include "recording/recorder.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/simulated_server.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/true_ways.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "sim/moved_furniture.hpp"
#include "sim/tour_path.hpp"
#include "wire/drive_terms.hpp"

namespace homeward::scenario {
namespace {

const map::Destination* destination_named(const map::TopologicalMap& map, const std::string& label) {
  const auto found = std::find_if(map.destinations.begin(), map.destinations.end(),
                                  [&](const map::Destination& destination) { return destination.label == label; });
  return found == map.destinations.end() ? nullptr : &*found;
}

MissionResult result_of(DriveLoop& drive) {
  const double ended_s = drive.elapsed_s();
  MissionResult result;
  result.arrived = drive.state().drive == wire::DriveState::kArrived;
  if (result.arrived && drive.state().mission) {
    result.arrival_probability =
        driving::arrival_probability(drive.state().follow, drive.state().mission->path, driving::FollowConfig{});
  }
  result.stops = drive.stops();
  result.duration_s = ended_s;
  result.vectors_per_s = drive.vectors() / std::max(wire::kScenarioCycle_s, ended_s);
  result.moved_after_stop = drive.moved_after_stop();
  result.kidnapped_at_s = drive.kidnapped_at_s();
  result.noticed_after_s = drive.noticed_after_s();
  result.belief_apart_s = drive.belief_apart_s();
  result.asked = static_cast<int>(drive.state().asking.number);
  return result;
}

/// Drives a mission with all the orders that it takes.
Result<MissionResult> drive_mission(DriveLoop& drive, House& house, wire::MissionOrder order) {
  for (;;) {
    std::vector<Pose2> way = house.way_of(order);
    if (const Status driven = drive.run(std::move(order), std::move(way)); !driven) return pass_on(driven);
    // What a person or a fault has stopped, only a person sets going again.
    if (drive.state().drive != wire::DriveState::kFailed) break;
    std::string why;
    auto next = house.order_after(drive, why);
    if (!next) return pass_on(next);
    if (!why.empty() && !drive.stops().empty()) drive.stops().back().reason += " " + why;
    if (!*next) break;
    order = std::move(**next);
  }
  MissionResult result = result_of(drive);
  if (drive.state().drive == wire::DriveState::kFailed || drive.state().drive == wire::DriveState::kStopped) {
    if (const Status watched = drive.watch(); !watched) return pass_on(watched);
  }
  result.moved_after_stop = drive.moved_after_stop();
  result.detours = house.detours();
  return result;
}

}  // namespace

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
  // The world as it is now; the map knows it as it was.
  sim::LitWorld* world = taught.world.get();
  std::optional<sim::LitWorld> changed;
  int moved_furniture = 0;
  if (plan.moved_furniture > 0) {
    const double half_width_m = profile.outline.radius_m + profile.outline.side_m;
    auto moved = sim::move_furniture(world->world(), plan.moved_furniture, half_width_m, plan.seed + 29);
    if (!moved) return pass_on(moved);
    moved_furniture = moved->moved;
    changed.emplace(std::move(moved->world));
    world = &*changed;
    world->irradiance(*light);  // of this mission alone: not for the cache
  } else {
    prepare_light(*world, *light);
  }
  const auto from_m = sim::room_point(world->world(), plan.from);
  if (!from_m) return pass_on(from_m);
  const auto start = starting_pose(world->world(), *from_m, profile, plan.seed);
  if (!start) return pass_on(start);
  SimulatedRobotConfig robot_config;
  robot_config.camera = taught.camera;
  robot_config.light = *light;
  robot_config.profile = profile;
  robot_config.people = plan.people;
  robot_config.seed = plan.seed;
  auto robot = SimulatedRobot::create(*world, robot_config, *start);
  if (!robot) return pass_on(robot);
  const auto eye = pipeline::Eye::create(taught.camera, taught.map->feature_config);
  if (!eye) return pass_on(eye);
  auto house = House::create(taught, *destination);
  if (!house) return pass_on(house);

  MissionResult result;
  const auto place = house->find_place(*robot);
  if (!place) return pass_on(place);
  if (!*place) {
    result.stops.push_back({0.0, "I do not know where I am.", {}});
  } else if (const auto order = house->order_from(**place); !order) {
    result.stops.push_back({0.0, order.error().message, {}});
  } else {
    driving::DrivingConfig config;
    config.body = body_of(profile);
    config.feature_config_id = taught.map->feature_config_id;
    std::unique_ptr<recording::Recorder> recorder;
    if (record) {
      const recording::Recorder::Robot recorded{name_with_version("homeward simulate"), taught.camera,
                                                taught.map->feature_config, config};
      auto created = recording::Recorder::create(*record, recorded, [&](const std::string& what) {
        if (listener.log) listener.log(what);
      });
      if (!created) return pass_on(created);
      recorder = std::move(*created);
    }
    DriveLoop drive(*robot, *eye, FaultSchedule(plan.faults), config, listener, recorder.get());
    drive.kidnap_to([&] { return look_alike_spot(taught, *robot, *eye); });
    if (auto answers = answers_named(plan.answers, target->second)) drive.answer_by(std::move(*answers));
    drive.ask_belief([&](const features::Appearance& seen, const Pose2& odometry, const auto& estimate) {
      return house->believe(seen, odometry, estimate);
    });
    auto driven = drive_mission(drive, *house, *order);
    if (!driven) return pass_on(driven);
    result = std::move(*driven);
  }
  result.from = plan.from;
  result.to = plan.to;
  result.moved_furniture = moved_furniture;
  result.shortest_m = sim::length_m(
      sim::shortest_way(world->world().drivable, {start->x_m, start->y_m}, {target->second.x_m, target->second.y_m}));
  result.tour_graph_m =
      way_over_edges_m(*taught.map, taught.picture_poses, {start->x_m, start->y_m}, *destination, false);
  judge(robot->vehicle(), target->second, result);
  return result;
}

}  // namespace homeward::scenario
