// SPDX-License-Identifier: Apache-2.0
// What a robot can tell by when it is lifted to the spot that looks most like the one where it was: pictures and sweeps
// before and after, without any drive. A line for each lift and each small step of the same robot: the share of
// features that go on, and of rays.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

#include "core/angles.hpp"
#include "driving/continuity.hpp"
#include "driving/sweep_continuity.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/world_folder.hpp"
#include "taught.hpp"

namespace homeward {
namespace {

struct Options {
  std::string world = "wards:4";
  std::string light = "day";
  int lifts = 100;
  int people = 0;
  std::uint64_t seed = 1;
};

struct Seen {
  features::Appearance appearance;
  driving::Scan scan;
  Pose2 pose;
};

Seen look(scenario::SimulatedRobot& robot, const pipeline::Eye& eye) {
  return {or_die(eye.look(robot.picture())), robot.sweep(), robot.vehicle().pose()};
}

void compare(const char* what, const Seen& before, const Seen& now, const Pose2& before_from_now) {
  const auto share = driving::continued_share(before.appearance, now.appearance, before_from_now.theta_rad, 1);
  const auto rays = driving::contradiction(before.scan, now.scan, before_from_now);
  std::printf("%s,features,%.3f,rays,%.3f,moved_m,%.2f\n", what, share.value_or(-1.0), rays.value_or(-1.0),
              std::hypot(before.pose.x_m - now.pose.x_m, before.pose.y_m - now.pose.y_m));
}

int run(const Options& options) {
  scenario::TaughtWorld taught = teach_all_rooms(options.world, options.seed);
  const auto light = or_die(scenario::light_named(options.light));
  scenario::prepare_light(*taught.world, light);
  const auto eye = or_die(pipeline::Eye::create(taught.camera, taught.map->feature_config));
  scenario::SimulatedRobotConfig config;
  config.camera = taught.camera;
  config.light = light;
  config.profile = sim::disc_profile();
  config.people = options.people;
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int number = 0; number < options.lifts;) {
    constexpr double kBeside_m = 0.2;
    constexpr double kStep_m = 0.05;
    constexpr double kStep_rad = 0.05;
    auto picture = taught.picture_poses.begin();
    std::advance(picture, static_cast<std::ptrdiff_t>(random() % taught.picture_poses.size()));
    Pose2 here = picture->second;
    here.x_m += kBeside_m * unit(random);
    here.y_m += kBeside_m * unit(random);
    here.theta_rad = wrap_angle(here.theta_rad + 0.3 * unit(random));
    config.seed = random();
    auto robot = or_die(scenario::SimulatedRobot::create(*taught.world, config, here));
    if (robot.clearance_m(here) < scenario::kLiftClearance_m) continue;
    const Seen before = look(robot, eye);
    const auto there = or_die(scenario::look_alike_spot(taught, robot, eye));
    if (!there) continue;
    const Pose2 step{kStep_m * std::abs(unit(random)), 0.0, kStep_rad * unit(random)};
    robot.carry_to(here * step);
    compare("step", before, look(robot, eye), step);
    robot.carry_to(*there);
    compare("lift", before, look(robot, eye), {});
    ++number;
  }
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App app("What a robot that is lifted to a look-alike spot can tell by");
  app.add_option("--world", options.world)->capture_default_str();
  app.add_option("--light", options.light)->capture_default_str();
  app.add_option("--lifts", options.lifts)->capture_default_str();
  app.add_option("--people", options.people)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return homeward::run(options);
}
