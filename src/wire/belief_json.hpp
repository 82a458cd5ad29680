// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"

namespace homeward::wire {

/// How sure a robot is to be at a place.
struct PlaceShare {
  PlaceId place;
  double probability = 0.0;
};

/// Where a robot believes to be (proto/schemas/belief.schema.json).
struct BeliefView {
  int updates = 0;                    // pictures since the last uniform start
  std::optional<PlaceId> place;       // the most probable one
  std::optional<double> probability;  // of being there or at a neighbour of it; calibrated
  std::vector<PlaceShare> top;        // most probable first
  bool lost = true;
  std::optional<double> ms;    // how long the last picture took
  std::optional<TimeUs> t_us;  // when it was taken
};

nlohmann::json belief_to_json(const BeliefView& belief);

}  // namespace homeward::wire
