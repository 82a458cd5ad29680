// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wire/reason.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// One end of a drive before its destination.
struct StopEvent {
  double t_s = 0.0;
  wire::Reason reason;
  std::optional<double> stand_after_s;  // from the beginning of the fault that was on to wheels at zero
};

/// How a path that was taught was followed. Lateral: from where the tour truly drove.
struct RepeatResult {
  wire::RepeatSteering steering = wire::RepeatSteering::kWay;
  double lateral_rmse_m = 0.0;
  double lateral_most_m = 0.0;
  int pictures = 0;  // held against the path
  int lost = 0;      // of them
};

/// How one mission of a scenario went. Errors are measured to the true pose of the destination's picture.
struct MissionResult {
  std::string from;
  std::string to;
  bool arrived = false;
  double final_error_m = 0.0;
  double final_error_rad = 0.0;
  double path_m = 0.0;
  double shortest_m = 0.0;
  std::optional<double> tour_graph_m;  // shortest way over the edges that the tour drove; nothing: there is none
  double min_clearance_m = 0.0;
  int collisions = 0;
  std::vector<StopEvent> stops;
  double vectors_per_s = 0.0;
  double duration_s = 0.0;
  int detours = 0;                            // orders that were given anew after a drive had failed
  int moved_after_stop = 0;                   // control cycles with motion between a stop and the next order
  int moved_furniture = 0;                    // pieces that stood elsewhere than in the tour
  std::optional<double> arrival_probability;  // stated, of being within half a metre; where it says that it arrived
  double belief_apart_s = 0.0;         // longest that a sure belief of the map and a sure estimate were over 2 m apart
  int asked = 0;                       // how often it asked whether it was at its destination
  std::optional<RepeatResult> repeat;  // nothing: it was no path
  /// When it was lifted and put down elsewhere.
  std::optional<double> kidnapped_at_s;
  /// From then until it gave up or said that something is wrong. Nothing: never.
  std::optional<double> noticed_after_s;
};

}  // namespace homeward::scenario
