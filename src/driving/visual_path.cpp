// SPDX-License-Identifier: Apache-2.0
#include "driving/visual_path.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/index.hpp"
#include "homing/home_vector.hpp"
#include "homing/visual_homing.hpp"

namespace homeward::driving {
namespace {

/// What two views say of each other, where an edge does not.
wire::PathEdge seen_edge(const features::Appearance& from, const features::Appearance& to, wire::PathEdge edge) {
  constexpr std::uint64_t kSeed = 1;
  const auto vector = homing::home_vector(from, to, {}, kSeed);
  if (!vector) return edge;
  edge.bearing_rad = vector->bearing_rad;
  edge.turn_rad = vector->turn_rad;
  if (!edge.length_m) edge.length_m = homing::usual_distance_m(homing::shared_share(from, to, vector->inliers));
  return edge;
}

}  // namespace

ViewIndex::ViewIndex(const std::vector<const features::Appearance*>& views) {
  auto map = std::make_shared<map::TopologicalMap>();
  for (const features::Appearance* view : views) {
    map::Place place;
    place.id = PlaceId(std::to_string(map->places.size()));
    place.appearances = {*view};
    map->places.push_back(std::move(place));
  }
  map_ = std::move(map);
  finder_ = std::make_shared<const localisation::CandidateFinder>(*map_);
}

std::vector<int> ViewIndex::find(const features::Appearance& seen, std::size_t count) const {
  return finder_->find(seen, count, {});
}

const features::Appearance& VisualPath::appearance(int view) const {
  return view < size() ? views[at(view)] : nearby[at(view) - views.size()].appearance;
}

const Pose2& VisualPath::pose(int view) const {
  return view < size() ? map_from_view[at(view)] : nearby[at(view) - views.size()].map_from_view;
}

PlaceId VisualPath::place_of(int view) const {
  if (view >= size()) return nearby[at(view) - views.size()].place;
  return at(view) < places.size() ? places[at(view)] : PlaceId();
}

std::optional<int> VisualPath::view_of(const PlaceId& place) const {
  for (int view = 0; view < placed(); ++view) {
    if (place_of(view) == place) return view;
  }
  return std::nullopt;
}

bool VisualPath::on_shortcut(int view) const {
  if (view < 1 || view > static_cast<int>(edges.size())) return false;
  const auto& edge = edges[at(view) - 1];
  return edge && edge->shortcut;
}

void place_by_edges(VisualPath& path) {
  constexpr double kUnknownLength_m = 1.0;
  constexpr double kMeasuredSpread = 0.25;  // of an edge's length: prototypes lie anywhere in their places
  constexpr double kGuessedSpread = 0.6;
  path.map_from_view.assign(1, Pose2{});
  double longest_m = 0.0;
  bool measured = true;
  for (std::size_t i = 0; i + 1 < path.views.size(); ++i) {
    wire::PathEdge edge = path.edges[i].value_or(wire::PathEdge{});
    measured = measured && edge.length_m && edge.bearing_rad && edge.turn_rad;
    if (!edge.bearing_rad || !edge.turn_rad) edge = seen_edge(path.views[i], path.views[i + 1], edge);
    const double length_m = edge.length_m.value_or(kUnknownLength_m);
    longest_m = std::max(longest_m, length_m);
    const double bearing_rad = edge.bearing_rad.value_or(0.0);
    path.map_from_view.push_back(path.map_from_view.back() * Pose2{length_m * std::cos(bearing_rad),
                                                                   length_m * std::sin(bearing_rad),
                                                                   edge.turn_rad.value_or(0.0)});
  }
  path.spread_m = std::max(path.spread_m, (measured ? kMeasuredSpread : kGuessedSpread) * longest_m);
}

}  // namespace homeward::driving
