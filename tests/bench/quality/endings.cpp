// SPDX-License-Identifier: Apache-2.0
// What a robot states at the end of a drive, of being within half a metre of its destination, against where it is: last
// metres of missions, of which it is told that they begin near the destination. Half of the time it does begin there;
// else it stands at the same spot of the next room of the same size, or at the mirrored spot of any such room. Some
// drives are cut short one metre before the destination. One JSON line for each ending, then how far what is stated is
// from what is true.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/angles.hpp"
#include "driving/estimated_position.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/simulated_server.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "taught.hpp"
#include "wire/reason_json.hpp"

namespace homeward {
namespace {

using nlohmann::json;
using Point = Eigen::Vector2d;

constexpr double kHere_m = 0.5;  // what an arrival is stated of

struct Options {
  std::string world = "wards:4";
  std::string light = "day";
  int endings = 100;  // of each kind
  std::uint64_t seed = 1;
  double start_probability = 0.5;
  double longest_s = 20.0;
  int only = 0;  // one ending, counted from 1, with each cycle on standard error; 0: all
};

enum class Kind { kRight, kShort, kNextRoom, kMirrored };
constexpr Kind kKinds[] = {Kind::kRight, Kind::kShort, Kind::kNextRoom, Kind::kMirrored};

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kRight:
      return "right";
    case Kind::kShort:
      return "one metre off";
    case Kind::kNextRoom:
      return "one room off";
    case Kind::kMirrored:
      return "mirrored room";
  }
  return "";
}

struct Box {
  Point least_m = Point::Constant(1e9);
  Point most_m = Point::Constant(-1e9);
  [[nodiscard]] Point size_m() const { return most_m - least_m; }
  [[nodiscard]] Point centre_m() const { return 0.5 * (least_m + most_m); }
};

Box box_of(const sim::Room& room) {
  Box box;
  for (const Point& corner : room.outline_m) {
    box.least_m = box.least_m.cwiseMin(corner);
    box.most_m = box.most_m.cwiseMax(corner);
  }
  return box;
}

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// The same spot of the nearest room of the same size, or the mirrored spot, along either axis or both, of any such
/// room. Nothing: there is no such room that the robot has room in.
std::optional<Pose2> twin_of(const sim::World& world, const std::string& room, const Pose2& pose, Kind kind,
                             const std::function<double(const Pose2&)>& clearance_m, std::mt19937_64& random) {
  constexpr double kSame_m = 0.25;
  constexpr double kLeastRoom_m = 0.08;
  const auto own = std::ranges::find(world.rooms, room, &sim::Room::name);
  if (own == world.rooms.end() || own->outline_m.empty()) return std::nullopt;
  const Box here = box_of(*own);
  std::optional<Pose2> found;
  double nearest_m = 1e9;
  for (const sim::Room& other : world.rooms) {
    if (other.name == room || other.outline_m.empty()) continue;
    const Box there = box_of(other);
    if ((there.size_m() - here.size_m()).cwiseAbs().maxCoeff() > kSame_m) continue;
    Point within_m = Point(pose.x_m, pose.y_m) - here.centre_m();
    double theta_rad = pose.theta_rad;
    double rank_m = (there.centre_m() - here.centre_m()).norm();
    if (kind == Kind::kMirrored) {
      const auto axes = 1 + random() % 3;
      if ((axes & 1U) != 0) within_m.x() = -within_m.x(), theta_rad = kPi - theta_rad;
      if ((axes & 2U) != 0) within_m.y() = -within_m.y(), theta_rad = -theta_rad;
      rank_m = static_cast<double>(random() % 1000);
    }
    const Point at_m = there.centre_m() + within_m;
    const Pose2 twin{at_m.x(), at_m.y(), wrap_angle(theta_rad)};
    if (rank_m >= nearest_m || clearance_m(twin) < kLeastRoom_m) continue;
    nearest_m = rank_m;
    found = twin;
  }
  return found;
}

struct Ending {
  Kind kind = Kind::kRight;
  std::string to;
  double stated = 0.0;
  double off_m = 0.0;
  bool arrived = false;
  std::string reason;
};

/// The places from which the last metres begin: in sight of the destination, some metres off.
std::vector<const map::Place*> starts_of(const scenario::TaughtWorld& taught, const Pose2& target) {
  constexpr double kLeast_m = 1.2;
  constexpr double kMost_m = 4.0;
  std::vector<const map::Place*> starts;
  for (const map::Place& place : taught.map->places) {
    const double distance_m = apart_m(taught.picture_poses.at(place.prototype), target);
    if (distance_m > kLeast_m && distance_m < kMost_m) starts.push_back(&place);
  }
  return starts;
}

