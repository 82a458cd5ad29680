// SPDX-License-Identifier: Apache-2.0
// Homing to one view, again and again: targets at random in a world, starts some metres off with the target's spot in
// sight, any headings. The agent's own driving step drives; the world judges. One JSON line for each, then a summary.
// With --answers nothing drives: what single pictures on the straight way say of the target, by how far off it is.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "core/angles.hpp"
#include "homing/home_vector.hpp"
#include "scenario/mission_run.hpp"
#include "scenario/usual_cameras.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/reason.hpp"

namespace {

using namespace homeward;
using nlohmann::json;

template <typename T>
T or_die(Result<T> result) {
  if (!result) {
    std::cerr << "homeward_bench_homing: " << result.error().message << "\n";
    std::exit(1);
  }
  return std::move(*result);
}

bool in_sight(const sim::FloorGrid& drivable, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    if (!sim::is_set(drivable, a + (b - a) * (static_cast<double>(i) / kSteps))) return false;
  }
  return true;
}

/// What pictures from one distance say, each alone.
struct Answers {
  int right = 0;  // within 15 degrees
  int wrong = 0;
  int right_hints = 0;  // where nothing is certain
  int wrong_hints = 0;
  int silent = 0;
  std::vector<double> shares;  // of the features that agree, where it is right

  void count(const features::Appearance& seen, const features::Appearance& target, double truth_rad,
             std::uint64_t seed) {
    const auto right_way = [&](const homing::HomeVector& vector) {
      return std::abs(wrap_angle(vector.bearing_rad - truth_rad)) <= radians(15.0);
    };
    if (const auto answer = homing::home_vector(seen, target, {}, seed)) {
      ++(right_way(*answer) ? right : wrong);
      if (right_way(*answer)) shares.push_back(homing::shared_share(seen, target, answer->inliers));
    } else if (const auto hint = homing::uncertain_home_vector(seen, target, seed)) {
      ++(right_way(*hint) ? right_hints : wrong_hints);
    } else {
      ++silent;
    }
  }
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

}  // namespace

