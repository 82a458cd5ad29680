// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "cli/command.hpp"
#include "cli/explore.hpp"
#include "core/angles.hpp"
#include "core/version.hpp"
#include "scenario/exploration_figures.hpp"
#include "scenario/order_to_explore.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "sim/generate/shut_doors.hpp"
#include "sim/tour_path.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

Result<sim::RobotProfile> robot_named(const std::string& name) {
  if (name == "disc") return sim::disc_profile();
  if (name == "chair") return sim::chair_profile();
  return fail(ErrorCode::kInvalidInput, "There is no robot '" + name + "': disc or chair.", "--robot");
}

Result<Pose2> start_of(const ExploreOptions& options, const sim::World& world, const sim::RobotProfile& robot) {
  Eigen::Vector2d point_m = position_m(world.start);
  if (!options.start.empty()) {
    const auto room_m = sim::room_point(world, options.start);
    if (!room_m) return pass_on(room_m);
    point_m = *room_m;
  }
  auto pose = scenario::starting_pose(world, point_m, robot, options.stage.seed);
  if (pose || options.start.empty()) return pose;
  return fail(ErrorCode::kInvalidInput,
              "In that room the robot finds no place to begin: its door is shut, or it is full.",
              "--start " + options.start);
}

Result<camera::CameraConfig> camera_of(const ExploreOptions& options) {
  auto camera = camera_named(options.stage.camera);
  if (camera && options.camera_height_m) camera->robot_from_camera_translation_m.z() = *options.camera_height_m;
  return camera;
}

Result<ExploringRobot> robot_at(const ExploreOptions& options, sim::LitWorld& world, const camera::CameraConfig& camera,
                                const sim::RobotProfile& profile, const Pose2& start, std::uint64_t seed) {
  const auto light = scenario::light_named(options.stage.light);
  if (!light) return pass_on(light);
  scenario::prepare_light(world, *light);
  scenario::SimulatedRobotConfig config;
  config.camera = camera;
  config.light = *light;
  config.profile = profile;
  config.laser.glass_share = options.glass_share;
  config.laser.spurious_share = options.spurious_share;
  config.seed = seed;
  auto robot = scenario::SimulatedRobot::create(world, config, start);
  if (!robot) return pass_on(robot);
  const auto made = camera::Camera::create(camera);
  if (!made) return pass_on(made);
  auto eye = pipeline::Eye::create(camera, pipeline::suited_feature_config(**made));
  if (!eye) return pass_on(eye);
  return ExploringRobot{std::move(*robot), std::move(*eye), profile};
}

/// CLI::Range lets "nan" through.
CLI::Validator share() {
  const auto problem_of = [](const std::string& text) {
    double value = 0.0;
    const bool fits = CLI::detail::lexical_cast(text, value) && value >= 0.0 && value <= 1.0;
    return fits ? std::string() : text + " is no share: 0 to 1.";
  };
  return {problem_of, "SHARE", "share"};
}

CLI::Validator seconds() {
  const auto problem_of = [](const std::string& text) {
    double value = 0.0;
    const bool fits = CLI::detail::lexical_cast(text, value) && value >= 1.0 && value <= 1e6;
    return fits ? std::string() : text + " are no seconds: 1 to 1000000.";
  };
  return {problem_of, "SECONDS", "seconds"};
}

/// A pose from which the second robot sees the first and leaves it room to set out.
Result<Pose2> start_beside(const sim::World& world, const Pose2& first, const sim::RobotProfile& robot,
                           std::uint64_t seed) {
  constexpr int kDirections = 16;
  const double least_m = 2.0 * swept_radius_m(robot.outline) + 0.4;
  for (int i = 0; i < kDirections; ++i) {
    const double direction_rad = first.theta_rad + 2.0 * kPi * i / kDirections;
    const Eigen::Vector2d point_m =
        position_m(first) + (least_m + 0.3) * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
    if (!sim::is_set(world.drivable, point_m)) continue;
    auto pose = scenario::starting_pose(world, point_m, robot, seed);
    if (!pose) continue;
    const Eigen::Vector2d at_m = position_m(*pose);
    if ((at_m - position_m(first)).norm() >= least_m && scenario::in_sight(world, position_m(first), at_m)) return pose;
  }
  return fail(ErrorCode::kInvalidInput, "Beside the first robot there is no room for a second one; name a room.",
              "--start2");
}

