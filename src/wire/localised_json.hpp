// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "wire/belief_json.hpp"

namespace homeward::wire {

/// What a drawn plan says of where a picture was taken, and of the place that is believed.
struct PlanWitnessView {
  Pose2 pose;
  double spread_m = 0.0;
  std::string lost;              // why; empty: it is not
  std::string place = "silent";  // that is believed: "possible", "impossible"
  bool trusted = false;          // whether what it says counts
};

/// One line of what `homeward localise` prints (proto/schemas/localised.schema.json).
struct LocalisedView {
  std::string image;
  int updates = 0;
  std::vector<PlaceShare> top;  // most probable first
  double near_share = 0.0;      // of the belief, in the first place and its neighbours
  double probability = 0.0;     // of being there, calibrated
  bool lost = true;
  double ms = 0.0;
  std::optional<PlanWitnessView> plan;  // nothing: there is none
};

nlohmann::json localised_to_json(const LocalisedView& view);

}  // namespace homeward::wire
