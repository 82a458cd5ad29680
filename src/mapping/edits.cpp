// SPDX-License-Identifier: Apache-2.0
#include "mapping/edits.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "map/lookup.hpp"
#include "mapping/shortcut_edges.hpp"

namespace homeward::mapping {
namespace {

using map::Edit;
using map::EditKind;
using map::Place;
using map::TopologicalMap;

constexpr std::size_t kMaxLabelBytes = 200;

tl::unexpected<Error> no_place_with(const ImageId& image) {
  return fail(ErrorCode::kNotFound, "No place of the map holds the image " + image.str() + ".", image.str());
}

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
  std::ranges::stable_partition(map.edges, [](const map::Edge& edge) { return !edge.shortcut; });
  std::erase_if(map.edges, [&](const map::Edge& edge) {
    if (edge.from == edge.to || !index.contains(edge.from) || !index.contains(edge.to)) return true;
    return !seen.emplace(edge.from, edge.to).second;
  });
}

void redirect(TopologicalMap& map, const PlaceId& gone, const PlaceId& kept) {
  for (map::Edge& edge : map.edges) {
    // Bearings belong to the prototype of the place that goes.
    if (edge.from != gone && edge.to != gone) continue;
    edge.bearing_rad.reset();
    edge.turn_rad.reset();
    edge.confidence = 0.0;
    edge.inliers = 0;
    edge.weak = true;
    if (edge.from == gone) edge.from = kept;
    if (edge.to == gone) edge.to = kept;
  }
  for (map::Destination& destination : map.destinations) {
    if (destination.place == gone) destination.place = kept;
  }
  tidy_edges(map);
}

Status rename(TopologicalMap& map, const Edit& edit) {
  Place* place = map::find_place_of(map, edit.image_a);
  if (place == nullptr) return no_place_with(edit.image_a);
  if (edit.text.size() > kMaxLabelBytes) {
    return fail(ErrorCode::kInvalidInput, "A label may be at most 200 bytes long.", "label");
  }
  place->label = edit.text;
  return {};
}

Status merge(TopologicalMap& map, const ImageId& image_a, const ImageId& image_b) {
  Place* kept = map::find_place_of(map, image_a);
  const Place* gone = map::find_place_of(map, image_b);
  if (kept == nullptr) return no_place_with(image_a);
  if (gone == nullptr) return no_place_with(image_b);
  if (kept == gone) return fail(ErrorCode::kInvalidInput, "Both images are in place " + kept->id.str() + " already.");
  kept->members.insert(kept->members.end(), gone->members.begin(), gone->members.end());
  kept->appearances.insert(kept->appearances.end(), gone->appearances.begin(), gone->appearances.end());
  if (kept->label.empty()) kept->label = gone->label;
  sort_members(map, *kept);
  const PlaceId kept_id = kept->id;
  const PlaceId gone_id = gone->id;
  std::erase_if(map.places, [&](const Place& place) { return place.id == gone_id; });
  redirect(map, gone_id, kept_id);
  return {};
}

/// Takes images out of a place. A place keeps at least its prototype.
Status take_out(Place& place, const std::vector<ImageId>& images) {
  for (const ImageId& image : images) {
    if (image == place.prototype) {
      return fail(
          ErrorCode::kInvalidInput,
          "The image " + image.str() + " is the prototype of place " + place.id.str() + " and has to stay there.",
          image.str());
    }
    if (std::ranges::find(place.members, image) == place.members.end()) {
      return fail(ErrorCode::kNotFound, "Place " + place.id.str() + " does not hold the image " + image.str() + ".",
                  image.str());
    }
  }
  std::erase_if(place.members, [&](const ImageId& id) { return std::ranges::find(images, id) != images.end(); });
  return {};
}

void join_both_ways(TopologicalMap& map, const PlaceId& a, const PlaceId& b, map::Decider by) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (map::find_edge(map, from, to) != nullptr) continue;
    map::Edge edge;
    edge.from = from;
    edge.to = to;
    edge.weak = true;
    edge.by = by;
    map.edges.push_back(edge);
  }
}

