// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "server/driving/driving.hpp"

namespace homeward::server {

Result<wire::MissionView> Driving::answer(const RobotId& id, const MissionId& mission_id, const GivenAnswer& given) {
  const auto asked = mission(id, mission_id);
  if (!asked) return pass_on(asked);
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (const Status lease = unit.holds_lease(given.lease_id, clock_.steady()); !lease) return pass_on(lease);
  const std::string where = "robots/" + id.str() + "/missions/" + mission_id.str();
  if (!unit.online()) return fail(ErrorCode::kRobotOffline, "The robot is not connected.", where);
  if (unit.answered == given.question && unit.mission && unit.mission->id == mission_id)
    return fail(ErrorCode::kConflict, "Somebody has answered this question already.", where);
  const auto question = unit.open_question();
  if (!question || unit.mission->id != mission_id)
    return fail(ErrorCode::kConflict, "The robot asks nothing on this mission now.", where);
  if (question->number != given.question)
    return fail(ErrorCode::kConflict, "The robot asks another question by now.", where);
  unit.answered = given.question;
  unit.link->send(wire::Answer{mission_id, given.question, given.here});
  spdlog::info("robot {} mission {} question {}: {} says {}", id.str(), mission_id.str(), given.question, given.by,
               given.here ? "yes" : "no");
  tell(unit);
  return *unit.mission;
}

}  // namespace homeward::server
