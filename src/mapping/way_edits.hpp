// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "mapping/edit_scene.hpp"

namespace homeward::mapping {

// What people's edits do to the ways between places, see edit_log.hpp. The edit names its two places by an image of
// each. Errors: kInvalidInput, kNotFound (image or edge), kConflict; the map is then unchanged.

/// An edge each way, seen as far as the two prototypes see each other.
Status add_edge(EditScene& scene);

/// Both edges go; an accepted shortcut between the two is rejected.
Status remove_edge(EditScene& scene);

/// The edge from the first place to the second is blocked or opened again.
Status block_edge(EditScene& scene);

/// The hypothesis on two pictures is accepted or rejected: their places merge, or part where the tour drove through one
/// after the other. Where the map has none it gets one, of the person alone.
Status decide_hypothesis(EditScene& scene);

/// A person is not sure of a doubt (map::Doubt): the map stays as it is. `edit.text` is the kind of doubt.
Status set_aside(EditScene& scene);

}  // namespace homeward::mapping