Status split(TopologicalMap& map, const ImageId& image_a, const std::vector<ImageId>& named) {
  const std::set<ImageId> once(named.begin(), named.end());
  const std::vector<ImageId> images(once.begin(), once.end());
  Place* old_place = map::find_place_of(map, image_a);
  if (old_place == nullptr) return no_place_with(image_a);
  if (images.empty()) return fail(ErrorCode::kInvalidInput, "A split has to name the images that leave.", "images");
  if (const Status taken = take_out(*old_place, images); !taken) return taken;
  Place fresh;
  fresh.id = PlaceId("p" + std::to_string(map.next_place_number++));
  fresh.members = images;
  sort_members(map, fresh);
  // Appearances of members are not kept, only those of prototypes: until the map is rebuilt the new place looks like
  // the old one.
  fresh.prototype = fresh.members[fresh.members.size() / 2];
  fresh.appearances = {old_place->appearances.front()};
  const PlaceId old_id = old_place->id;
  const PlaceId fresh_id = fresh.id;
  map.places.push_back(std::move(fresh));
  for (map::Destination& destination : map.destinations) {
    if (std::ranges::find(images, destination.image) != images.end()) destination.place = fresh_id;
  }
  // The tour leads on from the last image that left to the next one that stayed, or to another place.
  const auto index = map::image_indices(map);
  for (const ImageId& image : images) {
    const int at = index.at(image);
    for (const int next : {at - 1, at + 1}) {
      if (next < 0 || next >= static_cast<int>(map.images.size())) continue;
      const Place* neighbour = map::find_place_of(map, map.images[static_cast<std::size_t>(next)].id);
      if (neighbour != nullptr && neighbour->id != fresh_id)
        join_both_ways(map, fresh_id, neighbour->id, map::Decider::kPerson);
    }
  }
  if (map::find_edge(map, old_id, fresh_id) == nullptr) tidy_edges(map);
  return {};
}

Status move_images(TopologicalMap& map, const Edit& edit) {
  const Place* target = map::find_place_of(map, edit.image_a);
  if (target == nullptr) return no_place_with(edit.image_a);
  if (edit.images.empty()) return fail(ErrorCode::kInvalidInput, "A move has to name the images that go.", "images");
  const PlaceId target_id = target->id;
  TopologicalMap changed = map;
  for (const ImageId& image : edit.images) {
    Place* from = map::find_place_of(changed, image);
    if (from == nullptr) return no_place_with(image);
    if (from->id == target_id) continue;
    if (const Status taken = take_out(*from, {image}); !taken) return taken;
    map::find_place(changed, target_id)->members.push_back(image);
    for (map::Destination& destination : changed.destinations) {
      if (destination.image == image) destination.place = target_id;
    }
  }
  sort_members(changed, *map::find_place(changed, target_id));
  map = std::move(changed);
  return {};
}

Status delete_place(TopologicalMap& map, const ImageId& image) {
  const Place* place = map::find_place_of(map, image);
  if (place == nullptr) return no_place_with(image);
  const PlaceId id = place->id;
  std::erase_if(map.places, [&](const Place& p) { return p.id == id; });
  std::erase_if(map.destinations, [&](const map::Destination& d) { return d.place == id; });
  tidy_edges(map);
  return {};
}

struct EdgeEnds {
  PlaceId from;
  PlaceId to;
};

Result<EdgeEnds> edge_ends(const TopologicalMap& map, const Edit& edit) {
  const Place* from = map::find_place_of(map, edit.image_a);
  const Place* to = map::find_place_of(map, edit.image_b);
  if (from == nullptr) return no_place_with(edit.image_a);
  if (to == nullptr) return no_place_with(edit.image_b);
  if (from == to) return fail(ErrorCode::kInvalidInput, "Both images are in place " + from->id.str() + ".");
  return EdgeEnds{from->id, to->id};
}

tl::unexpected<Error> no_edge(const EdgeEnds& ends) {
  return fail(ErrorCode::kNotFound, "The map has no edge from " + ends.from.str() + " to " + ends.to.str() + ".",
              ends.from.str());
}

