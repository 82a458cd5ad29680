// SPDX-License-Identifier: Apache-2.0
#include "scenario/repeat_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/version.hpp"
#include "driving/path_watch.hpp"
#include "map/taught_path.hpp"
#include "recording/recorder.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/heading_only.hpp"
#include "scenario/mission_run.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/world_of_day.hpp"
#include "sim/random.hpp"
#include "wire/lease_durations.hpp"

namespace homeward::scenario {
namespace {

/// Where the tour truly drove, and how far beside it a robot is that follows it.
class DrivenTour {
 public:
  DrivenTour(const TaughtWorld& taught, std::size_t begin) : here_(begin) {
    for (const map::MapImage& image : taught.map->images) poses_.push_back(taught.picture_poses.at(image.id));
    const map::TaughtPath& path = taught.map->path->taught;
    if (path.closing) closes_at_ = static_cast<std::size_t>(path.key_images[path.closing->key_image].picture);
  }

  [[nodiscard]] const Pose2& pose(std::size_t picture) const { return poses_[picture]; }

  void add(const Pose2& robot) {
    constexpr std::size_t kBack = 10;
    constexpr std::size_t kOn = 30;
    const std::size_t first = here_ > kBack ? here_ - kBack : 0;
    double least = 1e9;
    double beside_m = 0.0;
    for (std::size_t offset = 0; offset < kBack + kOn; ++offset) {
      std::size_t from = first + offset;
      if (from + 1 >= poses_.size()) {
        if (!closes_at_) break;
        from = *closes_at_ + (from + 1 - poses_.size());
      }
      const double turned = std::abs(wrap_angle(poses_[from].theta_rad - robot.theta_rad));
      const double away_m = distance_m(position_m(robot), position_m(poses_[from]), position_m(poses_[from + 1]));
      if (away_m + kMetresPerRad * turned >= least) continue;
      least = away_m + kMetresPerRad * turned;
      beside_m = away_m;
      here_ = from;
    }
    squares_ += beside_m * beside_m;
    most_m_ = std::max(most_m_, beside_m);
    ++count_;
  }

  [[nodiscard]] double rmse_m() const { return count_ > 0 ? std::sqrt(squares_ / count_) : 0.0; }
  [[nodiscard]] double most_m() const { return most_m_; }

 private:
  static constexpr double kMetresPerRad = 0.2;

  static double distance_m(const Eigen::Vector2d& point_m, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
    const Eigen::Vector2d way_m = to_m - from_m;
    const double share = std::clamp((point_m - from_m).dot(way_m) / std::max(1e-12, way_m.squaredNorm()), 0.0, 1.0);
    return (point_m - from_m - share * way_m).norm();
  }

