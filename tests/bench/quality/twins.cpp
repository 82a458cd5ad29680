// SPDX-License-Identifier: Apache-2.0
// How well one picture tells a place from the place that looks most like it. Pictures near views of a taught world,
// each compared with the view that was taken there and with that view's twin. A line for each: what was recognised.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

#include "agent/drivers/simulated_robot.hpp"
#include "agent/driving/pose_hypotheses.hpp"
#include "homing/visual_homing.hpp"
#include "agent/files/world_folder.hpp"
#include "agent/scenario/look_alike_spot.hpp"
#include "core/angles.hpp"
#include "localisation/candidates.hpp"
#include "matching/visual_distance.hpp"
#include "matching/verify.hpp"
#include "sim/tour_path.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

struct Options {
  std::string world = "wards:5";
  std::vector<std::string> lights = {"day", "night"};
  int places = 100;
  std::uint64_t seed = 1;
};

/// Views of the map with their true poses.
struct View {
  const features::Appearance* appearance = nullptr;
  Pose2 pose;
};

/// What the robot believes that is at one of the two places, and how it is explained.
struct Side {
  agent::PoseHypotheses hypotheses;

  std::vector<std::size_t> near(const std::vector<View>& views, const Pose2& at) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double d = std::hypot(views[i].pose.x_m - at.x_m, views[i].pose.y_m - at.y_m);
      if (d < 3.0) order.emplace_back(d, i);
    }
    std::ranges::sort(order);
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, order.size()); ++k) result.push_back(order[k].second);
    return result;
  }

  void look(const features::Appearance& seen, const std::vector<View>& views, const Pose2& start, double scale) {
    const Pose2 at = hypotheses.best() != nullptr ? hypotheses.best()->map_from_robot : start;
    std::vector<agent::ViewSighting> sightings;
    std::printf(",%.3f,%.3f", at.x_m, at.y_m);
    std::size_t printed = 0;
    for (const std::size_t i : near(views, at)) {
      const auto pair = matching::compare(seen, *views[i].appearance, {}, 1);
      agent::ViewSighting one;
      one.map_from_view = views[i].pose;
      const double z = pair.distance / scale;
      one.likelihood = std::isfinite(pair.distance) ? std::max(1e-3, 1.0 / ((1.0 + z * z) * (1.0 + z * z))) : 1e-3;
      one.prior_share = 0.1;
      if (pair.pose) {
        const double share = homing::shared_share(seen, *views[i].appearance, pair.verified);
        one.direction = agent::SightedDirection{pair.pose->motion.direction_rad, pair.pose->motion.turn_rad,
                                                pair.pose->confidence, homing::usual_distance_m(share)};
      }
      sightings.push_back(one);
      const double d = std::hypot(views[i].pose.x_m - at.x_m, views[i].pose.y_m - at.y_m);
      std::printf(",%.3f,%d,%d,%.4f,%.4f,%d,%d", d, pair.verified, pair.matches, one.likelihood,
                  pair.pose ? pair.pose->confidence : 0.0, hypotheses.agrees(one) ? 1 : 0, views[i].appearance->size());
      ++printed;
    }
    for (; printed < 3; ++printed) std::printf(",9,0,0,0.001,0,0,600");
    hypotheses.weigh(sightings);
  }
};

int run(const Options& options) {
  wire::ScenarioFile scenario;
  scenario.world = options.world;
  scenario.seed = static_cast<std::int64_t>(options.seed);
  scenario.camera_model = "hyperbolic_mirror";
  auto world = or_die(agent::world_of(scenario, "."));
  scenario.tour_rooms = sim::all_rooms(world);
  agent::TaughtWorld taught = or_die(agent::teach(scenario, ".", std::move(world)));
  const auto eye = or_die(pipeline::Eye::create(taught.camera, taught.map->feature_config));
  const localisation::CandidateFinder finder(*taught.map);
  const auto& places = taught.map->places;
  std::vector<View> views;
  for (const map::Place& place : places) {
    views.push_back({&place.appearances.front(), taught.picture_poses.at(place.prototype)});
  }
  std::vector<Pose2> tour;
  for (const auto& [id, pose] : taught.picture_poses) tour.push_back(pose);
  const double scale = taught.map->motion.distance_scale;
  for (const std::string& name : options.lights) {
    const auto light = or_die(agent::light_named(name));
    agent::prepare_light(*taught.world, light);
    agent::SimulatedRobotConfig config;
    config.camera = taught.camera;
    config.light = light;
    config.profile = sim::disc_profile();
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    constexpr std::size_t kSteps = 12;
    for (int number = 0; number < options.places;) {
      const std::size_t begin = random() % (tour.size() - kSteps);
      const Pose2 at = tour[begin];
      const double off_m = 0.3 * unit(random);
      const auto beside = [&](const Pose2& pose) { return pose * Pose2{0.0, off_m, 0.0}; };
      std::size_t own = 0;
      std::vector<int> without;
      double least = 1e9;
      for (std::size_t i = 0; i < views.size(); ++i) {
        const double d = std::hypot(views[i].pose.x_m - at.x_m, views[i].pose.y_m - at.y_m);
        if (d < 3.0) without.push_back(static_cast<int>(i));
        if (d < least) {
          least = d;
          own = i;
        }
      }
      std::optional<std::size_t> twin;
      int most = 0;
      for (const int other : finder.find(*views[own].appearance, 12, without)) {
        const auto i = static_cast<std::size_t>(other);
        const int verified = matching::compare(*views[own].appearance, *views[i].appearance, {}, 1).verified;
        if (verified > most) {
          most = verified;
          twin = i;
        }
      }
      if (!twin) continue;
      config.seed = random();
      auto robot = or_die(agent::SimulatedRobot::create(*taught.world, config, beside(at)));
      Side truth;
      Side other;
      ++number;
      for (std::size_t step = 0; step < kSteps; ++step) {
        const Pose2 here = beside(tour[begin + step]);
        if (robot.clearance_m(here) < 0.0) break;
        if (step > 0) {
          const Pose2 moved = inverse(beside(tour[begin + step - 1])) * here;
          if (std::hypot(moved.x_m, moved.y_m) > 1.0) break;
          truth.hypotheses.predict(moved);
          other.hypotheses.predict(moved);
        }
        robot.carry_to(here);
        const auto seen = or_die(eye.look(robot.picture()));
        std::printf("%s,%d,%zu,%d,%d,%.3f,%.3f", name.c_str(), number, step, seen.size(), most, here.x_m, here.y_m);
        truth.look(seen, views, views[own].pose, scale);
        other.look(seen, views, views[*twin].pose, scale);
        std::printf("\n");
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App app("How well one picture tells a place from its twin");
  app.add_option("--world", options.world)->capture_default_str();
  app.add_option("--lights", options.lights)->delimiter(',')->capture_default_str();
  app.add_option("--places", options.places)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return homeward::run(options);
}
