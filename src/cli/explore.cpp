// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/explore.hpp"
#include "cli/map_output.hpp"
#include "cli/tour_files.hpp"
#include "db/map_file.hpp"
#include "files/write_file.hpp"
#include "pipeline/build_map.hpp"
#include "scenario/exploration_figures.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "sim/tour_path.hpp"

namespace homeward::cli {
namespace {

namespace fs = std::filesystem;

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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
  return scenario::starting_pose(world, point_m, robot, options.stage.seed);
}

/// The pictures with what the robot took itself to be in the end, as a tour.
Status write_tour(const fs::path& folder, const camera::CameraConfig& camera, const sim::World& world,
                  const scenario::ExplorationResult& explored) {
  auto files = TourFiles::open(folder, camera);
  if (!files) return pass_on(files);
  for (std::size_t i = 0; i < explored.pictures.size(); ++i) {
    const scenario::ExploredPicture& taken = explored.pictures[i];
    SimulatedPicture picture{taken.jpeg, taken.truth, {}, explored.poses[i], taken.sweep, kTourBegins_us};
    picture.room = sim::room_at(world, position_m(taken.truth)).value_or("");
    picture.t_us += static_cast<TimeUs>(1e6 * taken.t_s);
    if (Status added = files->add(picture); !added) return added;
  }
  return files->finish({});
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Result<map::TopologicalMap> build_map_of(const fs::path& tour, const fs::path& out, const camera::CameraConfig& camera,
                                         const ExploreOptions& options) {
  const auto tours = TourFolders::open({tour.string()});
  if (!tours) return pass_on(tours);
  ProgressBar bar;
  auto map = pipeline::build_map(tours->sources(), camera, {options.stage.world, 0, options.stage.seed}, nullptr,
                                 [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  if (!map) return pass_on(map);
  db::Thumbnails thumbnails;
  if (const Status made = add_thumbnails(*map, *tours, thumbnails); !made) return pass_on(made);
  if (const Status saved = db::save_map(out.string(), *map, thumbnails); !saved) return pass_on(saved);
  return map;
}

Result<scenario::ExplorationResult> explore_world(const ExploreOptions& options, ExploringRobot& explorer) {
  scenario::ExplorationPlan plan;
  plan.limit_m = options.limit_m;
  plan.explorer.reach.radius_m = explorer.profile.outline.radius_m + explorer.profile.outline.side_m;
  return scenario::explore(explorer.robot, scenario::body_of(explorer.profile), explorer.eye, plan, {}, now_ms);
}

/// The survey's pictures as a tour, the map of it, and what both are worth.
Status explore_by_survey(const ExploreOptions& options, const sim::World& world, const camera::CameraConfig& camera,
                         ExploringRobot& explorer) {
  const fs::path out(options.stage.out);
  const auto explored = explore_world(options, explorer);
  if (!explored) return pass_on(explored);
  if (Status written = write_tour(out / "tour", camera, world, *explored); !written) return written;
  const auto map = build_map_of(out / "tour", out / "map.hwmap", camera, options);
  if (!map) return pass_on(map);
  std::unordered_map<ImageId, Pose2> taken;
  for (std::size_t i = 0; i < explored->pictures.size(); ++i) {
    char name[40];
    std::snprintf(name, sizeof name, "tour/%05zu.jpg", i);
    taken.emplace(ImageId(name), explored->pictures[i].truth);
  }
  const scenario::ExplorationFigures figures = scenario::exploration_figures(world, *map, taken);
  if (options.json) {
    print_json({{"covered", figures.covered},
                {"reachable_m2", figures.reachable_m2},
                {"nodes", map->places.size()},
                {"edges", map->edges.size()},
                {"wrong_edges", figures.wrong_edges},
                {"mixed_places", figures.mixed_places},
                {"pictures", explored->pictures.size()},
                {"driven_m", explored->driven_m},
                {"collisions", explored->collisions},
                {"min_clearance_m", explored->min_clearance_m},
                {"duration_s", explored->duration_s},
                {"step_ms_p50", median(explored->step_ms)},
                {"ended", name_of(explored->ended)},
                {"reason", explored->reason.empty() ? nlohmann::json() : nlohmann::json(explored->reason)}});
    return {};
  }
  std::printf("%s: %zu pictures, %.0f m driven in %.0f s, %d collisions\n", name_of(explored->ended),
              explored->pictures.size(), explored->driven_m, explored->duration_s, explored->collisions);
  if (!explored->reason.empty()) std::printf("%s\n", explored->reason.c_str());
  std::printf("%s: %s\n", summary(*map).c_str(), (out / "map.hwmap").string().c_str());
  std::printf("%.1f %% of %.0f m2 lie within 2 m and in sight of a place; %d wrong edges\n", 100.0 * figures.covered,
              figures.reachable_m2, figures.wrong_edges);
  return {};
}

Result<camera::CameraConfig> camera_of(const ExploreOptions& options) {
  auto camera = camera_named(options.stage.camera);
  if (camera && options.camera_height_m) camera->robot_from_camera_translation_m.z() = *options.camera_height_m;
  return camera;
}

Status run(const ExploreOptions& options) {
  const auto camera = camera_of(options);
  if (!camera) return pass_on(camera);
  auto loaded = scenario::load_world(options.stage.world);
  if (!loaded) return pass_on(loaded);
  const fs::path out(options.stage.out);
  std::error_code ignored;
  if (fs::exists(out, ignored) && !fs::is_empty(out, ignored)) {
    return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", out.string());
  }
  sim::LitWorld world(std::move(*loaded));
  auto explorer = exploring_robot(options, world, *camera);
  if (!explorer) return pass_on(explorer);
  if (options.method == "thesis") return explore_by_thesis(options, *explorer);
  return explore_by_survey(options, world.world(), *camera, *explorer);
}

}  // namespace

const char* name_of(scenario::ExplorationEnd end) {
  switch (end) {
    case scenario::ExplorationEnd::kComplete:
      return "complete";
    case scenario::ExplorationEnd::kLimit:
      return "limit";
    case scenario::ExplorationEnd::kStopped:
      return "stopped";
  }
  return "";
}

Result<ExploringRobot> exploring_robot(const ExploreOptions& options, sim::LitWorld& world,
                                       const camera::CameraConfig& camera) {
  const auto light = scenario::light_named(options.stage.light);
  if (!light) return pass_on(light);
  const auto profile = robot_named(options.robot);
  if (!profile) return pass_on(profile);
  const auto start = start_of(options, world.world(), *profile);
  if (!start) return pass_on(start);
  scenario::prepare_light(world, *light);
  scenario::SimulatedRobotConfig config;
  config.camera = camera;
  config.light = *light;
  config.profile = *profile;
  config.seed = options.stage.seed;
  auto robot = scenario::SimulatedRobot::create(world, config, *start);
  if (!robot) return pass_on(robot);
  const auto made = camera::Camera::create(camera);
  if (!made) return pass_on(made);
  auto eye = pipeline::Eye::create(camera, pipeline::suited_feature_config(**made));
  if (!eye) return pass_on(eye);
  return ExploringRobot{std::move(*robot), std::move(*eye), *profile};
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
  command->add_option("--robot", options->robot, "disc or chair")->capture_default_str();
  command->add_option("--limit-m", options->limit_m, "Way after which it ends")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print one JSON object");
  run_on(*command, [options] { return run(*options); });
}

}  // namespace homeward::cli
