// SPDX-License-Identifier: Apache-2.0
// Which shortcuts a map proposes, whether a body gets along them in the world as it truly is, and how long the ways
// between all its destinations are without and with them, as CSV.
#include "mapping/shortcuts.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "db/map_file.hpp"
#include "files/tour_folder.hpp"
#include "mapping/shortcut_edges.hpp"
#include "scenario/true_ways.hpp"
#include "scenario/world_folder.hpp"
#include "sim/floor.hpp"
#include "truth.hpp"

namespace homeward {
namespace {

struct Options {
  std::string world;
  std::string tour;
  std::string map;
  bool each = false;
  mapping::ShortcutConfig config;
};

scenario::PicturePoses poses_of(const map::TopologicalMap& map, const std::string& tour) {
  const auto truth = read_poses(std::filesystem::path(tour) / "poses.csv");
  scenario::PicturePoses poses;
  for (const map::MapImage& image : map.images) {
    const Pose& pose = truth.at(image.id.str().substr(image.id.str().rfind('/') + 1));
    poses.emplace(image.id, Pose2{pose.x_m, pose.y_m, pose.theta_rad});
  }
  return poses;
}

std::vector<mapping::TourSweep> sweeps_of(const std::string& folder) {
  const files::TourFolder tour = or_die(files::TourFolder::open(folder));
  std::vector<mapping::TourSweep> sweeps;
  for (const TourImage& image : tour.images()) {
    if (image.sweep) sweeps.push_back({image.id, *image.sweep});
  }
  return sweeps;
}

/// Of ways between all destinations over the shortest that there is, in the order of size.
std::vector<double> ratios(const map::TopologicalMap& map, const scenario::PicturePoses& poses, const sim::World& world,
                           bool shortcuts) {
  std::vector<double> found;
  for (const map::Destination& from : map.destinations) {
    for (const map::Destination& to : map.destinations) {
      const Pose2& a = poses.at(from.image);
      const Pose2& b = poses.at(to.image);
      const double shortest_m = sim::length_m(sim::shortest_way(world.drivable, {a.x_m, a.y_m}, {b.x_m, b.y_m}));
      if (shortest_m < 1.0) continue;
      const auto way_m = scenario::way_over_edges_m(map, poses, {a.x_m, a.y_m}, to, shortcuts);
      if (way_m) found.push_back(*way_m / shortest_m);
    }
  }
  std::ranges::sort(found);
  return found;
}

void print_ratios(const char* what, const std::vector<double>& sorted) {
  if (sorted.empty()) return;
  double sum = 0.0;
  for (const double ratio : sorted) sum += ratio;
  std::printf(",%s_mean,%.3f,%s_median,%.3f,%s_p90,%.3f,%s_most,%.3f", what, sum / static_cast<double>(sorted.size()),
              what, sorted[sorted.size() / 2], what, sorted[sorted.size() * 9 / 10], what, sorted.back());
}

int run(const Options& options) {
  map::TopologicalMap map = or_die(db::load_map(options.map)).map;
  const sim::World world = or_die(scenario::load_world(options.world));
  const sim::Obstacles obstacles(world);
  const scenario::PicturePoses poses = poses_of(map, options.tour);
  map.shortcuts.clear();
  mapping::settle_shortcuts(map);
  const auto found = mapping::propose_shortcuts(map, sweeps_of(options.tour), options.config);
  int touching = 0;
  double least_m = 1e9;
  for (const map::Shortcut& one : found) {
    const Pose2& a = poses.at(one.image_a);
    const Pose2& b = poses.at(one.image_b);
    const double clearance_m = scenario::clearance_along_m(obstacles, sim::disc_profile(), a, b);
    touching += clearance_m <= 0.0 ? 1 : 0;
    least_m = std::min(least_m, clearance_m);
    if (options.each) {
      std::printf(
          "shortcut,%s,%s,length_m,%.2f,true_m,%.2f,way_m,%.1f,seen_clear_m,%.2f,true_room_m,%.2f,conf,%.2f,inliers,%"
          "d\n",
          one.image_a.str().c_str(), one.image_b.str().c_str(), one.length_m, std::hypot(a.x_m - b.x_m, a.y_m - b.y_m),
          one.way_m, one.clear_m, clearance_m, one.confidence, one.inliers);
    }
  }
  std::printf("world,%s,places,%zu,shortcuts,%zu,touching,%d,least_room_m,%.2f", options.world.c_str(),
              map.places.size(), found.size(), touching, found.empty() ? 0.0 : least_m);
  print_ratios("tour", ratios(map, poses, world, false));
  map.shortcuts = found;
  for (map::Shortcut& one : map.shortcuts) one.state = map::ShortcutState::kAccepted;
  mapping::settle_shortcuts(map);
  print_ratios("with", ratios(map, poses, world, true));
  std::printf("\n");
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  CLI::App app("Shortcuts of a map, held against the world as it is");
  homeward::Options options;
  app.add_option("--world", options.world)->required();
  app.add_option("--tour", options.tour, "Folder with poses.csv and sweeps")->required();
  app.add_option("--map", options.map)->required();
  app.add_flag("--each", options.each, "A line for each shortcut, too");
  homeward::mapping::ShortcutConfig& config = options.config;
  app.add_option("--most-m", config.most_m)->capture_default_str();
  app.add_option("--stretch", config.stretch)->capture_default_str();
  app.add_option("--saves-m", config.saves_m)->capture_default_str();
  app.add_option("--margin-m", config.margin_m)->capture_default_str();
  app.add_option("--sweeps-within-m", config.sweeps_within_m)->capture_default_str();
  app.add_option("--confidence", config.confidence)->capture_default_str();
  app.add_option("--bearing-rad", config.bearing_rad)->capture_default_str();
  app.add_option("--layout-m", config.layout_m)->capture_default_str();
  app.add_option("--turn-rad", config.turn_rad)->capture_default_str();
  app.add_option("--agreement", config.agreement)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return homeward::run(options);
}
