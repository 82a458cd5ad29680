// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include "map/lookup.hpp"
#include "planning/no_route.hpp"
#include "planning/retry_policy.hpp"
#include "planning/route.hpp"
#include "planning/second_look.hpp"
#include "planning/surroundings.hpp"
#include "server/driving/driving.hpp"
#include "wire/lease_durations.hpp"
#include "wire/map_reasons.hpp"
#include "wire/mission_order.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::server {
namespace {

using wire::ReasonCode;

// What must hold for a robot that failed to be sent on, with the unit locked.
bool may_go_on(const RobotUnit& unit, SteadyTime now) {
  return unit.under_way && unit.online() && unit.lease && now < unit.lease->expires && unit.known_start(now);
}

Result<planning::Detour> second_look_at(const map::TopologicalMap& map, const planning::RouteRequest& request,
                                        double away_m) {
  auto route = planning::plan_second_look(map, request, away_m);
  if (!route) return pass_on(route);
  return planning::Detour{std::move(*route), false};
}

}  // namespace

bool Driving::begin_detour(const Unit& found, const wire::Reason& reason) {
  RobotUnit& unit = *found;
  const auto now = clock_.steady();
  if (!may_go_on(unit, now)) return false;
  const bool astray = unit.status && unit.status->astray;
  const Start start = *unit.known_start(now);
  const bool homed_to_it = unit.mission->path_index + 1 == static_cast<std::int64_t>(unit.mission->path.size());
  const bool second_look = astray && !unit.lifted && start.place == unit.mission->place && homed_to_it;
  const bool unsure = start.guessed || second_look;
  const auto ways =
      planning::detour_after({unit.mission->path, unit.mission->path_index, start.place, unit.mission->place,
                              unit.detours, unit.restarts, astray, unsure, unit.unsure_restarts});
  if (!ways) return false;
  unit.fails_again = planning::fails_again(unit.closed, *ways);
  unit.closed.insert(unit.closed.end(), ways->begin(), ways->end());
  ++(astray || unsure ? unit.restarts : unit.detours);
  unit.second_look_m.reset();
  if (second_look) unit.second_look_m = planning::second_look_m(unit.unsure_restarts);
  if (unsure) ++unit.unsure_restarts;
  unit.looking_for_detour = true;
  unit.detour_start = start;
  // Reading the map and planning are no work for the thread of the sockets.
  if (!heavy_.try_run([this, found, mission = unit.mission->id, reason, number = ++unit.detour_number] {
        send_detour(found, mission, reason, number);
      })) {
    unit.looking_for_detour = false;
    return false;
  }
  unit.mission->reason = wire::reason_with(
      astray || unsure ? ReasonCode::kWayFromThereLookedFor : ReasonCode::kAnotherWayLookedFor, "because", reason);
  spdlog::info("robot {} mission {} failed at place {} of its way: {}", unit.id.str(), unit.mission->id.str(),
               unit.mission->path_index, wire::english(reason));
  keep(*unit.mission);
  return true;
}