Result<Pose2> second_start_of(const ExploreOptions& options, const sim::World& world, const ExploringRobot& first,
                              std::uint64_t seed) {
  const Pose2& there = first.robot.vehicle().pose();
  if (options.start2.empty()) return start_beside(world, there, first.profile, seed);
  const auto room_m = sim::room_point(world, options.start2);
  if (!room_m) return pass_on(room_m);
  auto pose = scenario::starting_pose(world, *room_m, first.profile, seed);
  if (!pose) return pose;
  const double least_m = 2.0 * swept_radius_m(first.profile.outline) + 0.4;
  if ((position_m(*pose) - position_m(there)).norm() >= least_m) return pose;
  return fail(ErrorCode::kInvalidInput, "The room's point is too near to the first robot; name another room.",
              "--start2 " + options.start2);
}

/// What one method knows nothing of must not be dropped in silence: a fence least of all.
Status refuse_of_survey_alone(const ExploreOptions& options) {
  if (options.robots == 1 && !options.start2.empty())
    return fail(ErrorCode::kInvalidInput, "There is no second robot; see --robots.", "--start2");
  if (options.robots == 2 && options.pictures_every > 0)
    return fail(ErrorCode::kInvalidInput, "The graph so far is drawn of one robot only.", "--pictures-every");
  if (options.method == "survey") return {};
  const char* option = nullptr;
  if (options.robots != 1) option = "--robots";
  if (options.limit_s) option = "--limit-s";
  if (options.back_after_s) option = "--back-after-s";
  if (!options.fences.empty()) option = "--fence";
  if (options.pictures_every > 0) option = "--pictures-every";
  if (option == nullptr) return {};
  return fail(ErrorCode::kInvalidInput, "Only --method survey knows this option.", option);
}

Status run(const ExploreOptions& options) {
  if (Status fitting = refuse_of_survey_alone(options); !fitting) return fitting;
  const auto camera = camera_of(options);
  if (!camera) return pass_on(camera);
  auto loaded = scenario::load_world(options.stage.world);
  if (!loaded) return pass_on(loaded);
  const fs::path out(options.stage.out);
  std::error_code ignored;
  if (fs::exists(out, ignored) && !fs::is_empty(out, ignored)) {
    return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", out.string());
  }
  if (options.shut_doors > 0.0) {
    auto shut = sim::shut_doors(*loaded, options.shut_doors, options.stage.seed);
    if (!shut) return pass_on(shut);
    loaded = std::move(shut->world);
  }
  sim::LitWorld world(std::move(*loaded));
  auto explorer = exploring_robot(options, world, *camera);
  if (!explorer) return pass_on(explorer);
  if (options.method == "thesis") return explore_by_thesis(options, *explorer);
  if (options.robots == 1) return explore_by_survey(options, world.world(), *camera, *explorer);
  auto second = second_robot(options, world, *camera, *explorer);
  if (!second) return pass_on(second);
  return explore_by_two(options, world.world(), *camera, *explorer, *second);
}

}  // namespace

const char* name_of(scenario::ExplorationEnd end) {
  switch (end) {
    case scenario::ExplorationEnd::kComplete:
      return "complete";
    case scenario::ExplorationEnd::kBack:
    case scenario::ExplorationEnd::kLimit:
      return "limit";
    case scenario::ExplorationEnd::kStuck:
    case scenario::ExplorationEnd::kStopped:
      return "stopped";
  }
  return "";
}

Result<ExploringRobot> exploring_robot(const ExploreOptions& options, sim::LitWorld& world,
                                       const camera::CameraConfig& camera) {
  const auto profile = robot_named(options.robot);
  if (!profile) return pass_on(profile);
  const auto start = start_of(options, world.world(), *profile);
  if (!start) return pass_on(start);
  return robot_at(options, world, camera, *profile, *start, options.stage.seed);
}

