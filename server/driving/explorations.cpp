// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "db/secrets.hpp"
#include "server/driving/driving.hpp"
#include "wire/lease_durations.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::server {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

// Explorations have no way whose length says how long they last. The robot keeps its limits of time itself, and may
// need so long beyond them to come home.
constexpr std::chrono::minutes kBeyondLimit{10};
// Without a limit: longer than a large floor takes. One that was stopped for this is only paused.
constexpr std::chrono::hours kLongestExploration{4};

std::string where_of(const RobotUnit& unit) { return "robots/" + unit.id.str() + "/exploration"; }

SteadyTime latest_end(const Driving::ExplorationRequest& request, SteadyTime now) {
  if (!request.limit_s && !request.back_after_s) return now + kLongestExploration;
  const double limit_s = std::max(request.limit_s.value_or(0.0), request.back_after_s.value_or(0.0));
  return now + std::chrono::milliseconds(std::llround(1000.0 * limit_s)) + kBeyondLimit;
}

Status has_told(const RobotUnit& unit) {
  if (unit.exploration) return {};
  return fail(ErrorCode::kNotFound, "The robot has told of no exploration.", where_of(unit));
}

// What changes an exploration: who drives a robot that is there and has told of one.
Status may_change(const RobotUnit& unit, const std::string& lease_id, SteadyTime now) {
  if (const Status status = unit.may_be_ordered(lease_id, now); !status) return status;
  return has_told(unit);
}

// What forbids an exploration now, with the unit locked.
Status may_explore(const RobotUnit& unit, const Driving::ExplorationRequest& request, SteadyTime now) {
  if (const Status status = unit.may_be_ordered(request.lease_id, now); !status) return status;
  if (!unit.hello.explores)
    return fail(ErrorCode::kConflict, wire::english(wire::Reason{ReasonCode::kDoesNotExplore}), where_of(unit));
  if (!request.exploration) return {};
  if (!unit.exploration || unit.exploration->id != *request.exploration)
    return fail(ErrorCode::kConflict, wire::english(wire::Reason{ReasonCode::kExplorationUnknown}), where_of(unit));
  const ExplorationPhase phase = unit.exploration->phase;
  if (phase == ExplorationPhase::kEnded || phase == ExplorationPhase::kUploaded)
    return fail(ErrorCode::kConflict, "This exploration has ended; begin another one.", where_of(unit));
  return {};
}

}  // namespace

Result<wire::MissionView> Driving::start_exploration(const RobotId& id, const ExplorationRequest& request) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  {
    const std::scoped_lock lock(unit.mutex);
    if (const Status status = may_explore(unit, request, clock_.steady()); !status) return pass_on(status);
  }
  wire::MissionView planned;
  planned.id = MissionId(db::random_id());
  planned.robot = id;
  planned.kind = wire::MissionKind::kExplore;
  planned.exploration = request.exploration ? *request.exploration : ExplorationId(db::random_id());
  planned.created_us = clock_.wall_us();
  planned.by = request.by;
  // On disk before the robot hears of it, as of every mission.
  const auto added = store_.add_mission(planned);
  if (!added) return pass_on(added);
  wire::MissionView mission = *added;

  const std::scoped_lock lock(unit.mutex);
  const auto now = clock_.steady();
  if (const Status status = may_explore(unit, request, now); !status) {
    keep_refused(std::move(mission), status.error());
    return pass_on(status);
  }
  wire::ExploreOrder order;
  order.mission = mission.id;
  order.order = set_off(unit, mission, latest_end(request, now));
  order.valid_for_ms = wire::kPermitValid_ms;
  order.speed_limit_mps = std::min(wire::kSpeedLimit_mps, unit.hello.max_speed_mps);
  order.exploration = *mission.exploration;
  order.goes_on = request.exploration.has_value();
  order.limit_m = request.limit_m;
  order.limit_s = request.limit_s;
  order.back_after_s = request.back_after_s;
  // Its pictures are not looked at meanwhile, so that what they have shown says nothing of where it will be.
  unit.forget_where();
  unit.belief.reset();
  unit.waiting_frame.reset();
  unit.link->send(order);
  spdlog::info("robot {} mission {} {} exploration {}, by {}", id.str(), mission.id.str(),
               order.goes_on ? "goes on with" : "begins", order.exploration.str(), mission.by);
  keep(mission);
  tell(unit);
  return mission;
}

Result<std::shared_ptr<const wire::ExplorationReport>> Driving::exploration(const RobotId& id) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  const std::scoped_lock lock((*found)->mutex);
  if (const Status told = has_told(**found); !told) return pass_on(told);
  return (*found)->exploration;
}

Status Driving::set_fences(const RobotId& id, const std::string& lease_id, const std::vector<wire::Fence>& fences_m) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (const Status status = may_change(unit, lease_id, clock_.steady()); !status) return status;
  if (unit.explores() && unit.mission->exploration != unit.exploration->id) {
    return fail(ErrorCode::kConflict, "The robot has not told of its exploration yet; try again in a moment.",
                where_of(unit));
  }
  unit.link->send(wire::Fences{unit.exploration->id, fences_m});
  spdlog::info("robot {} exploration {} has {} fences, by {}", id.str(), unit.exploration->id.str(), fences_m.size(),
               unit.lease->holder);
  return {};
}

Status Driving::finish_exploration(const RobotId& id, const std::string& lease_id) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  if (const Status status = may_change(unit, lease_id, clock_.steady()); !status) return status;
  if (unit.explores()) return fail(ErrorCode::kConflict, "The robot explores just now; stop it first.", where_of(unit));
  unit.link->send(wire::Finish{unit.exploration->id});
  spdlog::info("robot {} exploration {} is ended by {}", id.str(), unit.exploration->id.str(), unit.lease->holder);
  return {};
}

}  // namespace homeward::server
