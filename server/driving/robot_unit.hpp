// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/belief_tracker.hpp"
#include "planning/route.hpp"
#include "server/driving/agent_link.hpp"
#include "server/driving/drive_sights.hpp"
#include "server/time/clock.hpp"
#include "wire/robot_json.hpp"

namespace homeward::server {

constexpr std::chrono::seconds kBeliefFresh{5};  // an older belief is none

/// Where a way begins, and how probable it is that the robot is there.
struct Start {
  PlaceId place;
  double probability = 1.0;
  bool unsure = false;   // the robot has to find out by itself before it goes anywhere
  bool guessed = false;  // neither the robot nor the belief is sure of it
};

/// The right to drive.
struct Lease {
  std::string id;
  std::string holder;  // name, shown to others
  std::string caller;  // id of the user
  SteadyTime expires;
};

/// The localisation of one robot in one map, used by one worker at a time.
struct Tracking {
  MapId map_id;
  pipeline::BeliefTracker tracker;
  bool by_word_alone = false;  // somebody said where the robot is, and no picture has borne it out yet
};

/// What the server knows of one robot. `mutex` guards everything but `id`.
struct RobotUnit {
  explicit RobotUnit(RobotId robot) : id(std::move(robot)) {}

  const RobotId id;
  std::mutex mutex;
  std::string name;
  std::optional<MapId> map;

  std::shared_ptr<AgentLink> link;    // null: not connected
  std::optional<SteadyTime> gone_at;  // when the last connection ended
  bool welcomed = false;              // the new epoch is known and told
  wire::Hello hello;
  std::optional<wire::AgentStatus> status;
  std::optional<SteadyTime> status_at;
  std::shared_ptr<const wire::Frame> frame;                    // the newest one, for people
  std::shared_ptr<const wire::ExplorationReport> exploration;  // how far it is, as the robot told since it connected

  bool looking = false;                              // a worker has a frame of this robot in hand
  std::shared_ptr<const wire::Frame> waiting_frame;  // the newest one that was not looked at
  std::shared_ptr<Tracking> tracking;                // the worker's while `looking`
  bool restart_tracking = false;
  std::vector<PlaceId> said_places;  // where it is, as a person has said since the last look; the belief begins there
  std::int64_t displaced = 0;        // as the robot told last
  bool restart_odometry = false;     // the robot's odometry began anew
  std::optional<wire::BeliefView> belief;
  /// Of that belief: in the first of its places and the neighbours of it, also where it is lost; at most an even chance
  /// while nothing but a person's word says so.
  double near_share = 0.0;
  SteadyTime belief_at;

  std::optional<Lease> lease;
  std::int64_t epoch = 0;
  std::int64_t seq = 0;  // of the last mission or permit of this epoch
  std::optional<wire::MissionView> mission;
  bool under_way = false;  // `mission` is accepted or driving: permits go out
  /// It follows a path that was taught, from this arc of it on; nothing: it homes from view to view.
  std::optional<std::int64_t> first_arc;
  std::int64_t counted_to = 0;  // place of its latest way up to which drives on ways were counted
  std::int64_t stepped_to = 0;  // place of it that it heads for since it left the one before behind; 0: it leapt there
  SteadyTime mission_at;        // when its latest way was sent
  SteadyTime mission_ends;      // when it has lasted too long
  // Another way after a part of the present one failed; of this mission alone.
  std::vector<planning::Way> closed;
  int detours = 0;
  int restarts = 0;                     // orders given anew after the robot was elsewhere than on its way
  int unsure_restarts = 0;              // of them, those of a robot that did not know where it was
  bool fails_again = false;             // where it failed before
  std::optional<double> second_look_m;  // so far the way to be looked for leads from the destination, and back
  bool looking_for_detour = false;      // no permit goes out until the new way is sent
  int detour_number = 0;                // counts those that were looked for
  Start detour_start;                   // where that begins
  // Lifted in mid-mission, the last time then, or a drive failed and nothing says where: where it stands is looked for,
  // and no permit goes out.
  std::optional<SteadyTime> looks_since;
  wire::Reason failed_because;           // what the drive said that ended so
  int looks = 0;                         // pictures since
  bool lifted = false;                   // and it has not driven since
  DriveSights sights;                    // of this mission
  std::optional<std::int64_t> answered;  // number of the question of this mission that somebody has answered last

