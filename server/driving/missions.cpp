// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <cmath>

#include "db/secrets.hpp"
#include "map/lookup.hpp"
#include "planning/retry_policy.hpp"
#include "planning/route.hpp"
#include "planning/surroundings.hpp"
#include "server/driving/driving.hpp"
#include "wire/lease_durations.hpp"
#include "wire/mission_order.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::server {
namespace {

using wire::ReasonCode;

constexpr std::chrono::milliseconds kHeardWithin{wire::kHeardWithin_ms};
constexpr std::chrono::milliseconds kSilentTooLong{wire::kLinkSilence_ms};
constexpr std::chrono::seconds kTakeUpWithin{10};
constexpr std::chrono::seconds kExplorationTakeUpWithin{180};  // it may have to read first what it saw before
constexpr std::chrono::seconds kLooksWithin{15};               // where a robot stands that was lifted, or lost

std::string where_of(const RobotUnit& unit) { return "robots/" + unit.id.str(); }

// What forbids a mission now, with the unit locked.
Status may_start(const RobotUnit& unit, const std::string& lease_id, SteadyTime now) {
  if (const Status lease = unit.holds_lease(lease_id, now); !lease) return lease;
  if (!unit.online()) return fail(ErrorCode::kRobotOffline, "The robot is not connected.", where_of(unit));
  if (!unit.map) return fail(ErrorCode::kConflict, "The robot has no map to drive on.", where_of(unit));
  if (!unit.belief || !unit.belief->place) {
    return fail(ErrorCode::kLost, "The robot does not know where it is.", where_of(unit));
  }
  if (!unit.believes_now(now)) {
    return fail(ErrorCode::kLost, "The robot has not sent a picture for a while.", where_of(unit));
  }
  return {};
}

}  // namespace

Status Driving::set_start(const Start& start, wire::MissionOrder& order) {
  const bool can_find_out = order.surroundings && (order.path.size() > 1 || !order.surroundings->nearby.empty());
  if (start.unsure && !can_find_out) {
    return fail(ErrorCode::kLost,
                "The robot does not know where it is, and the map says too little of where its places lie to find out.",
                "places/" + start.place.str());
  }
  if (order.surroundings) order.surroundings->start_probability = std::clamp(start.probability, 0.0, 1.0);
  return {};
}

Result<Driving::Plan> Driving::plan(const Unit& unit, const MissionRequest& request) {
  MapId map_id;
  Start start;
  std::vector<PlaceId> likely;
  bool can_repeat = false;
  {
    const std::scoped_lock lock(unit->mutex);
    const Status status = may_start(*unit, request.lease_id, clock_.steady());
    if (!status) return pass_on(status);
    map_id = *unit->map;
    start = unit->likeliest();
    likely = unit->likely_places();
    can_repeat = unit->hello.repeats;
  }
  const auto loaded = maps_.load(map_id);
  if (!loaded) return pass_on(loaded);
  const map::TopologicalMap& map = (*loaded)->map;
  Plan plan;
  plan.mission.place = request.place;
  const map::Destination* destination = nullptr;
  if (request.destination) {
    destination = map::find_destination(map, *request.destination);
    if (destination == nullptr) {
      return fail(ErrorCode::kUnknownPlace, "The map has no destination " + request.destination->str() + ".",
                  "maps/" + map_id.str());
    }
    plan.mission.destination = destination->id;
    plan.mission.place = destination->place;
  }
  if (map.path && can_repeat) {
    const map::Place* place = map::find_place(map, plan.mission.place);
    if (place == nullptr) {
      return fail(ErrorCode::kUnknownPlace, "The map has no place " + plan.mission.place.str() + ".",
                  "maps/" + map_id.str());
    }
    plan_repeat(map, start.place, destination != nullptr ? destination->image : place->prototype, plan);
    note_plan(*unit, request, map_id, map.revision, plan);
    return plan;
  }
  planning::RouteRequest asked;
  asked.from = start.place;
  asked.to = plan.mission.place;
  const auto route = planning::plan_route(map, asked);
  if (!route) return pass_on(route);
  plan.order = destination != nullptr ? wire::order_for_route(map, route->places, *destination)
                                      : wire::order_for_route(map, route->places);
  confirm_ways(map, route->places, plan.order, map_id);
  const auto layout = maps_.layout(*loaded);
  wire::add_surroundings(map, *layout, planning::surroundings(map, route->places, likely, *layout), plan.order);
  if (const Status begins = set_start(start, plan.order); !begins) return pass_on(begins);
  if (start.unsure) plan.mission.reason = wire::Reason{ReasonCode::kLooksAroundFirst};
  plan.mission.path = route->places;
  plan.length_m = route->length_m;
  note_plan(*unit, request, map_id, map.revision, plan);
  plan.order.mission = plan.mission.id;
  plan.order.map = map_id;
  plan.order.valid_for_ms = wire::kPermitValid_ms;
  return plan;
}

