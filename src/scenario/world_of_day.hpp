// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "core/result.hpp"
#include "driving/driving_config.hpp"
#include "recording/recorder.hpp"
#include "scenario/mission_plan.hpp"
#include "scenario/scenario_listener.hpp"
#include "scenario/taught_world.hpp"
#include "scenario/world_folder.hpp"
#include "sim/motion.hpp"

namespace homeward::scenario {

/// The world as it is on the day of a mission; the map knows it as it was.
struct WorldOfDay {
  sim::LitWorld* world = nullptr;          // that of the tour, or the changed one
  std::unique_ptr<sim::LitWorld> changed;  // where furniture was moved
  int moved_furniture = 0;
};

/// In that light, furniture moved by the plan's seed. Errors: those of move_furniture.
Result<WorldOfDay> world_of_day(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                const sim::Light& light);

/// Records a mission in that world; null where `record` says nothing. Errors: those of Recorder.
Result<std::unique_ptr<recording::Recorder>> recorder_for(const TaughtWorld& taught,
                                                          const std::optional<recording::RecordingOptions>& record,
                                                          const driving::DrivingConfig& config,
                                                          const ScenarioListener& listener);

}  // namespace homeward::scenario
