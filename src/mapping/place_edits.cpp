// SPDX-License-Identifier: Apache-2.0
#include "mapping/place_edits.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "map/lookup.hpp"
#include "mapping/tour_steps.hpp"

namespace homeward::mapping {
namespace {

using map::AppearanceList;
using map::Edge;
using map::Place;
using map::TopologicalMap;

/// Order in the tour, for members.
void sort_members(const TopologicalMap& map, Place& place) {
  const auto index = map::image_indices(map);
  std::ranges::sort(place.members, {}, [&](const ImageId& id) {
    const auto found = index.find(id);
    return found == index.end() ? static_cast<int>(index.size()) : found->second;
  });
}

/// Drops edges that lead from a place to itself or nowhere, and keeps one edge for each pair and direction.
void tidy_edges(TopologicalMap& map) {
  const auto index = map::place_indices(map);
  std::set<std::pair<PlaceId, PlaceId>> seen;
  std::ranges::stable_partition(map.edges, [](const Edge& edge) { return !edge.shortcut; });
  std::erase_if(map.edges, [&](const Edge& edge) {
    if (edge.from == edge.to || !index.contains(edge.from) || !index.contains(edge.to)) return true;
    return !seen.emplace(edge.from, edge.to).second;
  });
}

bool ends_at(const Edge& edge, const PlaceId& place) { return edge.from == place || edge.to == place; }
const PlaceId& other_end(const Edge& edge, const PlaceId& place) { return edge.from == place ? edge.to : edge.from; }

bool holds(const Place& place, const ImageId& image) {
  return std::ranges::find(place.members, image) != place.members.end();
}

/// Whether a person took away the ways between two places, and that stands.
bool removed_by_a_person(const TopologicalMap& map, const PlaceId& a, const PlaceId& b) {
  bool removed = false;
  const Place& one = *map::find_place(map, a);
  const Place& other = *map::find_place(map, b);
  for (const map::Edit& edit : map.edits) {
    const bool of_ways = edit.kind == map::EditKind::kRemoveEdge || edit.kind == map::EditKind::kAddEdge;
    if (edit.undone || !of_ways) continue;
    const bool theirs = (holds(one, edit.image_a) && holds(other, edit.image_b)) ||
                        (holds(one, edit.image_b) && holds(other, edit.image_a));
    if (!theirs) continue;
    removed = edit.kind == map::EditKind::kRemoveEdge;
  }
  return removed;
}

/// Which ways of a place are closed, by the place at their other end.
struct ClosedWays {
  std::set<PlaceId> out;
  std::set<PlaceId> in;
  void merge(ClosedWays other) {
    out.merge(other.out);
    in.merge(other.in);
  }
};
ClosedWays closed_ways(const TopologicalMap& map, const PlaceId& id) {
  ClosedWays closed;
  for (const Edge& edge : map.edges) {
    if (edge.blocked && edge.from == id) closed.out.insert(edge.to);
    if (edge.blocked && edge.to == id) closed.in.insert(edge.from);
  }
  return closed;
}

/// The ways that tours drove from a place, where there are none yet; closed where those were from which its images
/// came.
void join_what_was_driven(EditScene& scene, const PlaceId& id, const ClosedWays& before = {}) {
  TopologicalMap& map = scene.map();
  for (const PlaceId& beside : driven_from(map, *map::find_place(map, id))) {
    if (removed_by_a_person(map, id, beside)) continue;
    const std::size_t first = map.edges.size();
    join_both_ways(map, id, beside, map::Decider::kMethod);
    for (std::size_t i = first; i < map.edges.size(); ++i) {
      map.edges[i].blocked = map.edges[i].from == id ? before.out.contains(beside) : before.in.contains(beside);
      scene.see(map.edges[i]);
    }
  }
}

void see_all_from(EditScene& scene, const PlaceId& id) {
  for (Edge& edge : scene.map().edges) {
    if (ends_at(edge, id) && !edge.shortcut) scene.see(edge);
  }
}

/// The prototype of a place of these images, and the appearances to know it by: its own, then those of the others.
struct Known {
  ImageId prototype;
  AppearanceList appearances;
};
Result<Known> known_by(EditScene& scene, const std::vector<ImageId>& images, const AppearanceList& of_all) {
  Known known;
  known.prototype = scene.prototype_among(images);
  const auto own = scene.look_at(known.prototype);
  if (!own) return pass_on(own);
  known.appearances.push_back(*own);
  for (const auto& entry : of_all.entries()) {
    const bool among = std::ranges::find(images, entry.image) != images.end();
    if (among && entry.image != known.prototype) known.appearances.push_back(entry);
  }
  return known;
}

/// Appearances without those that are known to be of these images.
AppearanceList without(const AppearanceList& all, const std::vector<ImageId>& images) {
  AppearanceList left;
  for (const auto& entry : all.entries()) {
    if (std::ranges::find(images, entry.image) == images.end()) left.push_back(entry);
  }
  return left;
}

/// A place that images leave: what is left of it.
struct Remainder {
  std::vector<ImageId> members;
  std::optional<Known> known;  // where the prototype is among those that leave
};
Result<Remainder> left_of(EditScene& scene, const Place& place, const std::set<ImageId>& leaving) {
  Remainder left;
  for (const ImageId& member : place.members) {
    if (!leaving.contains(member)) left.members.push_back(member);
  }
  if (left.members.empty()) {
    return fail(ErrorCode::kInvalidInput,
                "Place " + place.id.str() + " would be left without pictures: merge it or delete it instead.",
                place.id.str());
  }
  if (leaving.contains(place.prototype)) {
    auto known = known_by(scene, left.members, place.appearances);
    if (!known) return pass_on(known);
    left.known = std::move(*known);
  }
  return left;
}

void put_remainder(Place& place, Remainder left, const std::vector<ImageId>& gone) {
  place.members = std::move(left.members);
  if (left.known) {
    place.prototype = left.known->prototype;
    place.appearances = std::move(left.known->appearances);
  } else {
    place.appearances = without(place.appearances, gone);
  }
}

}  // namespace

tl::unexpected<Error> no_place_with(const ImageId& image) {
  return fail(ErrorCode::kNotFound, "No place of the map holds the image " + image.str() + ".", image.str());
}

Status merge_places(EditScene& scene, const ImageId& image_a, const ImageId& image_b) {
  TopologicalMap& map = scene.map();
  Place* kept = map::find_place_of(map, image_a);
  const Place* gone = map::find_place_of(map, image_b);
  if (kept == nullptr) return no_place_with(image_a);
  if (gone == nullptr) return no_place_with(image_b);
  if (kept == gone) {
    return scene.already_so({ErrorCode::kInvalidInput, "Both images are in place " + kept->id.str() + " already.", {}});
  }
  kept->members.insert(kept->members.end(), gone->members.begin(), gone->members.end());
  kept->appearances.append(gone->appearances);
  if (kept->label.empty()) kept->label = gone->label;
  sort_members(map, *kept);
  const PlaceId kept_id = kept->id;
  const PlaceId gone_id = gone->id;
  std::erase_if(map.places, [&](const Place& place) { return place.id == gone_id; });
  // Where both places had a way to a third, that of the one which stays is known from its own prototype. It is closed
  // where either was.
  std::ranges::stable_partition(map.edges, [&](const Edge& edge) { return !ends_at(edge, gone_id); });
  std::set<std::pair<PlaceId, PlaceId>> kept_ways;
  std::set<std::pair<PlaceId, PlaceId>> closed;
  for (Edge& edge : map.edges) {
    if (!ends_at(edge, gone_id)) {
      kept_ways.emplace(edge.from, edge.to);
    } else {
      (edge.from == gone_id ? edge.from : edge.to) = kept_id;
    }
    if (edge.blocked) closed.emplace(edge.from, edge.to);
  }
  for (map::Destination& destination : map.destinations) {
    if (destination.place == gone_id) destination.place = kept_id;
  }
  tidy_edges(map);
  for (Edge& edge : map.edges) {
    if (!ends_at(edge, kept_id)) continue;
    edge.blocked = closed.contains({edge.from, edge.to});
    if (!edge.shortcut && !kept_ways.contains({edge.from, edge.to})) scene.see(edge);
  }
  return {};
}

Status split_place(EditScene& scene, const ImageId& image_a, const std::vector<ImageId>& images) {
  TopologicalMap& map = scene.map();
  Place* old_place = map::find_place_of(map, image_a);
  if (old_place == nullptr) return no_place_with(image_a);
  if (images.empty()) return fail(ErrorCode::kInvalidInput, "A split has to name the images that leave.", "images");
  const std::set<ImageId> leaving(images.begin(), images.end());
  for (const ImageId& image : leaving) {
    if (holds(*old_place, image)) continue;
    const bool elsewhere = std::ranges::none_of(leaving, [&](const ImageId& one) { return holds(*old_place, one); });
    Error missing{ErrorCode::kNotFound,
                  "Place " + old_place->id.str() + " does not hold the image " + image.str() + ".", image.str()};
    if (elsewhere && map::find_place_of(map, image) != nullptr) return scene.already_so(std::move(missing));
    return tl::unexpected<Error>(std::move(missing));
  }
  auto left = left_of(scene, *old_place, leaving);
  if (!left) return pass_on(left);
  Place fresh;
  fresh.members.assign(leaving.begin(), leaving.end());
  sort_members(map, fresh);
  auto known = known_by(scene, fresh.members, old_place->appearances);
  if (!known) return pass_on(known);
  fresh.prototype = known->prototype;
  fresh.appearances = std::move(known->appearances);
  fresh.appearances.append(scene.edit().found.learnt);
  fresh.id = scene.made_place();

  const bool other_prototype = left->known.has_value();
  put_remainder(*old_place, std::move(*left), fresh.members);
  const PlaceId old_id = old_place->id;
  const ClosedWays closed = closed_ways(map, old_id);
  const PlaceId fresh_id = fresh.id;
  map.places.push_back(std::move(fresh));
  for (map::Destination& destination : map.destinations) {
    if (leaving.contains(destination.image)) destination.place = fresh_id;
  }
  const std::set<PlaceId> from_old = driven_from(map, *map::find_place(map, old_id));
  const std::set<PlaceId> from_fresh = driven_from(map, map.places.back());
  for (Edge& edge : map.edges) {
    if (!ends_at(edge, old_id) || edge.by == map::Decider::kPerson) continue;
    const PlaceId& beside = other_end(edge, old_id);
    if (from_old.contains(beside) || !from_fresh.contains(beside)) continue;
    (edge.from == old_id ? edge.from : edge.to) = fresh_id;
    scene.see(edge);
  }
  join_what_was_driven(scene, fresh_id, closed);
  if (other_prototype) see_all_from(scene, old_id);
  tidy_edges(map);
  return {};
}

Status move_images(EditScene& scene, const ImageId& image_a, const std::vector<ImageId>& images) {
  TopologicalMap& map = scene.map();
  const Place* target = map::find_place_of(map, image_a);
  if (target == nullptr) return no_place_with(image_a);
  if (images.empty()) return fail(ErrorCode::kInvalidInput, "A move has to name the images that go.", "images");
  const PlaceId target_id = target->id;
  std::map<PlaceId, std::set<ImageId>> leaving;
  for (const ImageId& image : images) {
    const Place* from = map::find_place_of(map, image);
    if (from == nullptr) return no_place_with(image);
    if (from->id != target_id) leaving[from->id].insert(image);
  }
  if (leaving.empty()) {
    return scene.already_so(
        {ErrorCode::kInvalidInput, "Place " + target_id.str() + " holds these images already.", target_id.str()});
  }
  std::map<PlaceId, Remainder> left_of_place;
  for (const auto& [id, gone] : leaving) {
    auto left = left_of(scene, *map::find_place(map, id), gone);
    if (!left) return pass_on(left);
    left_of_place.emplace(id, std::move(*left));
  }
  ClosedWays closed;
  for (auto& [id, left] : left_of_place) {
    closed.merge(closed_ways(map, id));
    Place& from = *map::find_place(map, id);
    Place& to = *map::find_place(map, target_id);
    const std::vector<ImageId> gone(leaving[id].begin(), leaving[id].end());
    const std::set<PlaceId> driven = driven_from(map, from);
    for (const auto& entry : from.appearances.entries()) {
      if (leaving[id].contains(entry.image)) to.appearances.push_back(entry);
    }
    to.members.insert(to.members.end(), gone.begin(), gone.end());
    sort_members(map, to);
    const bool other_prototype = left.known.has_value();
    put_remainder(from, std::move(left), gone);
    const std::set<PlaceId> still = driven_from(map, from);
    std::erase_if(map.edges, [&, from_id = id](const Edge& edge) {
      if (!ends_at(edge, from_id) || edge.by == map::Decider::kPerson) return false;
      const PlaceId& beside = other_end(edge, from_id);
      return driven.contains(beside) && !still.contains(beside);
    });
    join_what_was_driven(scene, id);
    if (other_prototype) see_all_from(scene, id);
  }
  for (map::Destination& destination : map.destinations) {
    if (std::ranges::find(images, destination.image) != images.end()) destination.place = target_id;
  }
  join_what_was_driven(scene, target_id, closed);
  tidy_edges(map);
  return {};
}

Status delete_place(EditScene& scene, const ImageId& image) {
  TopologicalMap& map = scene.map();
  const Place* place = map::find_place_of(map, image);
  if (place == nullptr) {
    const bool known = std::ranges::find(map.images, image, &map::MapImage::id) != map.images.end();
    const auto none = no_place_with(image);
    return known ? scene.already_so(none.value()) : Status(none);
  }
  const PlaceId id = place->id;
  std::erase_if(map.places, [&](const Place& p) { return p.id == id; });
  std::erase_if(map.destinations, [&](const map::Destination& d) { return d.place == id; });
  tidy_edges(map);
  return {};
}

}  // namespace homeward::mapping