  /// What was seen up to now, and what somebody said of where it is, says nothing of where it is from now on.
  void forget_where() {
    restart_tracking = true;
    said_places.clear();
  }
  /// A mission begins that ends at `ends` at the latest; nothing of the one before counts for it.
  void set_off(wire::MissionView begun, SteadyTime now, SteadyTime ends) {
    mission = std::move(begun);
    under_way = true;
    first_arc.reset();
    closed.clear();
    detours = 0;
    restarts = 0;
    unsure_restarts = 0;
    fails_again = false;
    looking_for_detour = false;
    looks_since.reset();
    lifted = false;
    sights.clear();
    answered.reset();
    counted_to = 0;
    stepped_to = 0;
    mission_at = now;
    mission_ends = ends;
  }
  /// Its mission, under way or over, is one that maps the building.
  [[nodiscard]] bool sent_to_explore() const { return mission && mission->kind == wire::MissionKind::kExplore; }
  [[nodiscard]] bool explores() const { return under_way && sent_to_explore(); }
  [[nodiscard]] bool online() const { return link != nullptr && welcomed; }
  /// What nobody may do but who drives a robot that is there. Errors: kLeaseHeld, kRobotOffline.
  [[nodiscard]] Status may_be_ordered(const std::string& lease_id, SteadyTime now) const {
    if (const Status lease_status = holds_lease(lease_id, now); !lease_status) return lease_status;
    if (!online()) return fail(ErrorCode::kRobotOffline, "The robot is not connected.", "robots/" + id.str());
    return {};
  }
  /// Whether this lease is the one that lives. Errors: kLeaseHeld.
  [[nodiscard]] Status holds_lease(const std::string& lease_id, SteadyTime now) const {
    const bool lives = lease && now < lease->expires;
    if (lives && lease->id == lease_id) return {};
    return fail(ErrorCode::kLeaseHeld,
                lives ? lease->holder + " is driving." : "Take the lease first; this one is over.",
                "robots/" + id.str() + "/lease");
  }
  /// What it told last is of its mission, and that is a drive.
  [[nodiscard]] bool tells_of_drive() const {
    return status && mission && !sent_to_explore() && status->mission == mission->id;
  }
  /// What the robot asks on its mission. Nothing: it asks nothing, or somebody has answered.
  [[nodiscard]] std::optional<wire::QuestionReport> open_question() const {
    if (!under_way || !tells_of_drive() || status->state != wire::DriveState::kDriving) return std::nullopt;
    return status->question && status->question->number != answered ? status->question : std::nullopt;
  }
  /// The belief is of now, lost or not.
  [[nodiscard]] bool believes_now(SteadyTime now) const {
    return belief && belief->place && now - belief_at <= kBeliefFresh;
  }
  /// The likeliest place and how probable it is to be there. Precondition: believes_now.
  [[nodiscard]] Start likeliest() const {
    return {*belief->place, belief->lost ? near_share : belief->probability.value_or(near_share), belief->lost};
  }
  /// Where it may be as well, most probable first.
  [[nodiscard]] std::vector<PlaceId> likely_places() const {
    std::vector<PlaceId> places;
    if (belief) {
      for (const wire::PlaceShare& share : belief->top) places.push_back(share.place);
    }
    if (tells_of_drive()) {
      if (status->estimate) places.push_back(status->estimate->place);
      for (const wire::EstimateReport& possible : status->possible_places) places.push_back(possible.place);
    }
    return places;
  }
  /// Where a robot takes itself to be that is under way.
  [[nodiscard]] std::optional<wire::EstimateReport> driving_estimate(SteadyTime now) const {
    const bool drives = under_way && tells_of_drive() && status_at && now - *status_at <= kBeliefFresh &&
                        status->state == wire::DriveState::kDriving;
    return drives ? status->estimate : std::nullopt;
  }
  /// Where a robot may be sent on from by itself after a drive that failed: its own estimate as it stopped, which it
  /// keeps; where it says nothing, the belief, which is of the whole map and of all pictures. Of two that are at odds
  /// the belief begins, and is worth no more than an even chance. Where neither is sure, the robot's likeliest place;
  /// of one that was lifted, the belief's.
  [[nodiscard]] std::optional<Start> known_start(SteadyTime now) const {
    constexpr double kEven = 0.5;  // a robot at odds with the belief says no more of its estimate
    const bool fresh = tells_of_drive() && status_at && now - *status_at <= kBeliefFresh;
    const bool tells = fresh && status->estimate;
    const bool at_odds = tells && status->estimate->probability <= kEven;
    const bool believes = believes_now(now) && !belief->lost;
    if (tells && !(at_odds && believes)) return Start{status->estimate->place, status->estimate->probability, at_odds};
    if (!believes && fresh && !status->possible_places.empty()) {
      const wire::EstimateReport& possible = status->possible_places.front();
      return Start{possible.place, possible.probability, true, true};
    }
    if (!believes && lifted && believes_now(now)) return Start{likeliest().place, near_share, true, true};
    if (!believes) return std::nullopt;
    const Start start = likeliest();
    return at_odds ? Start{start.place, std::min(kEven, start.probability), true} : start;
  }
};

}  // namespace homeward::server
