// SPDX-License-Identifier: Apache-2.0
#include "agent/scenario/mission_run.hpp"

#include <algorithm>
#include <cmath>

#include "agent/drivers/simulated_robot.hpp"
#include "agent/driving/orders.hpp"
#include "agent/driving/step.hpp"
#include "agent/files/world_folder.hpp"
#include "agent/recording/recorder.hpp"
#include "core/angles.hpp"
#include "pipeline/belief_tracker.hpp"
#include "planning/route.hpp"
#include "sim/floor.hpp"
#include "sim/generate/painting.hpp"
#include "sim/tour_path.hpp"
#include "wire/mission_order.hpp"

namespace homeward::agent {
namespace {

constexpr double kCycle_s = 0.1;
constexpr double kLongest_s = 600.0;
constexpr double kSpeedLimit_mps = 0.45;
constexpr Milliseconds kPermit_ms = 1500;

bool active(const std::vector<wire::ScenarioFault>& faults, const char* kind, double t_s) {
  return std::any_of(faults.begin(), faults.end(), [&](const wire::ScenarioFault& fault) {
    return fault.kind == kind && t_s >= fault.at_s && t_s < fault.at_s + fault.for_s;
  });
}

/// Covers a share of the picture, from the left.
void occlude(Image& picture, double share) {
  const auto columns = static_cast<std::size_t>(std::lround(share * picture.width_px));
  for (int v = 0; v < picture.height_px; ++v) {
    std::fill_n(picture.at(0, v), columns * static_cast<std::size_t>(picture.channels), std::uint8_t{12});
  }
}

/// A pose in a room, near its point, any heading: one with room for the body, or else the roomiest of many.
Pose2 starting_pose(const sim::World& world, const sim::RobotProfile& profile, const Eigen::Vector2d& point_m,
                    std::uint64_t seed) {
  constexpr double kRoom_m = 0.05;
  const sim::Obstacles obstacles(world);
  sim::Random random(seed);
  Pose2 best{point_m.x(), point_m.y(), 0.0};
  double most_m = -1e9;
  for (int attempt = 0; attempt < 50 && most_m < kRoom_m; ++attempt) {
    const Eigen::Vector2d at_m =
        point_m + Eigen::Vector2d(sim::uniform(random, -0.3, 0.3), sim::uniform(random, -0.3, 0.3));
    if (!sim::is_set(world.drivable, at_m)) continue;
    const Pose2 pose{at_m.x(), at_m.y(), sim::uniform(random, -kPi, kPi)};
    const double clear_m = obstacles.clearance_m(profile, pose, {});
    if (clear_m <= most_m) continue;
    most_m = clear_m;
    best = pose;
  }
  return best;
}

const map::Destination* destination_named(const map::TopologicalMap& map, const std::string& label) {
  const auto found = std::find_if(map.destinations.begin(), map.destinations.end(),
                                  [&](const map::Destination& destination) { return destination.label == label; });
  return found == map.destinations.end() ? nullptr : &*found;
}

/// The order that a server would send.
Result<wire::MissionOrder> plan_order(const map::TopologicalMap& map, const PlaceId& from, const map::Destination& to) {
  planning::RouteRequest request;
  request.from = from;
  request.to = to.place;
  const auto route = planning::plan_route(map, request);
  if (!route) return pass_on(route);
  wire::MissionOrder order = wire::order_for_route(map, route->places, to);
  order.mission = MissionId("simulated");
  order.order = {1, 1};
  order.map = MapId("taught");
  order.valid_for_ms = kPermit_ms;
  order.speed_limit_mps = kSpeedLimit_mps;
  return order;
}

/// Looks around at the start until the belief is sure. Nothing: lost.
Result<std::optional<PlaceId>> find_place(const TaughtWorld& taught, SimulatedRobot& robot) {
  auto tracker = pipeline::BeliefTracker::create(taught.map, taught.camera);
  if (!tracker) return pass_on(tracker);
  constexpr int kLooks = 3;
  std::optional<PlaceId> place;
  for (int look = 0; look < kLooks; ++look) {
    const auto belief = tracker->update(robot.picture());
    if (!belief) return pass_on(belief);
    place = belief->lost || belief->top.empty() ? std::nullopt : std::optional(belief->top.front().place);
  }
  return place;
}

/// The loop of one mission: world, sensors and heart, cycle by cycle.
class Drive {
 public:
  Drive(SimulatedRobot& robot, const pipeline::Eye& eye, const MissionPlan& plan, const DrivingConfig& config,
        const ScenarioListener& listener, Recorder* recorder)
      : robot_(robot), eye_(eye), plan_(plan), config_(config), listener_(listener), recorder_(recorder) {}