Result<ExploringRobot> second_robot(const ExploreOptions& options, sim::LitWorld& world,
                                    const camera::CameraConfig& camera, const ExploringRobot& first) {
  // Wheels and noise of its own.
  constexpr std::uint64_t kOther = 1'000'003;
  const std::uint64_t seed = options.stage.seed + kOther;
  const auto start = second_start_of(options, world.world(), first, seed);
  if (!start) return pass_on(start);
  return robot_at(options, world, camera, first.profile, *start, seed);
}

Result<std::unique_ptr<recording::Recorder>> recorder_of(const ExploreOptions& options, const ExploringRobot& explorer,
                                                         const std::string& name) {
  recording::RecordingOptions record;
  record.folder = options.stage.out;
  record.name = name;
  record.wait_for_disk = true;
  // The exploration's own limits bound it.
  record.folder_limit_bytes = std::numeric_limits<std::int64_t>::max();
  record.limit_bytes = record.folder_limit_bytes / 2;  // none makes room for another
  const features::FeatureConfig& features = explorer.eye.feature_config();
  const recording::Recorder::Robot recorded{
      name_with_version("homeward explore"), explorer.eye.camera().config(), features,
      scenario::exploring_config(scenario::body_of(explorer.profile), features::feature_config_id(features))};
  return recording::Recorder::create(record, recorded, [](const std::string& what) { std::cerr << what << "\n"; });
}

void register_explore(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("explore", "Let a simulated robot map a world by itself, and build the map of it");
  const auto options = std::make_shared<ExploreOptions>();
  add_stage_options(*command, options->stage);
  command
      ->add_option("--method", options->method,
                   "survey (pictures of all that can be seen, and a map of them) or thesis (Ferdaus 2008)")
      ->check(CLI::IsMember({"survey", "thesis"}))
      ->capture_default_str();
  add_thesis_options(*command, options->thesis);
  command->add_option("--camera-height-m", options->camera_height_m, "Of the camera above the floor; else its own")
      ->check(CLI::PositiveNumber);
  command->add_option("--start", options->start, "Room to begin in; without it where the world says");
  command
      ->add_option(
          "--robots", options->robots,
          "1, or 2 that leave each other what one of them sees to; with tour-1, tour-2, plan-1.png, plan-2.png, "
          "exploration-1.hwrec, exploration-2.hwrec, and one map of both (survey)")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  command->add_option("--start2", options->start2,
                      "Room where the second robot begins; without it in sight of the first (survey)");
  command->add_option("--shut-doors", options->shut_doors, "Share of the doors that are shut, by the seed")
      ->check(share());
  command->add_option("--robot", options->robot, "disc or chair")->capture_default_str();
  command
      ->add_option("--glass-share", options->glass_share,
                   "Share of the laser's rays that go through panes of windows, and come back from nothing")
      ->check(share())
      ->capture_default_str();
  command
      ->add_option("--spurious-share", options->spurious_share,
                   "Share of the laser's rays that report any range, whatever they meet")
      ->check(share())
      ->capture_default_str();
  command->add_option("--limit-m", options->limit_m, "Way after which it ends")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--limit-s", options->limit_s,
                   "Simulated time after which it ends, wherever it is; else two hours (survey)")
      ->check(seconds());
  command
      ->add_option("--back-after-s", options->back_after_s,
                   "Time after which it is to be back where it began: it turns home before (survey)")
      ->check(seconds());
  command->add_option(
      "--fence", options->fences,
      "Corners of floor that no way leads over, in metres of the world: \"1,2 3,2 3,4\"; once for each (survey)");
  command
      ->add_option("--pictures-every", options->pictures_every,
                   "After so many pictures each time, draw the graph so far over the true plan: plan-0010.png (survey)")
      ->check(CLI::Range(1, 1'000'000));
  command->add_flag("--json", options->json, "Print one JSON object");
  run_on(*command, [options] { return run(*options); });
}

}  // namespace homeward::cli
