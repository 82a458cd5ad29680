// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planning/route.hpp"

namespace homeward::planning {

/// A robot that was lifted is sent on no sooner than this after it was moved without its wheels last: until then it may
/// be in somebody's hands.
constexpr double kStandsAfterLift_s = 3.0;

/// How long a mission may take that begins with a way of `length_m`, waits, questions and looking around included:
/// several times what one took that arrived.
double longest_mission_s(double length_m);

/// A drive over the places of a path that failed on its way to `path[index]`, and where the robot is believed to be.
struct FailedDrive {
  std::vector<PlaceId> path;
  std::int64_t index = 0;
  PlaceId here;
  PlaceId destination;
  int detours = 0;      // that the mission has made already,
  int restarts = 0;     // and how often the robot was sent anew because it was elsewhere than on its way
  bool astray = false;  // it failed because the robot was elsewhere or unsure, not because of what stands in the way
  bool unsure = false;  // `here` is the likeliest place only, or the destination, of which the robot is not certain
  int unsure_restarts = 0;  // how often it was sent anew although it was unsure
};

/// What not to drive again after a failed drive: the edge that was being driven, and where the robot is known to be
/// further already, the edge after that; both directions of them. Nothing where no edge can be blamed.
std::vector<Way> failed_ways(const FailedDrive& failed);

/// Whether another way is worth looking for, and what to close for it beside what is closed already: no edge where the
/// robot was sent from another place than it stood at, went astray, or is unsure: then it finds out by driving on, at
/// the destination by a second look at it (plan_second_look). Nothing: a person decides, because the destination's own
/// place is reached, no edge can be blamed, or the mission has had its detours or restarts.
/// Ours: Goedemé 2007 §6 plans once.
std::optional<std::vector<Way>> detour_after(const FailedDrive& failed);

/// Whether it failed where the mission failed before: all of `failed`, one at least, were in `closed` already.
bool fails_again(std::span<const Way> closed, std::span<const Way> failed);

/// The way after a failed drive.
struct Detour {
  Route route;
  bool again = false;  // there is no other: what is closed is tried once more
};

/// The way round what `request` closes. Where there is none and `may_try_again`, the way that there is: somebody who
/// stood in the door has gone on, and a way that was lost is recognised from where the robot stands now. To be allowed
/// unless it `fails_again`: what stands in one spot is no passer-by. Errors: those of plan_route with everything
/// closed.
Result<Detour> plan_detour(const map::TopologicalMap& map, const RouteRequest& request, bool may_try_again);

}  // namespace homeward::planning
