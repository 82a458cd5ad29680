// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "cli/simulate.hpp"
#include "core/result.hpp"
#include "pipeline/eye.hpp"
#include "recording/recorder.hpp"
#include "scenario/exploration_run.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::cli {

// The methods of `homeward explore`, one file each.

/// What the method of the thesis is given on the command line.
struct ThesisOptions {
  double forward_m = 2.0;
  double hist_threshold = 600.0;
  std::string measure = "grey";
};

struct ExploreOptions {
  StageOptions stage;
  std::string method = "survey";
  ThesisOptions thesis;
  std::string start;
  int robots = 1;      // of the survey: 1 or 2,
  std::string start2;  // and the room where the second one begins; empty: beside the first
  std::string robot = "disc";
  double shut_doors = 0.0;                // share
  std::optional<double> camera_height_m;  // nothing: the camera's own
  double glass_share = 0.0;               // see sim::LaserConfig
  double spurious_share = 0.0;
  double limit_m = 2000.0;
  std::optional<double> limit_s;       // simulated, of the survey; nothing: two hours
  std::optional<double> back_after_s;  // of the survey; nothing: it need not be back
  std::vector<std::string> fences;     // of the survey: corners "x,y x,y x,y", metres of the world
  int pictures_every = 0;              // of the survey: so many pictures, the graph so far is drawn; 0: never
  bool json = false;
};

/// A robot at the start of an exploration, and its eye.
struct ExploringRobot {
  scenario::SimulatedRobot robot;
  pipeline::Eye eye;
  sim::RobotProfile profile;
};

void add_thesis_options(CLI::App& command, ThesisOptions& options);

/// `world` must outlive it. Errors: kInvalidInput (a name on the command line, no room to start).
Result<ExploringRobot> exploring_robot(const ExploreOptions& options, sim::LitWorld& world,
                                       const camera::CameraConfig& camera);

/// A second one, in the room `--start2` or in sight of the first. Errors: as above.
Result<ExploringRobot> second_robot(const ExploreOptions& options, sim::LitWorld& world,
                                    const camera::CameraConfig& camera, const ExploringRobot& first);

/// What records its exploration as NAME.hwrec in the folder `--out`, which it makes. Errors: kIo.
Result<std::unique_ptr<recording::Recorder>> recorder_of(const ExploreOptions& options, const ExploringRobot& explorer,
                                                         const std::string& name);

/// "complete", "limit" or "stopped".
const char* name_of(scenario::ExplorationEnd end);

/// `homeward explore --method survey`: writes a recording, a tour, the map of it and a picture of what that covers
/// into the folder `--out`.
Status explore_by_survey(const ExploreOptions& options, const sim::World& world, const camera::CameraConfig& camera,
                         ExploringRobot& explorer);

/// `homeward explore --robots 2`: the same of two robots at once; a recording and a tour of each, and one map.
Status explore_by_two(const ExploreOptions& options, const sim::World& world, const camera::CameraConfig& camera,
                      ExploringRobot& first, ExploringRobot& second);

/// `homeward explore --method thesis`: writes a recording, states.csv and dissimilarities.csv into the folder
/// `--out`.
Status explore_by_thesis(const ExploreOptions& options, ExploringRobot& explorer);

}  // namespace homeward::cli