Status add_edge(TopologicalMap& map, const Edit& edit) {
  const auto ends = edge_ends(map, edit);
  if (!ends) return pass_on(ends);
  join_both_ways(map, ends->from, ends->to, map::Decider::kPerson);
  return {};
}

Status remove_edge(TopologicalMap& map, const Edit& edit) {
  const auto ends = edge_ends(map, edit);
  if (!ends) return pass_on(ends);
  const auto removed = std::erase_if(map.edges, [&](const map::Edge& edge) {
    return (edge.from == ends->from && edge.to == ends->to) || (edge.from == ends->to && edge.to == ends->from);
  });
  if (removed == 0) return no_edge(*ends);
  reject_shortcuts(map, ends->from, ends->to, edit.by);
  return {};
}

Status block_edge(TopologicalMap& map, const Edit& edit) {
  if (edit.text != "true" && edit.text != "false") {
    return fail(ErrorCode::kInvalidInput, "An edge is blocked with \"true\" or opened with \"false\".", "blocked");
  }
  const auto ends = edge_ends(map, edit);
  if (!ends) return pass_on(ends);
  map::Edge* edge = map::find_edge(map, ends->from, ends->to);
  if (edge == nullptr) return no_edge(*ends);
  edge->blocked = edit.text == "true";
  return {};
}

/// The images of the place of `image` that the tour drove through together with it.
std::vector<ImageId> run_around(const TopologicalMap& map, const Place& place, const ImageId& image) {
  const auto index = map::image_indices(map);
  const auto in_place = [&](int at) {
    return at >= 0 && at < static_cast<int>(map.images.size()) &&
           std::ranges::find(place.members, map.images[static_cast<std::size_t>(at)].id) != place.members.end();
  };
  int first = index.at(image);
  int last = first;
  while (in_place(first - 1)) --first;
  while (in_place(last + 1)) ++last;
  std::vector<ImageId> run;
  for (int at = first; at <= last; ++at) run.push_back(map.images[static_cast<std::size_t>(at)].id);
  return run;
}

Status decide(TopologicalMap& map, const Edit& edit) {
  if (edit.text != "accept" && edit.text != "reject") {
    return fail(ErrorCode::kInvalidInput, "A hypothesis can be decided with \"accept\" or \"reject\".", "decision");
  }
  const auto concerned = [&](const map::Hypothesis& h) {
    return (h.prototype_a == edit.image_a && h.prototype_b == edit.image_b) ||
           (h.prototype_a == edit.image_b && h.prototype_b == edit.image_a);
  };
  const auto found = std::ranges::find_if(map.hypotheses, concerned);
  if (found == map.hypotheses.end()) {
    return fail(ErrorCode::kNotFound,
                "The map has no hypothesis on " + edit.image_a.str() + " and " + edit.image_b.str() + ".",
                edit.image_a.str());
  }
  const Place* a = map::find_place_of(map, edit.image_a);
  const Place* b = map::find_place_of(map, edit.image_b);
  if (a == nullptr) return no_place_with(edit.image_a);
  if (b == nullptr) return no_place_with(edit.image_b);
  const bool accept = edit.text == "accept";
  if (accept && a != b) {
    if (const Status merged = merge(map, edit.image_a, edit.image_b); !merged) return merged;
  }
  if (!accept && a == b) {
    std::vector<ImageId> leaving = run_around(map, *b, edit.image_b);
    const bool holds_prototype = std::ranges::find(leaving, b->prototype) != leaving.end();
    if (holds_prototype) leaving = run_around(map, *a, edit.image_a);
    const ImageId staying = holds_prototype ? edit.image_b : edit.image_a;
    if (const Status parted = split(map, staying, leaving); !parted) return parted;
  }
  found->decision = accept ? map::Decision::kAccepted : map::Decision::kRejected;
  found->by = map::Decider::kPerson;
  return {};
}