Result<Driving::Plan> Driving::plan_detour(const Unit& unit, const MissionId& mission, int number,
                                           std::optional<wire::Reason>& no_way) {
  Plan plan;
  planning::RouteRequest asked;
  Start start;
  std::vector<PlaceId> likely;
  bool fails_again = false;
  std::optional<double> second_look_m;
  {
    const std::scoped_lock lock(unit->mutex);
    if (!unit->looking_for_detour || unit->detour_number != number || !unit->mission || unit->mission->id != mission) {
      return fail(ErrorCode::kConflict, "The mission has ended in the meantime.", "missions/" + mission.str());
    }
    plan.mission = *unit->mission;
    start = unit->detour_start;  // what is to be closed, and how far to look, was decided from there
    likely = unit->likely_places();
    asked.from = start.place;
    asked.closed = unit->closed;
    fails_again = unit->fails_again;
    second_look_m = unit->second_look_m;
  }
  const auto loaded = maps_.load(plan.mission.map);
  if (!loaded) return pass_on(loaded);
  const map::TopologicalMap& map = (*loaded)->map;
  asked.to = plan.mission.place;
  // Ways of a map that was edited in the meantime need not be in it any more.
  std::erase_if(asked.closed, [&](const planning::Way& way) {
    return map::find_place(map, way.from) == nullptr || map::find_place(map, way.to) == nullptr;
  });
  const auto detour =
      second_look_m ? second_look_at(map, asked, *second_look_m) : planning::plan_detour(map, asked, !fails_again);
  if (!detour) {
    // A second look needs more than a way: there may be one all the same.
    const auto way = planning::plan_route(map, asked);
    if (detour.error().code == ErrorCode::kNoRoute && !way && way.error().code == ErrorCode::kNoRoute)
      no_way = wire::reason_of(planning::explain_no_route(map, asked), map);
    return pass_on(detour);
  }
  const std::vector<PlaceId>& places = detour->route.places;
  const map::Destination* destination =
      plan.mission.destination ? map::find_destination(map, *plan.mission.destination) : nullptr;
  plan.order =
      destination != nullptr ? wire::order_for_route(map, places, *destination) : wire::order_for_route(map, places);
  confirm_ways(map, places, plan.order, plan.mission.map);
  const auto layout = maps_.layout(*loaded);
  wire::add_surroundings(map, *layout, planning::surroundings(map, places, likely, *layout), plan.order);
  for (const planning::Way& way : asked.closed) wire::leave_out_way(way.from, way.to, plan.order);
  if (const Status begins = set_start(start, plan.order); !begins) return pass_on(begins);
  plan.mission.revision = map.revision;
  plan.mission.path = places;
  plan.again = detour->again;
  plan.length_m = detour->route.length_m;
  plan.mission.path_index = 0;
  plan.mission.arrival_probability.reset();
  plan.order.mission = mission;
  plan.order.map = plan.mission.map;
  plan.order.valid_for_ms = wire::kPermitValid_ms;
  return plan;
}

void Driving::send_detour(const Unit& found, const MissionId& mission, const wire::Reason& reason, int number) {
  std::optional<wire::Reason> no_way;
  auto planned = plan_detour(found, mission, number, no_way);
  RobotUnit& unit = *found;
  const std::scoped_lock lock(unit.mutex);
  if (!unit.looking_for_detour || unit.detour_number != number || !unit.mission || unit.mission->id != mission)
    return;  // a person was faster, or it was lifted
  unit.looking_for_detour = false;
  const auto now = clock_.steady();
  if (!planned || !may_go_on(unit, now) || unit.map != planned->mission.map) {
    if (unit.under_way) {
      wire::Reason why = reason;
      if (!planned) {
        wire::Reason trouble = no_way ? std::move(*no_way) : wire::reason_of(planned.error());
        why = {ReasonCode::kNoWayOn, {{"because", std::vector{reason}}, {"trouble", std::vector{std::move(trouble)}}}};
      }
      end_mission(unit, wire::MissionState::kFailed, std::move(why));
    }
    return tell(unit);
  }
  planned->mission.state = wire::MissionState::kAccepted;
  const bool astray = unit.status && unit.status->astray;
  const ReasonCode goes_on = unit.second_look_m ? ReasonCode::kLooksAroundAndComesBack
                             : astray           ? ReasonCode::kGoesOnFromThere
                             : planned->again   ? ReasonCode::kTriesOnceMore
                                                : ReasonCode::kTakesAnotherWay;
  planned->mission.reason = wire::reason_with(goes_on, "because", reason);
  planned->mission.epoch = unit.epoch;
  planned->mission.seq = ++unit.seq;
  planned->order.order = {unit.epoch, unit.seq};
  planned->order.speed_limit_mps = std::min(wire::kSpeedLimit_mps, unit.hello.max_speed_mps);
  unit.mission = planned->mission;
  unit.counted_to = 0;
  unit.stepped_to = 0;
  unit.mission_at = now;
  // Another way may be far longer; there are three at most.
  if (!astray && !unit.second_look_m && longest_mission_s_ == 0)
    unit.mission_ends = std::max(unit.mission_ends, end_of(planned->length_m, now));
  unit.link->send(planned->order);
  spdlog::info("robot {} mission {} goes another way over {} places", unit.id.str(), mission.str(),
               planned->mission.path.size());
  keep(*unit.mission);
  tell(unit);
}

}  // namespace homeward::server