void Driving::note_plan(const RobotUnit& unit, const MissionRequest& request, const MapId& map, std::int64_t revision,
                        Plan& plan) const {
  plan.mission.id = MissionId(db::random_id());
  plan.mission.robot = unit.id;
  plan.mission.map = map;
  plan.mission.revision = revision;
  plan.mission.created_us = clock_.wall_us();
  plan.mission.by = request.by;
}

SteadyTime Driving::end_of(double length_m, SteadyTime now) const {
  const double longest_s = longest_mission_s_ > 0 ? longest_mission_s_ : planning::longest_mission_s(length_m);
  return now + std::chrono::milliseconds(std::llround(1000.0 * longest_s));
}

Result<wire::MissionView> Driving::start(const RobotId& id, const MissionRequest& request) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  auto planned = plan(*found, request);
  if (!planned) return pass_on(planned);
  // On disk before the robot hears of it, so that no restart can forget a mission that was driven.
  const auto added = store_.add_mission(planned->mission);
  if (!added) return pass_on(added);
  wire::MissionView mission = *added;

  const std::scoped_lock lock(unit.mutex);
  const auto now = clock_.steady();
  Status status = may_start(unit, request.lease_id, now);
  if (status && unit.map != mission.map) {
    status = fail(ErrorCode::kConflict, "The robot was given another map just now.", where_of(unit));
  }
  if (!status) {
    keep_refused(std::move(mission), status.error());
    return pass_on(status);
  }
  const wire::Order order = set_off(unit, mission, end_of(planned->length_m, now));
  if (planned->repeat) {
    send_repeat(unit, *planned, order);
  } else {
    planned->order.order = order;
    planned->order.speed_limit_mps = std::min(wire::kSpeedLimit_mps, unit.hello.max_speed_mps);
    unit.link->send(planned->order);
  }
  spdlog::info("robot {} mission {} to {} over {} places, by {}", id.str(), mission.id.str(), mission.place.str(),
               mission.path.size(), mission.by);
  keep(mission);
  tell(unit);
  return mission;
}

wire::Order Driving::set_off(RobotUnit& unit, wire::MissionView& mission, SteadyTime ends) {
  if (unit.under_way) end_mission(unit, wire::MissionState::kStopped, wire::Reason{ReasonCode::kAnotherMission});
  mission.epoch = unit.epoch;
  mission.seq = ++unit.seq;
  unit.set_off(mission, clock_.steady(), ends);
  return {unit.epoch, unit.seq};
}

void Driving::keep_refused(wire::MissionView mission, const Error& error) {
  mission.state = wire::MissionState::kRefused;
  mission.ended_us = clock_.wall_us();
  mission.reason = wire::reason_of(error);
  keep(mission);
}

