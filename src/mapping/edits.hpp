// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

/// Applies a person's edit to a map, appends it to the log and raises the revision by one. Places are named by any
/// image they hold, so that the same edit can be replayed on a rebuilt map.
///   kRename      image_a's place gets label `text`
///   kMerge       the place of image_b joins that of image_a
///   kSplit       `images` leave the place of image_a and become one of their own
///   kMove        `images` leave their places for that of image_a
///   kDelete      the place of image_a goes, with its edges and destinations
///   kAddEdge     an edge both ways between the places of image_a and image_b, if there is none
///   kRemoveEdge  both edges between these two places go
///   kBlockEdge   the edge from image_a's to image_b's place is blocked ("true") or opened again ("false")
///   kDecideShortcut  the shortcut between image_a and image_b is accepted, and then an edge both ways, or rejected
///   kDecide      the hypothesis image_a, image_b is accepted or rejected; the two places merge or split accordingly
/// It belongs to the change that `edit.change` names, which is the latest of the log or the next; 0: it is a change of
/// its own. Changes that were undone can be redone no more. Shortcuts whose pictures are no longer the prototypes of
/// two places go. Errors: kInvalidInput (what is wrong with the edit), kNotFound (image, edge, hypothesis or shortcut),
/// kConflict (a shortcut that no longer holds); the map is then unchanged.
Status apply_edit(map::TopologicalMap& map, const map::Edit& edit);

/// The number of the next change of a map.
std::int64_t next_change(const map::TopologicalMap& map);

/// Takes back the latest change that still stands, all its edits: they stay in the log, marked undone; the revision
/// rises by one. Labels, blocked edges, added edges and shortcuts return to what the edits before them say. Errors:
/// kNotFound (no change to undo), kConflict (an edit of it changed which images make up a place: only a rebuild can
/// take it back); the map is then unchanged.
Status undo_change(map::TopologicalMap& map);

/// Applies the change again that was undone last, all its edits; the revision rises by one. Errors: kNotFound (no
/// change was undone since the latest edit), those of apply_edit where a rebuild has changed the map meanwhile; the map
/// is then unchanged.
Status redo_change(map::TopologicalMap& map);

/// Applies the edits of `log` that stand to a rebuilt map, oldest first, and makes `log` its log. What stands in the
/// map's own log, an earlier state of `log`, and was undone since, is taken back. Edits whose images or edges are gone
/// are kept in the log and skipped. The revision is left as it is.
void replay_edits(map::TopologicalMap& map, const std::vector<map::Edit>& log);

}  // namespace homeward::mapping
