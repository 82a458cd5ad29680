// SPDX-License-Identifier: Apache-2.0
#include "map/difference.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "map/parts.hpp"

namespace homeward::map {
namespace {

template <typename Key, typename Value, typename KeyOf>
std::map<Key, const Value*> by_key(const std::vector<Value>& values, const KeyOf& key_of) {
  std::map<Key, const Value*> found;
  for (const Value& value : values) found.emplace(key_of(value), &value);
  return found;
}

/// Pairs of the same key, in the order of `after`, then those that only `before` has.
template <typename Key, typename Value, typename KeyOf, typename Take>
void pair_up(const std::vector<Value>& before, const std::vector<Value>& after, const KeyOf& key_of, const Take& take) {
  const auto old = by_key<Key>(before, key_of);
  std::set<Key> there;
  for (const Value& value : after) {
    const auto found = old.find(key_of(value));
    there.insert(key_of(value));
    take(found == old.end() ? nullptr : found->second, &value);
  }
  for (const Value& value : before) {
    if (!there.contains(key_of(value))) take(&value, nullptr);
  }
}

std::vector<ImageId> only_in(const std::vector<ImageId>& images, const std::vector<ImageId>& others) {
  const std::set<ImageId> known(others.begin(), others.end());
  std::vector<ImageId> found;
  for (const ImageId& image : images) {
    if (!known.contains(image)) found.push_back(image);
  }
  return found;
}

template <typename Value>
std::optional<Value> copy_of(const Value* value) {
  return value == nullptr ? std::nullopt : std::optional(*value);
}

void compare_places(const TopologicalMap& before, const TopologicalMap& after, MapDifference& result) {
  const std::vector<ImageId> none;
  pair_up<PlaceId>(
      before.places, after.places, [](const Place& place) { return place.id; },
      [&](const Place* old, const Place* now) {
        PlaceDifference one{old != nullptr ? old->id : now->id, copy_of(old), copy_of(now), {}, {}};
        one.gained = only_in(now != nullptr ? now->members : none, old != nullptr ? old->members : none);
        one.left = only_in(old != nullptr ? old->members : none, now != nullptr ? now->members : none);
        const bool same = old != nullptr && now != nullptr && one.gained.empty() && one.left.empty() &&
                          old->label == now->label && old->prototype == now->prototype;
        if (!same) result.places.push_back(std::move(one));
      });
}

void compare_edges(const TopologicalMap& before, const TopologicalMap& after, MapDifference& result) {
  using Key = std::pair<PlaceId, PlaceId>;
  const auto driven_by = [](const Edge& edge) {
    return std::tie(edge.bearing_rad, edge.weak, edge.blocked, edge.by, edge.shortcut);
  };
  pair_up<Key>(
      before.edges, after.edges, [](const Edge& edge) { return Key(edge.from, edge.to); },
      [&](const Edge* old, const Edge* now) {
        if (old != nullptr && now != nullptr && driven_by(*old) == driven_by(*now)) return;
        const Edge& any = old != nullptr ? *old : *now;
        result.edges.push_back({any.from, any.to, copy_of(old), copy_of(now)});
      });
}

void compare_destinations(const TopologicalMap& before, const TopologicalMap& after, MapDifference& result) {
  const auto seen = [](const Destination& one) { return std::tie(one.place, one.image, one.label, one.pictogram); };
  pair_up<DestinationId>(
      before.destinations, after.destinations, [](const Destination& one) { return one.id; },
      [&](const Destination* old, const Destination* now) {
        if (old != nullptr && now != nullptr && seen(*old) == seen(*now)) return;
        const Destination& any = old != nullptr ? *old : *now;
        result.destinations.push_back({any.id, copy_of(old), copy_of(now)});
      });
}

void compare_hypotheses(const TopologicalMap& before, const TopologicalMap& after, MapDifference& result) {
  using Key = std::pair<ImageId, ImageId>;
  pair_up<Key>(
      before.hypotheses, after.hypotheses, [](const Hypothesis& one) { return Key(one.prototype_a, one.prototype_b); },
      [&](const Hypothesis* old, const Hypothesis* now) {
        const Decision was = old != nullptr ? old->decision : Decision::kUndecided;
        const Decision is = now != nullptr ? now->decision : Decision::kUndecided;
        const Hypothesis& any = old != nullptr ? *old : *now;
        if (was != is) result.hypotheses.push_back({any.prototype_a, any.prototype_b, was, is});
      });
}

}  // namespace

MapDifference difference(const TopologicalMap& before, const TopologicalMap& after) {
  MapDifference result;
  compare_places(before, after, result);
  compare_edges(before, after, result);
  compare_destinations(before, after, result);
  compare_hypotheses(before, after, result);
  result.parts_before = static_cast<int>(parts(before).size());
  result.parts_after = static_cast<int>(parts(after).size());
  return result;
}

}  // namespace homeward::map