Result<wire::MissionView> Driving::mission(const RobotId& id, const MissionId& mission) {
  const auto unit = find(id);
  if (!unit) return pass_on(unit);
  {
    const std::scoped_lock lock((*unit)->mutex);
    if ((*unit)->mission && (*unit)->mission->id == mission) return *(*unit)->mission;
  }
  auto stored = store_.mission(mission);
  if (stored && stored->robot != id) {
    return fail(ErrorCode::kNotFound, "The robot had no mission " + mission.str() + ".", "robots/" + id.str());
  }
  return stored;
}

void Driving::end_mission(RobotUnit& unit, wire::MissionState state, std::optional<wire::Reason> reason) {
  unit.under_way = false;
  unit.looking_for_detour = false;
  unit.looks_since.reset();
  if (!unit.mission) return;
  unit.mission->state = state;
  unit.mission->ended_us = clock_.wall_us();
  spdlog::info("robot {} mission {} {}{}{}", unit.id.str(), unit.mission->id.str(), wire::mission_state_name(state),
               reason ? ": " : "", reason ? wire::english(*reason) : "");
  if (reason) unit.mission->reason = std::move(reason);
  keep(*unit.mission);
  if (state == wire::MissionState::kArrived && !unit.sent_to_explore()) hand_over_sights(unit);
  unit.sights.clear();
}

void Driving::stop_robot(RobotUnit& unit, const std::string& stop_id, const wire::Reason& reason,
                         const std::string& by) {
  if (unit.link) {
    unit.link->send(wire::StopOrder{stop_id.empty() ? db::random_id() : stop_id, unit.epoch, reason, by, ++unit.seq},
                    true);
  }
  if (unit.under_way) end_mission(unit, wire::MissionState::kStopped, reason);
}

Result<std::string> Driving::stop(const RobotId& id, const std::string& by, const std::string& words) {
  const auto found = find(id);
  if (!found) return pass_on(found);
  RobotUnit& unit = **found;
  const std::scoped_lock lock(unit.mutex);
  const std::string stop_id = db::random_id();
  stop_robot(unit, stop_id, words.empty() ? wire::Reason{ReasonCode::kStoppedBy, {{"by", by}}} : wire::in_words(words),
             by);
  tell(unit);
  return stop_id;
}

void Driving::tick(SteadyTime now) {
  mission_journal_.try_again(now);
  close_silent_links(now);
  plans_.tick(now);
  for (const Unit& found : units()) {
    RobotUnit& unit = *found;
    const std::scoped_lock lock(unit.mutex);
    if (unit.lease && now >= unit.lease->expires) {
      if (unit.under_way) stop_robot(unit, "", {ReasonCode::kNobodyWatching}, unit.lease->holder);
      unit.lease.reset();
      tell(unit);
    }
    if (!unit.link) continue;
    const auto silent = now - unit.link->last_heard();
    if (silent > kSilentTooLong) {
      unit.link->close(kClosePolicy, "nothing was heard for too long");
      continue;
    }
    unit.link->send_what_is_due();
    if (!unit.under_way || !unit.online() || unit.looking_for_detour) continue;
    if (now > unit.mission_ends) {
      stop_robot(unit, "", {ReasonCode::kTooLong}, "server");
      tell(unit);
      continue;
    }
    if (unit.looks_since) {
      if (now - *unit.looks_since <= kLooksWithin) continue;
      end_mission(unit, wire::MissionState::kFailed, unit.failed_because);
      tell(unit);
      continue;
    }
    const auto take_up_within = unit.explores() ? kExplorationTakeUpWithin : kTakeUpWithin;
    if (unit.mission->state == wire::MissionState::kAccepted && now - unit.mission_at > take_up_within) {
      stop_robot(unit, "", {ReasonCode::kNotTakenUp}, "server");
      tell(unit);
      continue;
    }
    if (silent <= kHeardWithin) {
      ++unit.seq;
      unit.link->send(wire::Permit{unit.mission->id, {unit.epoch, unit.seq}, wire::kPermitValid_ms});
    }
  }
}

}  // namespace homeward::server
