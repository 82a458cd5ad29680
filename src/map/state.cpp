// SPDX-License-Identifier: Apache-2.0
#include "map/state.hpp"

namespace homeward::map {

void put_state(TopologicalMap& map, const TopologicalMap& state) {
  map.places = state.places;
  map.edges = state.edges;
  map.hypotheses = state.hypotheses;
  map.shortcuts = state.shortcuts;
  map.destinations = state.destinations;
}

std::shared_ptr<const TopologicalMap> state_of(const TopologicalMap& map) {
  auto state = std::make_shared<TopologicalMap>();
  put_state(*state, map);
  return state;
}

}  // namespace homeward::map
