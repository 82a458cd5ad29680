// SPDX-License-Identifier: Apache-2.0
#include "wire/robot_json.hpp"

#include "wire/json_write.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {

using nlohmann::json;

json lease_to_json(const LeaseView& lease) {
  json value = {{"holder", lease.holder}, {"epoch", lease.epoch}, {"expires_in_ms", lease.expires_in_ms}};
  if (lease.id) value["id"] = *lease.id;
  return value;
}

json robot_to_json(const RobotView& robot) {
  json value = {{"id", robot.id.str()},
                {"name", robot.name},
                {"online", robot.online},
                {"map", or_null(robot.map)},
                {"state", nullptr},
                {"reason", reason_to_json(robot.reason)},
                {"speed_mps", or_null(robot.speed_mps)},
                {"home", nullptr},
                {"min_range_m", or_null(robot.min_range_m)},
                {"belief", nullptr},
                {"mission", nullptr},
                {"question", nullptr},
                {"lease", nullptr},
                {"status_age_ms", or_null(robot.status_age_ms)}};
  if (robot.state) value["state"] = drive_state_name(*robot.state);
  if (robot.home) {
    value["home"] = {{"bearing_rad", finite_or_null(robot.home->bearing_rad)},
                     {"confidence", finite_or_null(robot.home->confidence)},
                     {"inliers", robot.home->inliers}};
  }
  if (robot.belief) value["belief"] = belief_to_json(*robot.belief);
  if (robot.mission) value["mission"] = mission_to_json(*robot.mission);
  if (robot.question) value["question"] = question_to_json(*robot.question);
  if (robot.lease) {
    LeaseView shown = *robot.lease;
    shown.id.reset();  // whoever knows it can drive
    value["lease"] = lease_to_json(shown);
  }
  return value;
}

}  // namespace homeward::wire
