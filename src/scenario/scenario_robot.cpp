// SPDX-License-Identifier: Apache-2.0
#include "scenario/scenario_robot.hpp"

namespace homeward::scenario {

sim::RobotProfile profile_of(const wire::ScenarioFile& scenario) {
  sim::RobotProfile profile = scenario.robot == "chair" ? sim::chair_profile() : sim::disc_profile();
  if (scenario.ranges == "ultrasound") profile.ranges = sim::RangeSensor::kUltrasound;
  return profile;
}

}  // namespace homeward::scenario
