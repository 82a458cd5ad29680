// SPDX-License-Identifier: Apache-2.0
#include "mapping/edits.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

#include "map/lookup.hpp"
#include "mapping/place_edits.hpp"
#include "mapping/shortcut_edges.hpp"

namespace homeward::mapping {
namespace {

using map::Edit;
using map::EditKind;
using map::Place;
using map::TopologicalMap;

constexpr std::size_t kMaxLabelBytes = 200;

Status rename(TopologicalMap& map, const Edit& edit) {
  Place* place = map::find_place_of(map, edit.image_a);
  if (place == nullptr) return no_place_with(edit.image_a);
  if (edit.text.size() > kMaxLabelBytes) {
    return fail(ErrorCode::kInvalidInput, "A label may be at most 200 bytes long.", "label");
  }
  place->label = edit.text;
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
    if (const Status merged = merge_places(map, edit.image_a, edit.image_b); !merged) return merged;
  }
  if (!accept && a == b) {
    std::vector<ImageId> leaving = run_around(map, *b, edit.image_b);
    const bool holds_prototype = std::ranges::find(leaving, b->prototype) != leaving.end();
    if (holds_prototype) leaving = run_around(map, *a, edit.image_a);
    const ImageId staying = holds_prototype ? edit.image_b : edit.image_a;
    if (const Status parted = split_place(map, staying, leaving); !parted) return parted;
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
      return merge_places(map, edit.image_a, edit.image_b);
    case EditKind::kSplit:
      return split_place(map, edit.image_a, edit.images);
    case EditKind::kDelete:
      return delete_place(map, edit.image_a);
    case EditKind::kMove:
      return move_images(map, edit.image_a, edit.images);
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

Status undo_edit(TopologicalMap& map, const Edit& undone) {
  switch (undone.kind) {
    case EditKind::kRename:
      return undo_rename(map, undone);
    case EditKind::kBlockEdge:
      return undo_block(map, undone);
    case EditKind::kAddEdge:
      return undo_add_edge(map, undone);
    case EditKind::kDecideShortcut:
      return undo_shortcut_decision(map, undone);
    default:
      return fail(ErrorCode::kConflict,
                  "This edit changed which places and edges there are: rebuild the map to take it back.");
  }
}

}  // namespace

std::int64_t next_change(const TopologicalMap& map) {
  std::int64_t latest = 0;
  for (const Edit& edit : map.edits) latest = std::max(latest, edit.change);
  return latest + 1;
}

Status apply_edit(TopologicalMap& map, const Edit& edit) {
  if (const Status applied = apply_to(map, edit); !applied) return applied;
  settle_shortcuts(map);
  const std::int64_t next = next_change(map);
  for (Edit& earlier : map.edits) earlier.redoable = false;
  map.edits.push_back(edit);
  Edit& logged = map.edits.back();
  if (logged.change == 0) logged.change = next;
  logged.undone = false;
  logged.redoable = false;
  ++map.revision;
  return {};
}

Status undo_change(TopologicalMap& map) {
  const auto latest = std::ranges::find(map.edits.rbegin(), map.edits.rend(), false, &Edit::undone);
  if (latest == map.edits.rend()) return fail(ErrorCode::kNotFound, "There is no change to undo.");
  const std::int64_t change = latest->change;
  TopologicalMap changed = map;  // where one edit cannot be undone, the others stand too
  std::vector<Edit> undone;      // latest first
  for (Edit& edit : std::views::reverse(changed.edits)) {
    if (edit.change != change || edit.undone) continue;
    edit.undone = true;
    edit.redoable = true;
    undone.push_back(edit);
  }
  for (const Edit& edit : undone) {
    if (const Status status = undo_edit(changed, edit); !status) return status;
  }
  settle_shortcuts(changed);
  ++changed.revision;
  map = std::move(changed);
  return {};
}

Status redo_change(TopologicalMap& map) {
  const auto earliest = std::ranges::find(map.edits, true, &Edit::redoable);
  if (earliest == map.edits.end()) return fail(ErrorCode::kNotFound, "There is no change to redo.");
  const std::int64_t change = earliest->change;
  TopologicalMap changed = map;
  for (Edit& edit : changed.edits) {
    if (edit.change != change || !edit.redoable) continue;
    if (const Status status = apply_to(changed, edit); !status) return status;
    edit.undone = false;
    edit.redoable = false;
  }
  settle_shortcuts(changed);
  ++changed.revision;
  map = std::move(changed);
  return {};
}

void replay_edits(TopologicalMap& map, const std::vector<Edit>& log) {
  forget_decisions(map, log);
  for (const Edit& edit : log) {
    // What the rebuilt map no longer has cannot be edited; the person's word stays in the log for the next rebuild.
    if (!edit.undone) static_cast<void>(apply_to(map, edit));
  }
  const std::vector<Edit> applied = std::exchange(map.edits, log);
  for (std::size_t i = 0; i < std::min(applied.size(), log.size()); ++i) {
    if (log[i].undone && !applied[i].undone) static_cast<void>(undo_edit(map, log[i]));
  }
  settle_shortcuts(map);
}

}  // namespace homeward::mapping