Ending drive(const scenario::TaughtWorld& taught, scenario::SimulatedRobot& robot, const pipeline::Eye& eye,
             const map::Destination& destination, const PlaceId& stated, Kind kind, const Options& options) {
  constexpr double kShort_m = 1.0;
  const Pose2& target = taught.destination_poses.at(destination.label);
  scenario::SimulatedServer server =
      or_die(scenario::SimulatedServer::create(taught, destination, wire::kSpeedLimit_mps));
  or_die(server.find_place(robot));
  wire::MissionOrder order = or_die(server.order_from(stated));
  if (order.surroundings) order.surroundings->start_probability = options.start_probability;
  driving::DrivingConfig config;
  config.body = scenario::body_of(sim::disc_profile());
  config.feature_config_id = taught.map->feature_config_id;
  const scenario::ScenarioListener listener;
  scenario::DriveLoop drive(robot, eye, scenario::FaultSchedule({}), config, listener, nullptr);
  drive.ask_belief([&](const features::Appearance& seen, const Pose2& odometry, const auto& estimate) {
    return server.believe(seen, odometry, estimate);
  });
  Ending ending;
  ending.kind = kind;
  ending.to = destination.label;
  drive.end_when([&](const scenario::CycleTrace& now) {
    if (options.only > 0) {
      const auto apart = driving::off_belief_m(drive.state().follow, drive.state().mission->path, config.follow);
      std::fprintf(
          stderr, "%.1f s: stated %.4f, sure %.4f, elsewhere %.4f, off %.2f m, belief %s, apart %.1f m\n", now.t_s,
          now.arrival_probability, now.position_probability, now.elsewhere, apart_m(now.pose, target),
          drive.state().follow.belief ? std::to_string(drive.state().follow.belief->probability).c_str() : "none",
          apart.value_or(-1.0));
    }
    if (now.views > 0) {
      ending.stated = now.arrival_probability;
      ending.off_m = apart_m(now.pose, target);
    }
    return now.t_s >= options.longest_s || (kind == Kind::kShort && ending.off_m < kShort_m);
  });
  if (const Status driven = drive.run(std::move(order)); !driven) throw std::runtime_error(driven.error().message);
  ending.arrived = drive.state().drive == wire::DriveState::kArrived;
  if (!drive.stops().empty()) ending.reason = wire::reason_name(drive.stops().back().reason.code);
  return ending;
}

void print(const Ending& ending) {
  std::cout << json{{"kind", name_of(ending.kind)}, {"to", ending.to},           {"stated", ending.stated},
                    {"off_m", ending.off_m},        {"arrived", ending.arrived}, {"reason", ending.reason}}
                   .dump()
            << std::endl;
}

/// Of tenths of what is stated: how far its mean is from the share that is true, by how many are in each.
double calibration_error(const std::vector<Ending>& endings) {
  constexpr std::size_t kBins = 10;
  double error = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    double stated = 0.0;
    double right = 0.0;
    int count = 0;
    for (const Ending& ending : endings) {
      if (std::min(kBins - 1, static_cast<std::size_t>(ending.stated * kBins)) != bin) continue;
      stated += ending.stated;
      right += ending.off_m < kHere_m ? 1.0 : 0.0;
      ++count;
    }
    if (count == 0) continue;
    std::printf("stated %.1f to %.1f: %d, mean %.3f, true %.3f\n", static_cast<double>(bin) / kBins,
                static_cast<double>(bin + 1) / kBins, count, stated / count, right / count);
    error += std::abs(stated - right);
  }
  return endings.empty() ? 0.0 : error / static_cast<double>(endings.size());
}

int run(const Options& options) {
  constexpr int kTries = 200;
  scenario::TaughtWorld taught = teach_all_rooms(options.world, options.seed);
  const auto light = or_die(scenario::light_named(options.light));
  scenario::prepare_light(*taught.world, light);
  const auto eye = or_die(pipeline::Eye::create(taught.camera, taught.map->feature_config));
  scenario::SimulatedRobotConfig robot_config;
  robot_config.camera = taught.camera;
  robot_config.light = light;
  robot_config.profile = sim::disc_profile();
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Ending> endings;
  int count = 0;
  for (int number = 0; number < options.endings; ++number) {
    for (const Kind kind : kKinds) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        constexpr double kBeside_m = 0.25;
        constexpr double kBeside_rad = 0.5;
        constexpr double kLeastRoom_m = 0.08;
        const map::Destination& destination = taught.map->destinations[random() % taught.map->destinations.size()];
        const auto starts = starts_of(taught, taught.destination_poses.at(destination.label));
        if (starts.empty()) continue;
        const map::Place& stated = *starts[random() % starts.size()];
        robot_config.seed = random();
        Pose2 start = taught.picture_poses.at(stated.prototype);
        start.x_m += kBeside_m * unit(random);
        start.y_m += kBeside_m * unit(random);
        start.theta_rad = wrap_angle(start.theta_rad + kBeside_rad * unit(random));
        const auto room = sim::room_at(taught.world->world(), {start.x_m, start.y_m});
        auto robot = or_die(scenario::SimulatedRobot::create(*taught.world, robot_config, start));
        const auto clearance_m = [&](const Pose2& pose) { return robot.clearance_m(pose); };
        if (!room || clearance_m(start) < kLeastRoom_m) continue;
        if (kind == Kind::kNextRoom || kind == Kind::kMirrored) {
          const auto twin = twin_of(taught.world->world(), *room, start, kind, clearance_m, random);
          if (!twin) continue;
          robot.carry_to(*twin);
        }
        ++count;
        if (options.only > 0 && count != options.only) break;
        endings.push_back(drive(taught, robot, eye, destination, stated.id, kind, options));
        print(endings.back());
        break;
      }
    }
  }
  const double error = calibration_error(endings);
  std::printf("%zu endings, calibration error %.4f\n", endings.size(), error);
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App app("What is stated at the end of a drive, against where it ends");
  app.add_option("--world", options.world)->capture_default_str();
  app.add_option("--light", options.light)->capture_default_str();
  app.add_option("--endings", options.endings, "Of each of the four kinds")->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--start-probability", options.start_probability)->capture_default_str();
  app.add_option("--only", options.only, "One ending, by its number from 1, with each cycle on standard error");
  app.add_option("--longest-s", options.longest_s)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return homeward::run(options);
}
