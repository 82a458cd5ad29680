// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "recording/recording_thread.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

struct StopEvent {
  double t_s = 0.0;
  std::string reason;
  std::optional<double> stand_after_s;  // from the beginning of the fault that was on to wheels at zero
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
  double belief_apart_s = 0.0;  // longest that a sure belief of the map and a sure estimate were over 2 m apart
  int asked = 0;                // how often it asked whether it was at its destination
  /// When it was lifted and put down elsewhere.
  std::optional<double> kidnapped_at_s;
  /// From then until it gave up or said that something is wrong. Nothing: never.
  std::optional<double> told_after_s;
};

/// One control cycle of a mission, for whoever wants to see why it went as it did.
struct CycleTrace {
  double t_s = 0.0;
  Pose2 pose;  // true
  int index = 0;
  int views = 0;
  std::string view;  // the picture homed to
  bool answered = false;
  bool measured = false;              // the view homed to, in metres
  double position_probability = 0.0;  // of where the robot believes to be
  double arrival_probability = 0.0;
  double elsewhere = 0.0;
  std::optional<double> continuity;        // share of features seen again from the picture before
  std::optional<double> off_belief_m;      // between a sure belief and a sure estimate
  std::optional<double> contradiction;     // of the latest sweep and the one before
  std::optional<double> estimate_error_m;  // true
  double bearing_rad = 0.0;
  double confidence = 0.0;
  int inliers = 0;
  double parallax_rad = 0.0;
  double goal_x_m = 0.0;  // robot frame
  double goal_y_m = 0.0;
  double speed_mps = 0.0;  // commanded
  double turn_radps = 0.0;
  double min_range_m = 0.0;
  double clearance_m = 0.0;               // least so far, true
  std::vector<Eigen::Vector2d> people_m;  // true
  std::string state;
};

/// What a scenario's runner is told; functions that are not set are not called.
struct ScenarioListener {
  std::function<void(const std::string&)> told;
  std::function<void(const MissionResult&)> done;
  std::function<void(const CycleTrace&)> cycled;
};

/// Teaches a world by a tour, builds its map and drives the missions with the agent's own heart, in simulated time and
/// as fast as the machine allows. Same scenario, same results. Nothing is rendered of a scenario that check_scenario
/// finds wrong: kInvalidInput then names all its problems. Errors: also those of load_world, read_camera and build_map;
/// kInvalidInput where furniture was moved and the robot no longer fits at a room's point. `record`: keeps a recording
/// of each mission, named by number, start and destination. Errors: also those of Recorder. `only`: numbers of the
/// missions to drive, from 1; each goes as it goes among all. Empty: all. Errors: kInvalidInput for a number that the
/// scenario has no mission of.
Status run_scenario(wire::ScenarioFile scenario, const std::string& folder, const ScenarioListener& listener,
                    const std::optional<recording::RecordingOptions>& record = std::nullopt,
                    const std::set<int>& only = {});

}  // namespace homeward::scenario
