// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "driving/tour_ways.hpp"
#include "features/appearance.hpp"
#include "localisation/candidates.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// A view of the map that is none of the path's, for the robot to know when it is beside its path, or at a place that
/// looks like one of it.
struct NearbyView {
  PlaceId place;
  features::Appearance appearance;
  Pose2 map_from_view;
};

/// Finds the views of a path and near it that look like a picture. Shared, never changed.
class ViewIndex {
 public:
  /// `views`: all of them, path first.
  explicit ViewIndex(const std::vector<const features::Appearance*>& views);
  /// At most `count` numbers of views, the most similar first.
  [[nodiscard]] std::vector<int> find(const features::Appearance& seen, std::size_t count) const;

 private:
  std::shared_ptr<const map::TopologicalMap> map_;  // each view a place
  std::shared_ptr<const localisation::CandidateFinder> finder_;
};

/// The views to pass one after the other, the last one being the destination's own, and the part of the map around
/// them.
struct VisualPath {
  std::vector<features::Appearance> views;
  std::vector<std::optional<wire::PathEdge>> edges;  // from each view to the next; as many as views
  std::vector<PlaceId> places = {};                  // of the views; as many, or none where nobody asks
  std::vector<Pose2> map_from_view = {};             // by the map, or by edges (place_by_edges); as many as views
  std::vector<NearbyView> nearby = {};
  std::vector<TourWay> ways = {};                    // that tours drove, around the path
  double spread_m = 0.15;                            // standard deviation of where a view lies among those around it
  double start_probability = 1.0;                    // that the robot is where the path begins
  std::shared_ptr<const ViewIndex> index = nullptr;  // of views, then nearby; null where there are no others

  [[nodiscard]] int size() const { return static_cast<int>(views.size()); }
  /// One view and nothing of a map beside it: only pictures of it say where it is.
  [[nodiscard]] bool alone() const { return views.size() == 1 && nearby.empty(); }
  /// Of views, then nearby ones.
  [[nodiscard]] const features::Appearance& appearance(int view) const;
  [[nodiscard]] const Pose2& pose(int view) const;
  /// The first view of this place; nothing where there is none.
  [[nodiscard]] std::optional<int> view_of(const PlaceId& place) const;
  /// Of a view; empty where it is not known.
  [[nodiscard]] PlaceId place_of(int view) const;
  /// Whether the way to this view of the path is one that no tour drove.
  [[nodiscard]] bool on_shortcut(int view) const;
  [[nodiscard]] int placed() const { return static_cast<int>(views.size() + nearby.size()); }
};

/// Gives the views of a path poses by its edges where no map did. What an edge does not say is taken from what its two
/// views show of each other; where that says nothing either, the next view lies a metre straight ahead.
/// Dead reckoning along the edges; ours.
void place_by_edges(VisualPath& path);

}  // namespace homeward::driving
