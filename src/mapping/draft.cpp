// SPDX-License-Identifier: Apache-2.0
#include "mapping/draft.hpp"

#include <algorithm>
#include <ranges>
#include <unordered_set>

#include "map/difference.hpp"
#include "mapping/edit_log.hpp"

namespace homeward::mapping {
namespace {

/// Applies an edit of a draft to a map that holds those before it.
Status apply_numbered(map::TopologicalMap& map, map::Edit edit, std::int64_t changes_below, const LookAt& look) {
  edit.change += changes_below;
  return apply_edit(map, edit, look);
}

}  // namespace

DraftedMap apply_draft(const map::TopologicalMap& base, const std::vector<map::Edit>& edits, const LookAt& look) {
  DraftedMap drafted{base, edits};
  const std::int64_t changes_below = next_change(base) - 1;
  for (map::Edit& edit : drafted.edits) {
    edit.lost.clear();
    if (edit.undone) continue;
    const Status applied = apply_numbered(drafted.map, edit, changes_below, look);
    if (!applied) edit.lost = applied.error().message;
  }
  drafted.map.revision = base.revision;
  return drafted;
}

Status edit_draft(DraftedMap& draft, const map::TopologicalMap& base, const map::Edit& edit, const LookAt& look) {
  if (const Status applied = apply_numbered(draft.map, edit, next_change(base) - 1, look); !applied) return applied;
  draft.map.revision = base.revision;
  for (map::Edit& earlier : draft.edits) earlier.redoable = false;
  draft.edits.push_back(edit);
  return {};
}

std::int64_t next_change(const std::vector<map::Edit>& draft) {
  std::int64_t latest = 0;
  for (const map::Edit& edit : draft) latest = std::max(latest, edit.change);
  return latest + 1;
}

Status undo_in_draft(std::vector<map::Edit>& edits) {
  const auto latest = std::ranges::find(edits.rbegin(), edits.rend(), false, &map::Edit::undone);
  if (latest == edits.rend()) return fail(ErrorCode::kNotFound, "There is no change to undo.");
  const std::int64_t change = latest->change;
  for (map::Edit& edit : edits) {
    if (edit.change != change) continue;
    edit.undone = true;
    edit.redoable = true;
  }
  return {};
}

Status redo_in_draft(std::vector<map::Edit>& edits) {
  const auto earliest = std::ranges::find(edits, true, &map::Edit::redoable);
  if (earliest == edits.end()) return fail(ErrorCode::kNotFound, "There is no change to redo.");
  const std::int64_t change = earliest->change;
  for (map::Edit& edit : edits) {
    if (edit.change != change) continue;
    edit.undone = false;
    edit.redoable = false;
  }
  return {};
}

std::vector<PlaceId> changed_places(const map::TopologicalMap& base, const map::TopologicalMap& after) {
  const map::MapDifference difference = map::difference(base, after);
  std::unordered_set<PlaceId> changed;
  for (const map::PlaceDifference& place : difference.places) changed.insert(place.id);
  for (const map::EdgeDifference& edge : difference.edges) {
    changed.insert(edge.from);
    changed.insert(edge.to);
  }
  for (const map::DestinationDifference& destination : difference.destinations) {
    if (destination.before) changed.insert(destination.before->place);
    if (destination.after) changed.insert(destination.after->place);
  }
  std::unordered_set<ImageId> decided;
  for (const map::DecisionDifference& decision : difference.hypotheses) {
    decided.insert(decision.image_a);
    decided.insert(decision.image_b);
  }
  std::vector<PlaceId> places;
  for (const map::Place& place : base.places) {
    const bool holds_decided =
        std::ranges::any_of(place.members, [&](const ImageId& id) { return decided.contains(id); });
    if (holds_decided || changed.contains(place.id)) places.push_back(place.id);
  }
  return places;
}

}  // namespace homeward::mapping
