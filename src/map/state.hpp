// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "map/topological_map.hpp"

namespace homeward::map {

/// Puts what people's edits change, places, edges, hypotheses, shortcuts and destinations, as it is in `state`.
void put_state(TopologicalMap& map, const TopologicalMap& state);

/// A map of these alone, as TopologicalMap::unedited is. Shares the appearances of places.
std::shared_ptr<const TopologicalMap> state_of(const TopologicalMap& map);

}  // namespace homeward::map
