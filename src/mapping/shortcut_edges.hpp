// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

/// The shortcut between two pictures, in either order, or null.
map::Shortcut* find_shortcut(map::TopologicalMap& map, const ImageId& image_a, const ImageId& image_b);

/// Makes a map's edges and shortcuts agree: accepted shortcuts are edges both ways, others are none. What was seen of a
/// shortcut is of two pictures, so it goes where these are no longer the prototypes of two different places, or where
/// a tour has driven between the two meanwhile; a rejected one stays as long as the map has both pictures. A direction
/// that was blocked stays blocked. To be called after whatever changes places, edges or decisions.
void settle_shortcuts(map::TopologicalMap& map);

/// Accepts or rejects the shortcut that an edit of kind kDecideShortcut names. Errors: kInvalidInput (the edit's text),
/// kNotFound; kConflict (it would go at once, see above).
Status decide_shortcut(map::TopologicalMap& map, const map::Edit& edit);

/// Shortcuts that a log decided on are proposed again, also where the decision was taken back since: the log says anew.
void forget_decisions(map::TopologicalMap& map, const std::vector<map::Edit>& log);

/// Rejects the accepted shortcuts between two places: who takes away its edges does not want it.
void reject_shortcuts(map::TopologicalMap& map, const PlaceId& from, const PlaceId& to, const std::string& by);

}  // namespace homeward::mapping
