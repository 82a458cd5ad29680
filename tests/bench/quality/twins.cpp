// SPDX-License-Identifier: Apache-2.0
// What pictures and sweeps tell of which of two places that look alike it is. Walks beside random stretches of a taught
// tour, each with its twin: the same steps from the place that shares most features with where the walk begins. Both
// are kept by the robot's own filter. A line a picture: of either side, where it is believed to be, how near to the
// middle of a way that the tour drove the range sensor sees something were it there (m; -1: nothing is believed yet, or
// nothing is near), and what is recognised in the views nearest to that (metres to the view, features that one motion
// explains, visual distance, confidence of the pair, whether it agrees with where it is believed to be, features of the
// view).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "driving/pose_hypotheses.hpp"
#include "driving/tour_ways.hpp"
#include "homing/visual_homing.hpp"
#include "localisation/candidates.hpp"
#include "map/lookup.hpp"
#include "matching/visual_distance.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/world_folder.hpp"
#include "taught.hpp"

namespace homeward {
namespace {

constexpr std::size_t kViews = 3;  // compared on either side
constexpr double kReach_m = 3.0;
constexpr std::size_t kSteps = 12;
constexpr std::uint64_t kSeed = 1;
constexpr double kUnknown_m = -1.0;

struct Options {
  std::string world = "wards:5";
  std::vector<std::string> lights = {"day", "night"};
  int walks = 60;
  std::uint64_t seed = 1;
};

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// A prototype of the map, and where it was truly taken.
struct View {
  const features::Appearance* appearance = nullptr;
  Pose2 pose;
};

/// What is known of the map: its prototypes, and the ways between them that the tour drove.
struct Known {
  std::vector<View> views;
  std::vector<driving::TourWay> ways;
};

std::vector<View> nearest(const std::vector<View>& views, const Pose2& at) {
  std::vector<View> near;
  std::ranges::copy_if(views, std::back_inserter(near),
                       [&](const View& view) { return apart_m(view.pose, at) < kReach_m; });
  std::ranges::sort(near, {}, [&](const View& view) { return apart_m(view.pose, at); });
  near.resize(std::min(kViews, near.size()));
  return near;
}

/// Looks as a robot does that knows that it is at one of the two places, and prints what is recognised there.
void look(driving::PoseHypotheses& side, const features::Appearance& seen, const std::vector<Eigen::Vector2d>& points_m,
          const Known& known, const Pose2& start) {
  const Pose2 at = side.best() != nullptr ? side.best()->map_from_robot : start;
  std::optional<double> room_m;
  if (side.best() != nullptr) room_m = driving::room_on_ways_m(points_m, known.ways, *side.best());
  std::printf(",%.3f,%.3f,%.3f", at.x_m, at.y_m, room_m.value_or(kUnknown_m));
  std::vector<driving::ViewSighting> sightings;
  for (const View& view : nearest(known.views, at)) {
    const auto pair = matching::compare(seen, *view.appearance, {}, kSeed);
    driving::ViewSighting one;
    one.map_from_view = view.pose;
    one.prior_share = 0.1;
    if (pair.pose) {
      one.share = homing::shared_share(seen, *view.appearance, pair.verified);
      one.agreeing = pair.verified;
      one.direction = driving::SightedDirection{pair.pose->motion.direction_rad, pair.pose->motion.turn_rad,
                                                pair.pose->confidence, homing::usual_distance_m(one.share)};
    }
    sightings.push_back(one);
    std::printf(",%.3f,%d,%.4f,%.4f,%d,%d", apart_m(view.pose, at), pair.verified, pair.distance,
                pair.pose ? pair.pose->confidence : 0.0, side.agrees(one) ? 1 : 0, view.appearance->size());
  }
  for (std::size_t missing = sightings.size(); missing < kViews; ++missing) std::printf(",,,,,,");
  side.weigh(sightings);
}

/// The view that shares most features with `own`, farther away than the walk looks.
std::optional<std::size_t> twin_of(std::size_t own, const std::vector<View>& views,
                                   const localisation::CandidateFinder& finder) {
  constexpr std::size_t kCompared = 12;
  std::vector<int> without;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (apart_m(views[i].pose, views[own].pose) < kReach_m) without.push_back(static_cast<int>(i));
  }
  std::optional<std::size_t> twin;
  int most = 0;
  for (const int other : finder.find(*views[own].appearance, kCompared, without)) {
    const auto i = static_cast<std::size_t>(other);
    const int verified = matching::compare(*views[own].appearance, *views[i].appearance, {}, kSeed).verified;
    if (verified <= most) continue;
    most = verified;
    twin = i;
  }
  return twin;
}

struct Walk {
  const char* light = "";
  int number = 0;
  std::vector<Pose2> way;
  Pose2 own;
  Pose2 twin;
};

void drive(const Walk& walk, scenario::SimulatedRobot& robot, const pipeline::Eye& eye, const Known& known) {
  constexpr double kFarthestStep_m = 1.0;  // beyond it the tour was interrupted
  driving::PoseHypotheses truth;
  driving::PoseHypotheses twin;
  for (std::size_t step = 0; step < walk.way.size(); ++step) {
    const Pose2& here = walk.way[step];
    if (robot.clearance_m(here) < 0.0) return;
    if (step > 0) {
      const Pose2 moved = inverse(walk.way[step - 1]) * here;
      if (std::hypot(moved.x_m, moved.y_m) > kFarthestStep_m) return;
      truth.predict(moved);
      twin.predict(moved);
    }
    robot.carry_to(here);
    const auto seen = or_die(eye.look(robot.picture()));
    std::printf("%s,%d,%zu,%.3f,%.3f", walk.light, walk.number, step, here.x_m, here.y_m);
    const std::vector<Eigen::Vector2d> points_m = driving::hit_points(robot.sweep());
    look(truth, seen, points_m, known, walk.own);
    look(twin, seen, points_m, known, walk.twin);
    std::printf("\n");
  }
}

int run(const Options& options) {
  scenario::TaughtWorld taught = teach_all_rooms(options.world, options.seed);
  const auto eye = or_die(pipeline::Eye::create(taught.camera, taught.map->feature_config));
  const localisation::CandidateFinder finder(*taught.map);
  Known known;
  for (const map::Place& place : taught.map->places) {
    known.views.push_back({&place.appearances.front(), taught.picture_poses.at(place.prototype)});
  }
  for (const map::Edge& edge : taught.map->edges) {
    if (edge.shortcut || edge.length_from != map::LengthSource::kOdometry) continue;
    const Pose2& from = taught.picture_poses.at(map::find_place(*taught.map, edge.from)->prototype);
    const Pose2& to = taught.picture_poses.at(map::find_place(*taught.map, edge.to)->prototype);
    known.ways.push_back({{from.x_m, from.y_m}, {to.x_m, to.y_m}});
  }
  const std::vector<View>& views = known.views;
  std::vector<Pose2> tour;
  for (const auto& [image, pose] : taught.picture_poses) tour.push_back(pose);
  for (const std::string& name : options.lights) {
    scenario::SimulatedRobotConfig config;
    config.camera = taught.camera;
    config.light = or_die(scenario::light_named(name));
    config.profile = sim::disc_profile();
    scenario::prepare_light(*taught.world, config.light);
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> aside_m(-0.3, 0.3);
    for (int number = 0; number < options.walks;) {
      const auto begin = tour.begin() + static_cast<std::ptrdiff_t>(random() % (tour.size() - kSteps));
      const Pose2 aside{0.0, aside_m(random), 0.0};
      const auto own =
          std::ranges::min_element(views, {}, [&](const View& view) { return apart_m(view.pose, *begin); });
      const auto twin = twin_of(static_cast<std::size_t>(own - views.begin()), views, finder);
      if (!twin) continue;
      Walk walk{name.c_str(), ++number, {}, own->pose, views[*twin].pose};
      std::transform(begin, begin + kSteps, std::back_inserter(walk.way),
                     [&](const Pose2& pose) { return pose * aside; });
      config.seed = random();
      auto robot = or_die(scenario::SimulatedRobot::create(*taught.world, config, walk.way.front()));
      drive(walk, robot, eye, known);
    }
  }
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App app("What pictures tell of which of two places that look alike it is");
  app.add_option("--world", options.world)->capture_default_str();
  app.add_option("--lights", options.lights)->delimiter(',')->capture_default_str();
  app.add_option("--walks", options.walks)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return homeward::run(options);
}