Status apply_to(TopologicalMap& map, const Edit& edit) {
  switch (edit.kind) {
    case EditKind::kRename:
      return rename(map, edit);
    case EditKind::kMerge:
      return merge(map, edit.image_a, edit.image_b);
    case EditKind::kSplit:
      return split(map, edit.image_a, edit.images);
    case EditKind::kDelete:
      return delete_place(map, edit.image_a);
    case EditKind::kMove:
      return move_images(map, edit);
    case EditKind::kAddEdge:
      return add_edge(map, edit);
    case EditKind::kRemoveEdge:
      return remove_edge(map, edit);
    case EditKind::kBlockEdge:
      return block_edge(map, edit);
    case EditKind::kDecide:
      return decide(map, edit);
    case EditKind::kDecideShortcut:
      return decide_shortcut(map, edit);
  }
  return fail(ErrorCode::kInvalidInput, "This kind of edit is not known.", "kind");
}

/// The label that a place has without any edit: that of its first mark.
std::string label_from_tour(const TopologicalMap& map, const Place& place) {
  for (const map::Destination& destination : map.destinations) {
    if (destination.place == place.id) return destination.label;
  }
  return {};
}

Status undo_rename(TopologicalMap& map, const Edit& undone) {
  Place* place = map::find_place_of(map, undone.image_a);
  if (place == nullptr) return no_place_with(undone.image_a);
  place->label = label_from_tour(map, *place);
  for (const Edit& edit : map.edits) {
    const bool same_place = std::ranges::find(place->members, edit.image_a) != place->members.end();
    if (edit.kind == EditKind::kRename && !edit.undone && same_place) place->label = edit.text;
  }
  return {};
}

Status undo_block(TopologicalMap& map, const Edit& undone) {
  const auto ends = edge_ends(map, undone);
  if (!ends) return pass_on(ends);
  map::Edge* edge = map::find_edge(map, ends->from, ends->to);
  if (edge == nullptr) return no_edge(*ends);
  edge->blocked = false;
  for (const Edit& edit : map.edits) {
    if (edit.kind != EditKind::kBlockEdge || edit.undone) continue;
    const auto same = edge_ends(map, edit);
    if (same && same->from == ends->from && same->to == ends->to) edge->blocked = edit.text == "true";
  }
  return {};
}

Status undo_add_edge(TopologicalMap& map, const Edit& undone) {
  const auto ends = edge_ends(map, undone);
  if (!ends) return pass_on(ends);
  std::erase_if(map.edges, [&](const map::Edge& edge) {
    const bool these =
        (edge.from == ends->from && edge.to == ends->to) || (edge.from == ends->to && edge.to == ends->from);
    return these && edge.by == map::Decider::kPerson && !edge.shortcut;
  });
  return {};
}

}  // namespace

Status apply_edit(TopologicalMap& map, const Edit& edit) {
  if (const Status applied = apply_to(map, edit); !applied) return applied;
  settle_shortcuts(map);
  map.edits.push_back(edit);
  map.edits.back().undone = false;
  ++map.revision;
  return {};
}

Status undo_last_edit(TopologicalMap& map) {
  const auto latest =
      std::ranges::find_if(map.edits.rbegin(), map.edits.rend(), [](const Edit& e) { return !e.undone; });
  if (latest == map.edits.rend()) return fail(ErrorCode::kNotFound, "There is no edit to undo.");
  latest->undone = true;
  Status undone;
  switch (latest->kind) {
    case EditKind::kRename:
      undone = undo_rename(map, *latest);
      break;
    case EditKind::kBlockEdge:
      undone = undo_block(map, *latest);
      break;
    case EditKind::kAddEdge:
      undone = undo_add_edge(map, *latest);
      break;
    case EditKind::kDecideShortcut:
      undone = undo_shortcut_decision(map, *latest);
      break;
    default:
      undone = fail(ErrorCode::kConflict,
                    "This edit changed which places and edges there are: rebuild the map to take it back.");
  }
  if (!undone) {
    latest->undone = false;
    return undone;
  }
  settle_shortcuts(map);
  ++map.revision;
  return {};
}

void replay_edits(TopologicalMap& map, const std::vector<Edit>& log) {
  forget_decisions(map, log);
  for (const Edit& edit : log) {
    // What the rebuilt map no longer has cannot be edited; the person's word stays in the log for the next rebuild.
    if (!edit.undone) static_cast<void>(apply_to(map, edit));
  }
  settle_shortcuts(map);
  map.edits = log;
}

}  // namespace homeward::mapping
