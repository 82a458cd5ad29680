// SPDX-License-Identifier: Apache-2.0
#include "scenario/true_ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "map/lookup.hpp"

namespace homeward::scenario {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// What it costs to get onto each place's prototype.
std::vector<double> first_steps_m(const std::vector<std::optional<Pose2>>& prototypes, const Pose2& from) {
  constexpr double kNear_m = 1.0;
  double nearest_m = kInfinity;
  for (const auto& pose : prototypes) {
    if (pose) nearest_m = std::min(nearest_m, apart_m(*pose, from));
  }
  std::vector<double> step_m;
  for (const auto& pose : prototypes) {
    const double away_m = pose ? apart_m(*pose, from) : kInfinity;
    step_m.push_back(away_m <= std::max(kNear_m, nearest_m) ? away_m : kInfinity);
  }
  return step_m;
}

}  // namespace

std::optional<double> way_over_edges_m(const map::TopologicalMap& map, const PicturePoses& poses,
                                       const Eigen::Vector2d& from_m, const map::Destination& to, bool shortcuts) {
  const auto index = map::place_indices(map);
  std::vector<std::optional<Pose2>> prototypes;
  for (const map::Place& place : map.places) {
    const auto pose = poses.find(place.prototype);
    prototypes.push_back(pose == poses.end() ? std::nullopt : std::optional(pose->second));
  }
  std::vector<std::vector<std::size_t>> next(map.places.size());
  for (const map::Edge& edge : map.edges) {
    if (edge.blocked || (edge.shortcut && !shortcuts)) continue;
    next[static_cast<std::size_t>(index.at(edge.from))].push_back(static_cast<std::size_t>(index.at(edge.to)));
  }
  std::vector<double> way_m = first_steps_m(prototypes, {from_m.x(), from_m.y(), 0.0});
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    if (way_m[i] < kInfinity) open.emplace(way_m[i], i);
  }
  while (!open.empty()) {
    const auto [length_m, place] = open.top();
    open.pop();
    if (length_m > way_m[place]) continue;
    for (const std::size_t neighbour : next[place]) {
      if (!prototypes[place] || !prototypes[neighbour]) continue;
      const double longer_m = length_m + apart_m(*prototypes[place], *prototypes[neighbour]);
      if (longer_m >= way_m[neighbour]) continue;
      way_m[neighbour] = longer_m;
      open.emplace(longer_m, neighbour);
    }
  }
  const auto last = static_cast<std::size_t>(index.at(to.place));
  const auto picture = poses.find(to.image);
  if (picture == poses.end() || !prototypes[last] || way_m[last] == kInfinity) return std::nullopt;
  return way_m[last] + apart_m(*prototypes[last], picture->second);
}

double clearance_along_m(const sim::Obstacles& obstacles, const sim::RobotProfile& robot, const Pose2& from,
                         const Pose2& to) {
  constexpr double kStep_m = 0.02;
  const double length_m = apart_m(from, to);
  const double heading_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kStep_m)));
  double least_m = kInfinity;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Pose2 pose{from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m), heading_rad};
    least_m = std::min(least_m, obstacles.clearance_m(robot, pose, {}));
  }
  return least_m;
}

}  // namespace homeward::scenario