int main(int argc, char** argv) {
  std::string world_name = "house:1";
  std::string light_name = "day";
  std::string model = "hyperbolic_mirror";
  std::string robot_name = "disc";
  int starts = 100;
  double distance_m = 3.0;
  std::uint64_t seed = 1;
  int only = -1;
  bool elsewhere = false;
  bool answers_alone = false;
  bool trace = false;
  int neighbour_px = 0;
  bool columns = false;
  CLI::App app("Homing to single views from random starts");
  app.add_option("--world", world_name);
  app.add_option("--light", light_name, "of the start; the target is seen by day");
  app.add_option("--camera", model);
  app.add_option("--robot", robot_name);
  app.add_option("--starts", starts);
  app.add_option("--distance", distance_m);
  app.add_option("--seed", seed);
  app.add_option("--only", only, "one start alone");
  app.add_flag("--answers", answers_alone, "only what single pictures say");
  app.add_flag("--elsewhere", elsewhere, "the picture driven to is of a spot that no straight way leads to");
  app.add_option("--neighbour", neighbour_px, "features are tracked by the strongest corner within so many pixels")
      ->check(CLI::Range(0, 20));
  app.add_flag("--columns", columns, "column segments enter the local map");
  app.add_flag("--trace", trace, "each cycle on standard error");
  CLI11_PARSE(app, argc, argv);

  sim::LitWorld world(or_die(scenario::load_world(world_name)));
  const auto light = or_die(scenario::light_named(light_name));
  const auto day = or_die(scenario::light_named("day"));
  scenario::prepare_light(world, day);
  scenario::prepare_light(world, light);
  const camera::CameraConfig camera_config = scenario::usual_camera(model).value();
  const auto camera = or_die(camera::Camera::create(camera_config));
  const auto features = pipeline::suited_feature_config(*camera);
  const auto eye = or_die(pipeline::Eye::create(camera_config, features));
  const sim::Renderer renderer(world, day, camera);
  const sim::Renderer renderer_now(world, light, camera);
  const sim::RobotProfile profile = robot_name == "chair" ? sim::chair_profile() : sim::disc_profile();

  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  const sim::FloorGrid& drivable = world.world().drivable;
  std::vector<double> errors_m;
  std::vector<double> headings_rad;
  std::map<double, Answers> answers;  // by distance, metres
  int arrived = 0;
  int collisions = 0;
  for (int i = 0; i < starts; ++i) {
    Pose2 target;
    Pose2 start;
    for (;;) {
      const Eigen::Vector2d at_m = sim::random_free_point(drivable, random);
      const double way_rad = angle(random);
      const Eigen::Vector2d from_m = at_m - distance_m * Eigen::Vector2d(std::cos(way_rad), std::sin(way_rad));
      target = {at_m.x(), at_m.y(), angle(random)};
      start = {from_m.x(), from_m.y(), angle(random)};
      if (in_sight(drivable, from_m, at_m)) break;
    }
    while (elsewhere && in_sight(drivable, {start.x_m, start.y_m}, {target.x_m, target.y_m})) {
      const Eigen::Vector2d other_m = sim::random_free_point(drivable, random);
      target = {other_m.x(), other_m.y(), angle(random)};
    }
    const std::uint64_t own_seed = random();
    if (only >= 0 && i != only) continue;
    if (answers_alone) {
      const auto view = or_die(eye.look(renderer.render(target, {}, own_seed + 1)));
      const double way_rad = std::atan2(target.y_m - start.y_m, target.x_m - start.x_m);
      for (const double apart_m : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0}) {
        if (apart_m > distance_m) break;
        const Pose2 here{target.x_m - apart_m * std::cos(way_rad), target.y_m - apart_m * std::sin(way_rad),
                         start.theta_rad};
        const auto seen = or_die(eye.look(renderer_now.render(here, {}, own_seed + 2)));
        answers[apart_m].count(seen, view, wrap_angle(way_rad - here.theta_rad), own_seed);
      }
      continue;
    }
    scenario::SimulatedRobotConfig config;
    config.camera = camera_config;
    config.light = light;
    config.profile = profile;
    config.seed = own_seed;
    auto robot = or_die(scenario::SimulatedRobot::create(world, config, start));
    wire::MissionOrder order;
    order.mission = MissionId("homing");
    order.order = {1, 1};
    order.map = MapId("none");
    order.feature_config_id = features::feature_config_id(features);
    order.valid_for_ms = 1500;
    order.speed_limit_mps = wire::kSpeedLimit_mps;
    order.final_image = ImageId("target");
    order.final_appearance = wire::encode_appearance(or_die(eye.look(renderer.render(target, {}, own_seed + 1))));
    order.dock = true;
    driving::DrivingConfig driving;
    driving.body = scenario::body_of(profile);
    driving.feature_config_id = order.feature_config_id;
    driving.follow.visual.tracks.neighbour_px = neighbour_px;
    driving.follow.visual.columns = columns;
    scenario::ScenarioListener listener;
    if (trace) {
      listener.cycled = [&](const scenario::CycleTrace& now) {
        const Eigen::Vector2d off = Eigen::Rotation2Dd(-now.pose.theta_rad) *
                                    Eigen::Vector2d(target.x_m - now.pose.x_m, target.y_m - now.pose.y_m);
        std::fprintf(stderr,
                     "%5.1f true %6.3f %6.3f goal %6.3f %6.3f conf %.2f inl %3d par %.3f map %d v %.2f w %5.2f %s\n",
                     now.t_s, off.x(), off.y(), now.goal_x_m, now.goal_y_m, now.confidence, now.inliers,
                     now.parallax_rad, now.measured ? 1 : 0, now.speed_mps, now.turn_radps, now.state.c_str());
      };
    }
    auto result = or_die(scenario::drive_order(robot, eye, order, {}, driving, listener));
    scenario::judge(robot.vehicle(), target, result);
    arrived += result.arrived ? 1 : 0;
    collisions += result.collisions;
    errors_m.push_back(result.final_error_m);
    headings_rad.push_back(result.final_error_rad);
    const json line = {{"start", i},
                       {"arrived", result.arrived},
                       {"final_error_m", result.final_error_m},
                       {"final_error_rad", result.final_error_rad},
                       {"duration_s", result.duration_s},
                       {"path_m", result.path_m},
                       {"collisions", result.collisions},
                       {"stop", result.stops.empty() ? "" : wire::english(result.stops.back().reason)}};
    std::cout << line.dump() << std::endl;
  }
  for (const auto& [apart_m, said] : answers) {
    std::cout << json{{"apart_m", apart_m},
                      {"right", said.right},
                      {"wrong", said.wrong},
                      {"right_hints", said.right_hints},
                      {"wrong_hints", said.wrong_hints},
                      {"silent", said.silent},
                      {"share_least", quantile(said.shares, 0.0)},
                      {"share_p5", quantile(said.shares, 0.05)},
                      {"share_median", quantile(said.shares, 0.5)},
                      {"share_most", quantile(said.shares, 1.0)}}
                     .dump()
              << std::endl;
  }
  if (answers_alone) return 0;
  const auto within = [&](double limit_m) {
    return static_cast<double>(std::ranges::count_if(errors_m, [&](double e) { return e <= limit_m; })) /
           static_cast<double>(errors_m.size());
  };
  const json summary = {{"starts", errors_m.size()},
                        {"arrived", arrived},
                        {"collisions", collisions},
                        {"median_m", quantile(errors_m, 0.5)},
                        {"p95_m", quantile(errors_m, 0.95)},
                        {"within_0.3", within(0.3)},
                        {"heading_median_deg", degrees(quantile(headings_rad, 0.5))},
                        {"heading_p95_deg", degrees(quantile(headings_rad, 0.95))}};
  std::cout << summary.dump() << std::endl;
  return 0;
}
