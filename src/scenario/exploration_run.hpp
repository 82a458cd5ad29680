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
#include "scenario/exploration_result.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::scenario {

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
