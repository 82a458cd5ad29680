// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "localisation/localiser.hpp"
#include "wire/belief_json.hpp"

namespace homeward::server {

/// A belief of the library as it is told to others.
inline wire::BeliefView view_of(const localisation::Belief& belief) {
  wire::BeliefView view;
  view.updates = belief.updates;
  view.lost = belief.lost;
  for (const localisation::PlaceProbability& place : belief.top) view.top.push_back({place.place, place.probability});
  if (!view.top.empty()) {
    view.place = view.top.front().place;
    view.probability = belief.near_probability;
  }
  return view;
}

}  // namespace homeward::server
