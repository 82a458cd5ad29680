// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "exploration/survey.hpp"
#include "pipeline/eye.hpp"
#include "recording/recorder.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::scenario {

struct ExplorationPlan {
  double limit_m = 2000.0;                             // driven; it ends there
  double limit_s = 7200.0;                             // simulated
  std::optional<double> back_after_s;                  // so long after it began, it is back where it began
  std::vector<std::vector<Eigen::Vector2d>> fences_m;  // corners of what is not driven, by the robot's first pose
  double speed_limit_mps = 0.5;
  exploration::ExplorerConfig explorer;
  exploration::SurveyConfig survey;
};

/// A picture of the tour that an exploration is.
struct ExploredPicture {
  std::vector<std::uint8_t> jpeg;
  RangeSweep sweep;
  double t_s = 0.0;
  Pose2 truth;  // for judging only
};

/// Why an exploration ended.
enum class ExplorationEnd : std::uint8_t { kComplete, kBack, kLimit, kStuck, kStopped };

struct ExplorationResult {
  std::vector<ExploredPicture> pictures;
  std::vector<Pose2> poses;  // of the pictures by what the robot knows in the end; the first one is the origin
  std::vector<exploration::KnownAgain> known_again;
  std::size_t unreached = 0;             // places that were wanted and that blocked ways led to
  std::vector<Eigen::Vector2d> trail_m;  // where it truly drove, for judging only
  ExplorationEnd ended = ExplorationEnd::kComplete;
  std::string reason;  // where it was stopped
  double driven_m = 0.0;
  double duration_s = 0.0;
  int collisions = 0;
  double min_clearance_m = 0.0;
  std::vector<double> step_ms;  // what the machine took for each picture: features, loops, where to go next
};

/// Hears of each picture, with what there is of the result by then: pictures and trail.
using ExplorationProgress = std::function<void(const exploration::Survey&, const ExplorationResult&)>;

/// Explores a world in simulated time by the agent's own driving step, under permits that never end, until nothing is
/// left or a limit is reached. `progress`: may be empty. `clock_ms`: the machine's time, for
/// step_ms alone. `recorder`: of the same body (`exploring_config`) and eye, with the table of states; may be null.
/// Errors: those of Eye::look.
Result<ExplorationResult> explore(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                                  const ExplorationPlan& plan, const ExplorationProgress& progress,
                                  const std::function<double()>& clock_ms, recording::Recorder* recorder = nullptr);

/// The plan for a robot of this body.
ExplorationPlan exploration_plan_for(const sim::RobotProfile& profile);

/// The same with a robot of its own, from a pose on. Its light must have been prepared. Errors: also those of
/// SimulatedRobot::create and Eye::create.
Result<ExplorationResult> explore_world(sim::LitWorld& world, const SimulatedRobotConfig& config, const Pose2& start,
                                        const ExplorationPlan& plan, const ExplorationProgress& progress = {},
                                        const std::function<double()>& clock_ms = {});

/// The picture that was taken nearest to a room's point, within 1.5 m, in the room where the world knows its outline;
/// nothing where there is none.
std::optional<std::size_t> picture_of_room(const sim::World& world, const std::string& room,
                                           const ExplorationResult& explored);

}  // namespace homeward::scenario
