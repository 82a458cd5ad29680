// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/driving_config.hpp"
#include "pipeline/eye.hpp"
#include "recording/recording_thread.hpp"
#include "scenario/mission_plan.hpp"
#include "scenario/mission_result.hpp"
#include "scenario/scenario_listener.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/taught_world.hpp"
#include "sim/motion.hpp"
#include "wire/link_messages.hpp"

namespace homeward::recording {
class Recorder;
}

namespace homeward::scenario {

/// Drives one order in simulated time with the agent's own driving step, until it stands; how it went, but for the
/// truth about where it came to (see judge). Of the plan, the faults count, all but "kidnapped". `recorder`, or null:
/// records it.
Result<MissionResult> drive_order(SimulatedRobot& robot, const pipeline::Eye& eye, const wire::MissionOrder& order,
                                  const MissionPlan& plan, const driving::DrivingConfig& config,
                                  const ScenarioListener& listener, recording::Recorder* recorder = nullptr);

class DriveLoop;

/// What a drive tells of itself, once it is over.
MissionResult result_of(DriveLoop& drive);

/// Fills in what only the world knows: errors to the target's true pose, way, clearance, collisions.
void judge(const sim::Vehicle& vehicle, const Pose2& target, MissionResult& result);

/// Drives one mission in simulated time, with localiser and planner in the server's place: after a drive has failed
/// they look again where the robot is and send it another way, as a server does. Recorded when `record` says where.
/// Furniture is moved by the plan's seed; the world of `taught` stays as it is. Errors: also those of starting_pose and
/// move_furniture.
Result<MissionResult> run_mission(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                  const ScenarioListener& listener,
                                  const std::optional<recording::RecordingOptions>& record);

}  // namespace homeward::scenario