  std::vector<Pose2> poses_;
  std::optional<std::size_t> closes_at_;  // where a closed path goes on
  std::size_t here_;
  double squares_ = 0.0;
  double most_m_ = 0.0;
  int count_ = 0;
};

/// The picture of the tour that a room is marked by.
Result<std::size_t> picture_at(const TaughtWorld& taught, const std::string& room) {
  const auto marked = std::ranges::find(taught.map->destinations, room, &map::Destination::label);
  if (marked == taught.map->destinations.end()) {
    return fail(ErrorCode::kInvalidInput, "The tour does not visit '" + room + "', so no path leads there.",
                "missions");
  }
  const auto picture = std::ranges::find(taught.map->images, marked->image, &map::MapImage::id);
  return static_cast<std::size_t>(picture - taught.map->images.begin());
}

/// Beside a pose of the tour, drawn until it leaves the robot room.
Result<SimulatedRobot> robot_beside(const Pose2& shown, const TaughtWorld& taught, const MissionPlan& plan,
                                    const sim::RobotProfile& profile, WorldOfDay& day, sim::Light light) {
  constexpr int kTries = 100;
  SimulatedRobotConfig config;
  config.camera = taught.camera;
  config.light = light;
  config.profile = profile;
  config.people = plan.people;
  config.seed = plan.seed;
  sim::Random random(plan.seed + 1);
  for (int i = 0; i < kTries; ++i) {
    const double beside_m = sim::uniform(random, -plan.start_beside_m, plan.start_beside_m);
    const double turned_rad = sim::uniform(random, -plan.start_turned_rad, plan.start_turned_rad);
    auto robot = SimulatedRobot::create(*day.world, config, shown * Pose2{0.0, beside_m, turned_rad});
    if (!robot || robot->clearance_m(robot->vehicle().pose()) >= kStartClearance_m) return robot;
  }
  return fail(ErrorCode::kInvalidInput, "Beside the tour at '" + plan.from + "' there is no room for the robot.",
              "missions");
}

/// What the pictures of the drive are held against.
Result<SeesPath> sees_path(const TaughtWorld& taught, const MissionPlan& plan, const pipeline::Eye& eye,
                           std::size_t begin, std::size_t end) {
  if (plan.steering == wire::RepeatSteering::kHeading) {
    std::vector<ShownPicture> shown;
    for (std::size_t i = 0; i < taught.tour->images().size(); ++i) {
      const auto picture = taught.tour->read(i);
      if (!picture) return pass_on(picture);
      auto appearance = eye.look(*picture);
      if (!appearance) return pass_on(appearance);
      shown.push_back({*std::move(appearance), *taught.tour->images()[i].odometry});
    }
    const auto watch = std::make_shared<HeadingOnly>(std::move(shown), eye, begin, end);
    return [watch](const Image& picture, driving::Milliseconds taken_ms, const Pose2& odometry) {
      return watch->see(picture, taken_ms, odometry);
    };
  }
  auto created = driving::PathWatch::create(taught.map, taught.camera, taught.map->images[end].id, plan.rounds);
  if (!created) return pass_on(created);
  const auto watch = std::make_shared<driving::PathWatch>(*std::move(created));
  return [watch](const Image& picture, driving::Milliseconds taken_ms, const Pose2& odometry) {
    return watch->see(picture, taken_ms, odometry);
  };
}

wire::RepeatOrder order_to(const TaughtWorld& taught, const MissionPlan& plan, std::size_t end) {
  wire::RepeatOrder order;
  order.mission = MissionId("repeat");
  order.order = {1, 1};
  order.map = MapId("path");
  order.valid_for_ms = wire::kPermitValid_ms;
  order.speed_limit_mps = plan.speed_limit_mps;
  order.label = plan.to;
  order.rounds = plan.rounds;
  order.image = taught.map->images[end].id;
  return order;
}

}  // namespace

Result<MissionResult> run_repeat(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                 const ScenarioListener& listener,
                                 const std::optional<recording::RecordingOptions>& record) {
  const auto begin = picture_at(taught, plan.from);
  if (!begin) return pass_on(begin);
  const auto end = picture_at(taught, plan.to);
  if (!end) return pass_on(end);
  const auto light = light_named(plan.light);
  if (!light) return pass_on(light);
  auto day = world_of_day(taught, plan, profile, *light);
  if (!day) return pass_on(day);
  DrivenTour tour(taught, *begin);
  auto robot = robot_beside(tour.pose(*begin), taught, plan, profile, *day, *light);
  if (!robot) return pass_on(robot);
  const auto eye = pipeline::Eye::create(taught.camera, taught.map->feature_config);
  if (!eye) return pass_on(eye);
  auto sees = sees_path(taught, plan, *eye, *begin, *end);
  if (!sees) return pass_on(sees);

  driving::DrivingConfig config;
  config.body = body_of(profile);
  config.feature_config_id = taught.map->feature_config_id;
  config.repeat_path.steers_by_features = plan.steering == wire::RepeatSteering::kFeatures;
  const auto recorder = recorder_for(taught, record, config, listener);
  if (!recorder) return pass_on(recorder);
  RepeatResult repeat;
  repeat.steering = plan.steering;
  ScenarioListener watching = listener;
  watching.cycled = [&](const CycleTrace& cycle) {
    if (cycle.state == wire::drive_state_name(wire::DriveState::kDriving)) tour.add(cycle.pose);
    if (listener.cycled) listener.cycled(cycle);
  };
  DriveLoop drive(*robot, *eye, FaultSchedule(plan.faults), config, watching, recorder->get());
  const SeesPath counting = [&](const Image& picture, driving::Milliseconds taken_ms, const Pose2& odometry) {
    auto sight = (*sees)(picture, taken_ms, odometry);
    if (!sight) return sight;
    ++repeat.pictures;
    if (sight->lost) ++repeat.lost;
    return sight;
  };
  if (const Status driven = drive.run(order_to(taught, plan, *end), counting); !driven) return pass_on(driven);
  MissionResult result = result_of(drive);
  if (!result.arrived) {
    if (const Status watched = drive.watch(); !watched) return pass_on(watched);
    result.moved_after_stop = drive.moved_after_stop();
  }
  repeat.lateral_rmse_m = tour.rmse_m();
  repeat.lateral_most_m = tour.most_m();
  result.repeat = repeat;
  result.from = plan.from;
  result.to = plan.to;
  result.moved_furniture = day->moved_furniture;
  judge(robot->vehicle(), tour.pose(*end), result);
  return result;
}

}  // namespace homeward::scenario
