// SPDX-License-Identifier: Apache-2.0
#include "planning/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "features/aggregate.hpp"
#include "map/lookup.hpp"
#include "matching/retrieval_index.hpp"

namespace homeward::planning {
namespace {

using Layout = map::MetricLayout;

const map::LaidOutImage* pose_of(const Layout& layout, const map::Place& place) {
  const auto at = layout.find(place.prototype);
  return at == layout.end() ? nullptr : &at->second;
}

std::vector<const map::Place*> beside(const map::TopologicalMap& map, const std::vector<const map::Place*>& route,
                                      const std::set<PlaceId>& taken, const Layout& layout,
                                      const SurroundingsConfig& config) {
  std::vector<std::pair<double, const map::Place*>> near;
  for (const map::Place& place : map.places) {
    const map::LaidOutImage* here = pose_of(layout, place);
    if (taken.contains(place.id) || here == nullptr) continue;
    double least_m = config.beside_m;
    for (const map::Place* step : route) {
      const map::LaidOutImage* there = pose_of(layout, *step);
      if (there == nullptr || there->component != here->component) continue;
      least_m = std::min(least_m, std::hypot(here->map_from_robot.x_m - there->map_from_robot.x_m,
                                             here->map_from_robot.y_m - there->map_from_robot.y_m));
    }
    if (least_m < config.beside_m) near.emplace_back(least_m, &place);
  }
  std::ranges::stable_sort(near, {}, [](const auto& one) { return one.first; });
  if (near.size() > config.most_beside) near.resize(config.most_beside);
  std::vector<const map::Place*> places;
  places.reserve(near.size());
  for (const auto& [distance_m, place] : near) places.push_back(place);
  return places;
}

/// All places by what their prototypes look like as a whole; nothing where they have no features.
std::optional<matching::RetrievalIndex> index_of(const map::TopologicalMap& map) {
  constexpr std::uint64_t kSeed = 1;
  std::vector<const features::FeatureSet*> sets;
  for (const map::Place& place : map.places) sets.push_back(&place.appearances.front().sift);
  auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, kSeed);
  if (!vocabulary) return std::nullopt;
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return std::nullopt;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    // One without features looks like none.
    (void)index->add(std::to_string(i), map.places[i].appearances.front().sift);
  }
  return std::move(*index);
}

/// What looks most like each step of a route, none of `taken`: first all that is looked for of the last step, then the
/// best of all others before the second best of any. What the destination is taken for decides where a person is left.
std::vector<const map::Place*> alike(const map::TopologicalMap& map, const std::vector<const map::Place*>& route,
                                     std::set<PlaceId> taken, const SurroundingsConfig& config) {
  std::vector<const map::Place*> places;
  const auto index = index_of(map);
  if (!index || route.empty()) return places;
  const std::size_t enough = taken.size() + config.most_alike + 1;  // among so many one is still free
  std::vector<std::vector<matching::Candidate>> like;
  like.reserve(route.size());
  for (const map::Place* step : route) like.push_back(index->query(step->appearances.front().sift, enough));
  std::vector<std::size_t> next(route.size(), 0);
  const auto add_next = [&](std::size_t step) {
    bool found = false;
    while (!found && next[step] < like[step].size() && places.size() < config.most_alike) {
      const map::Place& place = map.places[static_cast<std::size_t>(std::stoi(like[step][next[step]++].id))];
      found = taken.insert(place.id).second;
      if (found) places.push_back(&place);
    }
  };
  for (int turn = 0; turn < config.alike_at_end; ++turn) add_next(route.size() - 1);
  for (int turn = 0; turn < config.alike; ++turn) {
    for (std::size_t step = 0; step + 1 < route.size(); ++step) add_next(step);
  }
  return places;
}

}  // namespace

std::vector<PlaceId> surroundings(const map::TopologicalMap& map, std::span<const PlaceId> route,
                                  std::span<const PlaceId> likely, const Layout& layout,
                                  const SurroundingsConfig& config) {
  std::set<PlaceId> taken(route.begin(), route.end());
  std::vector<const map::Place*> steps;
  for (const std::span<const PlaceId> ids : {likely, route}) {
    for (const PlaceId& id : ids) {
      if (const map::Place* place = map::find_place(map, id)) steps.push_back(place);
    }
  }
  std::vector<PlaceId> chosen;
  for (const map::Place* place : beside(map, steps, taken, layout, config)) chosen.push_back(place->id);
  // Those beside it are known already; what counts is what looks alike elsewhere.
  taken.insert(chosen.begin(), chosen.end());
  for (const map::Place* place : alike(map, steps, taken, config)) chosen.push_back(place->id);
  return chosen;
}

}  // namespace homeward::planning