  Status run(const wire::MissionOrder& order) {
    order_ = &order;
    messages_.emplace_back(order);
    std::int64_t seq = order.order.seq;
    while (elapsed_s() < kLongest_s) {
      const bool link_up = !active(plan_.faults, "link_lost", elapsed_s());
      if (link_up && elapsed_s() > 0.0) {
        messages_.emplace_back(wire::Permit{order.mission, {order.order.epoch, ++seq}, kPermit_ms});
      }
      if (active(plan_.faults, "stop", elapsed_s()))
        messages_.emplace_back(wire::StopOrder{"s1", 1, "Stopped by hand.", "test"});
      if (const Status cycled = cycle(link_up); !cycled) return cycled;
      const bool standing = std::abs(robot_.vehicle().motion().speed_mps) < 1e-3;
      if (state_.drive != wire::DriveState::kDriving && standing) break;
    }
    return {};
  }

  [[nodiscard]] const DrivingState& state() const { return state_; }
  [[nodiscard]] int vectors() const { return vectors_; }
  [[nodiscard]] double elapsed_s() const { return 0.001 * static_cast<double>(now_ms_); }
  [[nodiscard]] const std::vector<StopEvent>& stops() const { return stops_; }

 private:
  Status cycle(bool link_up) {
    Inputs inputs;
    inputs.odometry = robot_.vehicle().odometry();
    inputs.link_up = link_up;
    inputs.messages = std::exchange(messages_, {});
    PictureBytes bytes;
    if (!active(plan_.faults, "camera_frozen", elapsed_s())) {
      Image picture = robot_.picture();
      for (const wire::ScenarioFault& fault : plan_.faults) {
        if (fault.kind == "camera_occluded" && active({fault}, "camera_occluded", elapsed_s()))
          occlude(picture, fault.share);
      }
      CameraPicture sent = as_sent({now_ms_, std::move(picture), inputs.odometry});
      sent.recognised = wants_features(state_.follow);
      auto seen = look(sent, eye_);
      if (!seen) return pass_on(seen);
      inputs.picture = std::move(*seen);
      bytes = sent.bytes;
    }
    if (!active(plan_.faults, "scan_lost", elapsed_s())) inputs.scan = {now_ms_, robot_.sweep()};
    const bool was_driving = state_.drive == wire::DriveState::kDriving;
    const Outputs outputs =
        recorder_ != nullptr ? recorder_->step(state_, inputs, bytes, now_ms_) : step(state_, inputs, config_, now_ms_);
    if (state_.seen.answered && inputs.picture) ++vectors_;
    if (was_driving && !state_.reason.empty()) stops_.push_back({elapsed_s(), state_.reason});
    if (listener_.cycled) listener_.cycled(trace(outputs));
    robot_.command(outputs.motion);
    robot_.advance(kCycle_s);
    now_ms_ += static_cast<Milliseconds>(1000.0 * kCycle_s);
    return {};
  }

  [[nodiscard]] CycleTrace trace(const Outputs& outputs) const {
    CycleTrace now;
    now.t_s = elapsed_s();
    now.pose = robot_.vehicle().pose();
    now.index = state_.follow.index;
    now.views = state_.mission ? static_cast<int>(state_.mission->path.views.size()) : 0;
    const auto index = static_cast<std::size_t>(now.index);
    now.view =
        (index + 1 < static_cast<std::size_t>(now.views) ? order_->path[index].image : order_->final_image).str();
    now.answered = state_.seen.answered;
    if (state_.seen.vector) {
      now.parallax_rad = state_.seen.vector->median_parallax_rad;
      now.bearing_rad = state_.seen.vector->bearing_rad;
      now.confidence = state_.seen.vector->confidence;
      now.inliers = state_.seen.vector->inliers;
    }
    if (const auto goal_m = goal(state_.follow, robot_.vehicle().odometry(), config_.follow)) {
      now.goal_x_m = goal_m->x();
      now.goal_y_m = goal_m->y();
    }
    now.speed_mps = outputs.motion.speed_mps;
    now.turn_radps = outputs.motion.turn_radps;
    now.min_range_m = state_.min_range_m.value_or(0.0);
    now.state = wire::drive_state_name(state_.drive);
    return now;
  }

