// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "mapping/edit_scene.hpp"

namespace homeward::mapping {

/// A map with the edits of a draft.
struct DraftedMap {
  map::TopologicalMap map;       // at the revision of the map below
  std::vector<map::Edit> edits;  // the draft's; `lost` says why the map does not take one
};

/// Applies a draft, whose changes are numbered from 1, to a map; its edits follow the map's own in the log. What was
/// undone is left out, and so is what the map does not take, which it may have done when the edit was made: the map
/// has changed since. `look` as in apply_edit. Ours.
DraftedMap apply_draft(const map::TopologicalMap& base, const std::vector<map::Edit>& edits, const LookAt& look);

/// One more edit of a draft. `edit.change` numbers the draft's changes. Errors: those of apply_edit; nothing is changed
/// then.
Status edit_draft(DraftedMap& draft, const map::TopologicalMap& base, const map::Edit& edit, const LookAt& look);

/// The number of the next change of a draft.
std::int64_t next_change(const std::vector<map::Edit>& draft);

/// Marks the latest change of a draft that stands undone. Errors: kNotFound (there is none).
Status undo_in_draft(std::vector<map::Edit>& edits);

/// Lets the change stand again that was undone last. Errors: kNotFound (none was undone since the latest edit).
Status redo_in_draft(std::vector<map::Edit>& edits);

/// The places of `base` that are other in `after` or whose ways or destinations are, in the order of `base`.
std::vector<PlaceId> changed_places(const map::TopologicalMap& base, const map::TopologicalMap& after);

}  // namespace homeward::mapping
