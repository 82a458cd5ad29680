// SPDX-License-Identifier: Apache-2.0
#include "mapping/edit_log.hpp"

#include <algorithm>
#include <memory>
#include <ranges>
#include <string>
#include <utility>

#include "map/state.hpp"
#include "mapping/destination_edits.hpp"
#include "mapping/place_edits.hpp"
#include "mapping/shortcut_edges.hpp"
#include "mapping/way_edits.hpp"

namespace homeward::mapping {
namespace {

using map::Edit;
using map::EditKind;
using map::TopologicalMap;

Status apply_to(EditScene& scene) {
  const Edit& edit = scene.edit();
  switch (edit.kind) {
    case EditKind::kRename:
      return rename_place(scene);
    case EditKind::kMerge:
      return merge_places(scene, edit.image_a, edit.image_b);
    case EditKind::kSplit:
      return split_place(scene, edit.image_a, edit.images);
    case EditKind::kDelete:
      return delete_place(scene, edit.image_a);
    case EditKind::kMove:
      return move_images(scene, edit.image_a, edit.images);
    case EditKind::kAddEdge:
      return add_edge(scene);
    case EditKind::kRemoveEdge:
      return remove_edge(scene);
    case EditKind::kBlockEdge:
      return block_edge(scene);
    case EditKind::kDecide:
      return decide_hypothesis(scene);
    case EditKind::kDecideShortcut:
      return decide_shortcut(scene.map(), edit);
    case EditKind::kAddDestination:
      return add_destination(scene);
    case EditKind::kRemoveDestination:
      return remove_destination(scene);
    case EditKind::kNameDestination:
      return name_destination(scene);
    case EditKind::kSetPictogram:
      return set_pictogram(scene);
    case EditKind::kSetDestinationPicture:
      return set_destination_picture(scene);
    case EditKind::kSetAside:
      return set_aside(scene);
  }
  return fail(ErrorCode::kInvalidInput, "This kind of edit is not known.", "kind");
}

/// Whether an edit may change which ways there are, or between which pictures.
bool changes_ways(EditKind kind) {
  return kind != EditKind::kRename && kind != EditKind::kBlockEdge && kind < EditKind::kAddDestination;
}

Status apply_to(TopologicalMap& map, Edit& edit, const LookAt& look, bool again) {
  EditScene scene(map, edit, look, again);
  const Status applied = apply_to(scene);
  if (applied && changes_ways(edit.kind)) settle_shortcuts(map);
  return applied;
}

/// The log again on the unedited state. Each edit finds the log as it was when it was first applied.
void replay(TopologicalMap& map, const LookAt& look) {
  map::put_state(map, *map.unedited);
  std::vector<Edit> log = std::exchange(map.edits, {});
  map.edits.reserve(log.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (i >= map.settled_edits && !log[i].undone) {
      const Status status = apply_to(map, log[i], look, true);
      log[i].lost = status ? std::string() : status.error().message;
    }
    map.edits.push_back(std::move(log[i]));
  }
}

}  // namespace

void replay_on_unedited(TopologicalMap& map) { replay(map, {}); }

std::int64_t next_change(const TopologicalMap& map) {
  std::int64_t latest = 0;
  for (const Edit& edit : map.edits) latest = std::max(latest, edit.change);
  return latest + 1;
}

Status apply_edit(TopologicalMap& map, const Edit& edit, const LookAt& look) {
  Edit logged = edit;
  auto unedited = map.unedited ? map.unedited : map::state_of(map);
  if (const Status applied = apply_to(map, logged, look, false); !applied) return applied;
  if (!map.unedited) map.settled_edits = map.edits.size();
  map.unedited = std::move(unedited);
  if (logged.change == 0) logged.change = next_change(map);
  logged.undone = false;
  logged.redoable = false;
  for (Edit& earlier : map.edits) earlier.redoable = false;
  map.edits.push_back(std::move(logged));
  ++map.revision;
  return {};
}

Status undo_change(TopologicalMap& map) {
  const auto latest = std::ranges::find(map.edits.rbegin(), map.edits.rend(), false, &Edit::undone);
  if (latest == map.edits.rend()) return fail(ErrorCode::kNotFound, "There is no change to undo.");
  const auto position = static_cast<std::size_t>(map.edits.rend() - latest) - 1;
  if (!map.unedited || position < map.settled_edits) {
    return fail(ErrorCode::kConflict,
                "This change is of before the map kept how it was without: rebuild the map to take it back.");
  }
  const std::int64_t change = latest->change;
  for (std::size_t i = map.settled_edits; i < map.edits.size(); ++i) {
    Edit& edit = map.edits[i];
    if (edit.change != change || edit.undone) continue;
    edit.undone = true;
    edit.redoable = true;
  }
  replay(map, {});
  ++map.revision;
  return {};
}

Status redo_change(TopologicalMap& map, const LookAt& look) {
  const auto first = map.edits.begin() + static_cast<std::ptrdiff_t>(std::min(map.settled_edits, map.edits.size()));
  const auto earliest = std::ranges::find(first, map.edits.end(), true, &Edit::redoable);
  if (!map.unedited || earliest == map.edits.end()) {
    return fail(ErrorCode::kNotFound, "There is no change to redo.");
  }
  const std::int64_t change = earliest->change;
  TopologicalMap changed = map;
  for (Edit& edit : changed.edits) {
    if (edit.change != change || !edit.redoable) continue;
    Edit again = edit;  // the map's own log is part of what is changed
    const Status status = apply_to(changed, again, look, true);
    // What could not be kept before need not be kept now.
    if (!status && again.lost.empty()) return status;
    again.lost = status ? std::string() : status.error().message;
    again.undone = false;
    again.redoable = false;
    edit = std::move(again);
  }
  ++changed.revision;
  map = std::move(changed);
  return {};
}

Result<TopologicalMap> as_of_change(const TopologicalMap& map, std::int64_t change) {
  const auto stands = [](const Edit& edit) { return !edit.undone; };
  const auto is_it = [&](const Edit& edit) { return edit.change == change && stands(edit); };
  if (change != 0 && std::ranges::none_of(map.edits, is_it)) {
    return fail(ErrorCode::kNotFound, "The map has no change " + std::to_string(change) + " that stands.", "change");
  }
  TopologicalMap former = map;
  for (std::size_t i = 0; i < former.edits.size(); ++i) {
    Edit& edit = former.edits[i];
    if (edit.change <= change || edit.undone) continue;
    if (!map.unedited || i < map.settled_edits) {
      return fail(ErrorCode::kConflict, "The map does not know any more how it was before its edits.", "change");
    }
    edit.undone = true;
  }
  if (map.unedited) replay(former, {});
  return former;
}

void replay_edits(TopologicalMap& map, const std::vector<Edit>& log, bool rebuilt, const LookAt& look) {
  if (!map.unedited) {
    forget_decisions(map, log);
    map.unedited = map::state_of(map);
  }
  map.settled_edits = 0;
  map.edits = log;
  for (Edit& edit : map.edits) {
    if (rebuilt) edit.found = {edit.found.made, edit.found.prototypes, {}, {}, {}};
  }
  replay(map, look);
  if (map.edits.empty()) map.unedited = nullptr;
}

}  // namespace homeward::mapping
