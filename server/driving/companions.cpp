// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "server/driving/driving.hpp"

namespace homeward::server {
namespace {

// The exploration of a robot that can be shared. Errors: kConflict.
Result<ExplorationId> shareable(const RobotUnit& unit) {
  const auto cannot = [&](const std::string& why) {
    return Result<ExplorationId>(
        fail(ErrorCode::kConflict, unit.name + " " + why, "robots/" + unit.id.str() + "/exploration"));
  };
  if (!unit.online()) return cannot("is not connected, so its exploration cannot be shared.");
  if (!unit.exploration) return cannot("has no exploration that could be shared.");
  if (unit.explores() && unit.mission->exploration != unit.exploration->id)
    return cannot("has not told of its exploration yet; try again in a moment.");
  const wire::ExplorationPhase phase = unit.exploration->phase;
  if (phase == wire::ExplorationPhase::kEnded || phase == wire::ExplorationPhase::kUploaded)
    return cannot("has ended its exploration; there is nothing to share any more.");
  return unit.exploration->id;
}

}  // namespace

Status Driving::set_companion(const RobotId& id, const std::string& lease_id, const std::optional<RobotId>& other) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  if (other == id)
    return fail(ErrorCode::kInvalidInput, "A robot cannot share its exploration with itself.", "body/robot");
  std::optional<ExplorationId> with;
  if (other) {
    const auto found_other = find(*other);
    if (!found_other) return pass_on(found_other);
    const std::scoped_lock lock((*found_other)->mutex);
    const auto shared = shareable(**found_other);
    if (!shared) return pass_on(shared);
    with = *shared;
  }
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (const Status status = unit.may_be_ordered(lease_id, clock_.steady()); !status) return status;
  const auto own = shareable(unit);
  if (!own) return pass_on(own);
  unit.link->send(wire::Companion{*own, with});
  spdlog::info("robot {} exploration {} is shared with {}, by {}", id.str(), own->str(),
               with ? other->str() + " exploration " + with->str() : "none", unit.lease->holder);
  return {};
}

std::shared_ptr<AgentLink> Driving::link_of_companion(const Unit& unit, const std::shared_ptr<AgentLink>& link,
                                                      const ExplorationId& said) {
  ExplorationId with;
  {
    const std::scoped_lock lock(unit->mutex);
    if (unit->link != link || !unit->exploration) return nullptr;
    const wire::ExplorationReport& report = *unit->exploration;
    if (report.id != said || !report.companion) return nullptr;
    with = report.companion->exploration;
  }
  // Which of two robots that tell of one exploration it is, nobody knows: neither is believed.
  std::shared_ptr<AgentLink> to;
  int of_that = 0;
  for (const Unit& other : units()) {
    if (other == unit) continue;
    const std::scoped_lock lock(other->mutex);
    if (!other->online() || !other->exploration) continue;
    const wire::ExplorationReport& report = *other->exploration;
    if (report.id == said) return nullptr;
    if (report.id != with) continue;
    ++of_that;
    if (report.companion && report.companion->exploration == said) to = other->link;
  }
  return of_that == 1 ? to : nullptr;
}

}  // namespace homeward::server