  SimulatedRobot& robot_;
  const pipeline::Eye& eye_;
  const MissionPlan& plan_;
  const DrivingConfig& config_;
  const ScenarioListener& listener_;
  Recorder* recorder_;
  const wire::MissionOrder* order_ = nullptr;
  DrivingState state_;
  std::vector<wire::ServerMessage> messages_;
  std::vector<StopEvent> stops_;
  Milliseconds now_ms_ = 0;
  int vectors_ = 0;
};

}  // namespace

Result<MissionResult> drive_order(SimulatedRobot& robot, const pipeline::Eye& eye, const wire::MissionOrder& order,
                                  const MissionPlan& plan, const DrivingConfig& config,
                                  const ScenarioListener& listener, Recorder* recorder) {
  Drive drive(robot, eye, plan, config, listener, recorder);
  if (const Status driven = drive.run(order); !driven) return pass_on(driven);
  MissionResult result;
  result.arrived = drive.state().drive == wire::DriveState::kArrived;
  result.stops = drive.stops();
  result.duration_s = drive.elapsed_s();
  result.vectors_per_s = drive.vectors() / std::max(kCycle_s, drive.elapsed_s());
  return result;
}

void judge(const sim::Vehicle& vehicle, const Pose2& target, MissionResult& result) {
  result.final_error_m = std::hypot(vehicle.pose().x_m - target.x_m, vehicle.pose().y_m - target.y_m);
  result.final_error_rad = std::abs(wrap_angle(vehicle.pose().theta_rad - target.theta_rad));
  result.path_m = vehicle.path_m();
  result.min_clearance_m = vehicle.min_clearance_m();
  result.collisions = vehicle.collisions();
}

Result<MissionResult> run_mission(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                  const ScenarioListener& listener, const std::optional<RecordingOptions>& record) {
  const sim::World& world = taught.world->world();
  const auto from_m = sim::room_point(world, plan.from);
  if (!from_m) return pass_on(from_m);
  const map::Destination* destination = destination_named(*taught.map, plan.to);
  const auto target = taught.destination_poses.find(plan.to);
  if (destination == nullptr || target == taught.destination_poses.end()) {
    return fail(ErrorCode::kInvalidInput, "The tour does not visit '" + plan.to + "', so it is no destination.",
                "missions");
  }
  const auto light = light_named(plan.light);
  if (!light) return pass_on(light);
  prepare_light(*taught.world, *light);
  SimulatedRobotConfig robot_config;
  robot_config.camera = taught.camera;
  robot_config.light = *light;
  robot_config.profile = profile;
  robot_config.people = plan.people;
  robot_config.seed = plan.seed;
  const Pose2 start = starting_pose(world, profile, *from_m, plan.seed);
  auto robot = SimulatedRobot::create(*taught.world, robot_config, start);
  if (!robot) return pass_on(robot);
  const auto eye = pipeline::Eye::create(taught.camera, taught.map->feature_config);
  if (!eye) return pass_on(eye);

  MissionResult result;
  const auto place = find_place(taught, *robot);
  if (!place) return pass_on(place);
  if (!*place) {
    result.stops.push_back({0.0, "I do not know where I am."});
  } else {
    const auto order = plan_order(*taught.map, **place, *destination);
    if (!order) {
      result.stops.push_back({0.0, order.error().message});
    } else {
      DrivingConfig config;
      config.body = body_of(profile);
      config.feature_config_id = taught.map->feature_config_id;
      std::unique_ptr<Recorder> recorder;
      if (record) {
        const Recorder::Robot recorded{"homeward simulate/0.1.0", taught.camera, taught.map->feature_config, config};
        auto created = Recorder::create(*record, recorded, [&](const std::string& what) {
          if (listener.told) listener.told(what);
        });
        if (!created) return pass_on(created);
        recorder = std::move(*created);
      }
      auto driven = drive_order(*robot, *eye, *order, plan, config, listener, recorder.get());
      if (!driven) return pass_on(driven);
      result = std::move(*driven);
    }
  }
  result.from = plan.from;
  result.to = plan.to;
  result.shortest_m = sim::length_m(
      sim::shortest_way(world.drivable, {start.x_m, start.y_m}, {target->second.x_m, target->second.y_m}));
  judge(robot->vehicle(), target->second, result);
  return result;
}

}  // namespace homeward::agent
