// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "mapping/edit_scene.hpp"

namespace homeward::mapping {

/// Applies a person's edit to a map, appends it to the log and raises the revision by one. Places are named by any
/// image they hold and destinations by theirs, so that the same edit can be applied to a rebuilt map.
///   kRename                 image_a's place gets label `text`
///   kMerge                  the place of image_b joins that of image_a
///   kSplit                  `images` leave the place of image_a and become one of their own
///   kMove                   `images` leave their places for that of image_a
///   kDelete                 the place of image_a goes, with its edges and destinations
///   kAddEdge                an edge both ways between the places of image_a and image_b
///   kRemoveEdge             both edges between these two places go
///   kBlockEdge              the edge from image_a's to image_b's place, one way alone, is blocked ("true") or opened
///   kDecideShortcut         the shortcut between image_a and image_b is accepted, and then an edge both ways, or not
///   kDecide                 the hypothesis image_a, image_b is accepted or rejected, one of the person's own where the
///                           map has none; the two places merge or split accordingly
///   kSetAside               nothing changes: a person is not sure of the doubt `text` about image_a and image_b
///   kAddDestination         image_a becomes a destination called `text`
///   kRemoveDestination      the destination of image_a goes
///   kNameDestination        ... is called `text`
///   kSetPictogram           ... is known by the pictogram `text`
///   kSetDestinationPicture  ... is where image_b was taken, facing as that does
/// Prototypes, appearances and ways follow (place_edits.hpp, way_edits.hpp, destination_edits.hpp). `look` gives
/// pictures that an edit needs and the map does not keep.
/// It belongs to the change that `edit.change` names, which is the latest of the log or the next; 0: it is a change of
/// its own. Changes that were undone can be redone no more. Shortcuts whose pictures are no longer the prototypes of
/// two places go. Errors: kInvalidInput (what is wrong with the edit), kNotFound (image, edge, destination or
/// shortcut), kConflict (what does not hold); the map is then unchanged.
Status apply_edit(map::TopologicalMap& map, const map::Edit& edit, const LookAt& look = {});

/// The number of the next change of a map.
std::int64_t next_change(const map::TopologicalMap& map);

/// Takes back the latest change that still stands, all its edits: they stay in the log, marked undone; the revision
/// rises by one. The map is exactly as it was before them. Errors: kNotFound (no change to undo), kConflict (a change
/// of before a file that knows what it changed: only a rebuild can take it back); the map is then unchanged.
Status undo_change(map::TopologicalMap& map);

/// Applies the change again that was undone last, all its edits; the revision rises by one. The map is exactly as it
/// was with them. `look` as in apply_edit, for what a rebuild has forgotten. Errors: kNotFound (no change was undone
/// since the latest edit), those of apply_edit where a rebuild has changed the map meanwhile, but of edits that were
/// lost before; the map is then unchanged.
Status redo_change(map::TopologicalMap& map, const LookAt& look = {});

/// The map as it was after a change, 0: without any; later ones count as undone. The revision stays. Errors: kNotFound
/// (no such change, or it was taken back), kConflict (the map has forgotten how it was).
Result<map::TopologicalMap> as_of_change(const map::TopologicalMap& map, std::int64_t change);

/// Makes `log` the log of a map and the map what its edits that stand make of it, oldest first, from its unedited state
/// or, where it has none, from what it is. What the map is already counts as kept. Edits that cannot be applied stay in
/// the log for the next rebuild and say why (map::Edit::lost). `rebuilt`: the map is of other pictures or made
/// otherwise than the one that the log was written on: what edits found out then is found out anew. The revision stays.
void replay_edits(map::TopologicalMap& map, const std::vector<map::Edit>& log, bool rebuilt = true,
                  const LookAt& look = {});

/// Makes a map again of its unedited state, which it has, and its log. Pictures are not looked at anew.
void replay_on_unedited(map::TopologicalMap& map);

/// `after` is `before`, edited, with what tours and drives brought: appearances, images at its places, places, edges,
/// hypotheses, shortcuts, destinations. The unedited state of `after` becomes that of `before` with the same, so that
/// edits of before can still be taken back. For whoever changes an edited map otherwise than by edits.
void carry_over(const map::TopologicalMap& before, map::TopologicalMap& after);

}  // namespace homeward::mapping
