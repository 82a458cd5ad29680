// SPDX-License-Identifier: Apache-2.0
#include "scenario/taught_world.hpp"

#include <filesystem>

#include "files/read_file.hpp"
#include "imageio/decode.hpp"
#include "mapping/shortcut_edges.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/teach_path.hpp"
#include "repeat/teach_config.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/kept_tour.hpp"
#include "scenario/scenario_robot.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/starting_pose.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/laser.hpp"
#include "sim/motion.hpp"
#include "sim/tour_path.hpp"

namespace homeward::scenario {
namespace {

/// What the range sensor of the simulated chair sees at a pose.
RangeSweep sweep_at(sim::LitWorld& world, const Pose2& pose, std::uint64_t seed) {
  static const sim::LaserConfig kLaser = safety_scanner();
  RangeSweep sweep;
  sweep.ranges_m = sim::scan(world.rays(), pose, {}, kLaser, seed);
  sweep.angle_step_rad = 2.0 * kPi / kLaser.rays;
  sweep.range_max_m = kLaser.range_max_m;
  return sweep;
}

/// Leads a tour through the scenario's rooms.
Status lead_tour(const wire::ScenarioFile& scenario, const sim::Light& light, TaughtWorld& taught, KeptTour& tour) {
  auto camera = camera::Camera::create(taught.camera);
  if (!camera) return pass_on(camera);
  const auto stops = sim::plan_tour(taught.world->world(), scenario.tour_rooms, scenario.tour_step_m);
  if (!stops) return pass_on(stops);
  const sim::Renderer renderer(*taught.world, light, *camera);
  constexpr int kQuality = 92;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  sim::WheelOdometry wheels(seed);
  for (std::size_t i = 0; i < stops->size(); ++i) {
    const sim::TourStop& stop = (*stops)[i];
    if (i > 0) wheels.follow((*stops)[i - 1].pose, stop.pose);
    const std::uint64_t noise_seed = seed * 1'000'003 + i;
    tour.add(imageio::encode_jpeg(renderer.render(stop.pose, {}, noise_seed), kQuality), wheels.reading(),
             sweep_at(*taught.world, stop.pose, noise_seed));
    taught.picture_poses.emplace(tour.last(), stop.pose);
    if (!stop.arrived) continue;
    tour.mark_last(*stop.arrived);
    taught.destination_poses.emplace(*stop.arrived, stop.pose);
  }
  return {};
}

/// Lets the robot explore by itself, from the first of the rooms on.
Status explore_for(const wire::ScenarioFile& scenario, const sim::Light& light, TaughtWorld& taught, KeptTour& tour) {
  const sim::RobotProfile profile = profile_of(scenario);
  const sim::World& world = taught.world->world();
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const auto from_m = sim::room_point(world, scenario.tour_rooms.front());
  if (!from_m) return pass_on(from_m);
  const auto start = starting_pose(world, *from_m, profile, seed);
  if (!start) return pass_on(start);
  SimulatedRobotConfig config;
  config.camera = taught.camera;
  config.light = light;
  config.profile = profile;
  config.seed = seed;
  const auto explored = explore_world(*taught.world, config, *start, exploration_plan_for(profile));
  if (!explored) return pass_on(explored);
  if (explored->ended != ExplorationEnd::kComplete) {
    return fail(ErrorCode::kInvalidInput,
                "The robot did not see all that it could get to" +
                    (explored->reason.empty() ? std::string(".") : ": " + explored->reason),
                "tour.rooms");
  }
  for (std::size_t i = 0; i < explored->pictures.size(); ++i) {
    tour.add(explored->pictures[i].jpeg, explored->poses[i], explored->pictures[i].sweep);
    taught.picture_poses.emplace(tour.last(), explored->pictures[i].truth);
  }
  for (const std::string& room : scenario.tour_rooms) {
    if (taught.destination_poses.contains(room)) continue;
    const auto picture = picture_of_room(world, room, *explored);
    if (!picture) continue;
    tour.mark(*picture, room);
    taught.destination_poses.emplace(room, explored->pictures[*picture].truth);
  }
  return {};
}

Result<map::TopologicalMap> map_of(const wire::ScenarioFile& scenario, const camera::CameraConfig& camera,
                                   const KeptTour& tour) {
  if (scenario.mode == wire::ScenarioMode::kRepeat) {
    auto path =
        pipeline::teach_path(tour, camera, scenario.world, repeat::dense_teaching(),
                             [&tour](std::size_t i) -> Result<std::vector<std::uint8_t>> { return tour.jpeg(i); });
    if (!path) return pass_on(path);
    return std::move(path->map);
  }
  pipeline::BuildOptions options;
  options.name = scenario.world;
  options.seed = static_cast<std::uint64_t>(scenario.seed);
  return pipeline::build_map({&tour}, camera, options);
}

}  // namespace

Result<sim::World> world_of(const wire::ScenarioFile& scenario, const std::string& folder) {
  // Generated worlds have a name with a colon; files lie beside the scenario.
  const bool generated = scenario.world.find(':') != std::string::npos;
  return load_world(generated ? scenario.world : (std::filesystem::path(folder) / scenario.world).string());
}

Result<TaughtWorld> teach(const wire::ScenarioFile& scenario, const std::string& folder, sim::World world) {
  TaughtWorld taught;
  taught.camera = usual_camera(scenario.camera_model).value_or(camera::CameraConfig{});
  if (scenario.camera) taught.camera = *scenario.camera;
  if (!scenario.camera_file.empty()) {
    const auto read = files::read_camera(std::filesystem::path(folder) / scenario.camera_file);
    if (!read) return pass_on(read);
    taught.camera = *read;
  }
  taught.world = std::make_unique<sim::LitWorld>(std::move(world));
  const auto light = light_named(scenario.tour_light);
  if (!light) return pass_on(light);
  prepare_light(*taught.world, *light);
  auto tour = std::make_shared<KeptTour>();
  const Status toured = scenario.tour_explored ? explore_for(scenario, *light, taught, *tour)
                                               : lead_tour(scenario, *light, taught, *tour);
  if (!toured) return pass_on(toured);
  auto map = map_of(scenario, taught.camera, *tour);
  if (!map) return pass_on(map);
  taught.tour = std::move(tour);
  if (scenario.tour_shortcuts) {
    for (map::Shortcut& shortcut : map->shortcuts) {
      shortcut.state = map::ShortcutState::kAccepted;
      shortcut.by = "scenario";
    }
    mapping::settle_shortcuts(*map);
  }
  taught.map = std::make_shared<const map::TopologicalMap>(std::move(*map));
  taught.layout = map::metric_layout(*taught.map);
  return taught;
}

}  // namespace homeward::scenario
