// SPDX-License-Identifier: Apache-2.0
#include "cli/exploration_picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "scenario/exploration_figures.hpp"
#include "sim/floor.hpp"

namespace homeward::cli {
namespace {

constexpr int kEnlarged = 2;  // pixels of a cell's side

/// Where a point of the world lies in the picture.
cv::Point pixel_of(const sim::FloorGrid& grid, const Eigen::Vector2d& at_m) {
  const Eigen::Vector2i cell = sim::cell_of(grid, at_m);
  return {kEnlarged * cell.x() + kEnlarged / 2, kEnlarged * cell.y() + kEnlarged / 2};
}

/// Things dark, floor that nobody drives on white.
cv::Vec3b colour_of(const sim::World& world, const std::vector<Eigen::Vector2d>& views_m, const Eigen::Vector2d& at_m) {
  if (sim::is_set(world.occupied, at_m)) return {70, 70, 78};
  if (!sim::is_set(world.drivable, at_m)) return {255, 255, 255};
  return scenario::is_covered(world, views_m, at_m) ? cv::Vec3b(214, 240, 214) : cv::Vec3b(246, 178, 170);
}

/// A graph where it truly lies.
struct TrueGraph {
  std::vector<Eigen::Vector2d> nodes_m;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges_m;
};

Image drawn_over_plan(const sim::World& world, const TrueGraph& graph, const std::vector<Eigen::Vector2d>& trail_m,
                      int node_px) {
  const sim::FloorGrid& grid = world.occupied;
  Image drawn(kEnlarged * grid.width, kEnlarged * grid.height, 3);
  cv::Mat canvas(drawn.height_px, drawn.width_px, CV_8UC3, drawn.data.data());
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const cv::Rect cell(kEnlarged * column, kEnlarged * row, kEnlarged, kEnlarged);
      canvas(cell).setTo(colour_of(world, graph.nodes_m, sim::centre_of(grid, {column, row})));
    }
  }
  const cv::Scalar way(120, 160, 220);
  for (std::size_t i = 1; i < trail_m.size(); ++i)
    cv::line(canvas, pixel_of(grid, trail_m[i - 1]), pixel_of(grid, trail_m[i]), way, 1, cv::LINE_AA);
  const cv::Scalar edge(20, 70, 150);
  for (const auto& [from_m, to_m] : graph.edges_m)
    cv::line(canvas, pixel_of(grid, from_m), pixel_of(grid, to_m), edge, 2, cv::LINE_AA);
  for (const Eigen::Vector2d& node_m : graph.nodes_m)
    cv::circle(canvas, pixel_of(grid, node_m), node_px, edge, cv::FILLED, cv::LINE_AA);
  if (!trail_m.empty()) cv::circle(canvas, pixel_of(grid, trail_m.front()), 6, {200, 60, 30}, 2, cv::LINE_AA);
  return drawn;
}

}  // namespace

Image exploration_picture(const sim::World& world, const map::TopologicalMap& map,
                          const std::unordered_map<ImageId, Pose2>& taken,
                          const scenario::ExplorationResult& explored) {
  constexpr int kNode_px = 4;
  std::unordered_map<PlaceId, Eigen::Vector2d> places_m;
  TrueGraph graph;
  for (const map::Place& place : map.places) {
    const auto truth = taken.find(place.prototype);
    if (truth == taken.end()) continue;
    places_m.emplace(place.id, position_m(truth->second));
    graph.nodes_m.push_back(position_m(truth->second));
  }
  for (const map::Edge& one : map.edges) {
    const auto from = places_m.find(one.from);
    const auto to = places_m.find(one.to);
    if (from != places_m.end() && to != places_m.end()) graph.edges_m.emplace_back(from->second, to->second);
  }
  return drawn_over_plan(world, graph, explored.trail_m, kNode_px);
}

Image growing_picture(const sim::World& world, const exploration::Explorer& explorer,
                      const scenario::ExplorationResult& so_far) {
  constexpr int kNode_px = 3;
  TrueGraph graph;
  for (const scenario::ExploredPicture& picture : so_far.pictures) {
    graph.nodes_m.push_back(position_m(picture.truth));
    if (graph.nodes_m.size() > 1) graph.edges_m.emplace_back(*(graph.nodes_m.end() - 2), graph.nodes_m.back());
  }
  for (const exploration::KnownAgain& again : explorer.known_again()) {
    if (again.taken_back) continue;
    graph.edges_m.emplace_back(graph.nodes_m.at(static_cast<std::size_t>(again.now)),
                               graph.nodes_m.at(static_cast<std::size_t>(again.then)));
  }
  return drawn_over_plan(world, graph, so_far.trail_m, kNode_px);
}

}  // namespace homeward::cli
