// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "db/store.hpp"
#include "server/driving/mission_journal.hpp"
#include "server/driving/plan_follower.hpp"
#include "server/driving/robot_unit.hpp"
#include "server/http/message.hpp"
#include "server/services/maps.hpp"
#include "server/time/clock.hpp"
#include "server/work/work_pool.hpp"
#include "server/ws/event_hub.hpp"

namespace homeward::server {

/// Robots: their links, where they are, who drives them, and their missions. Who may move a robot is decided here and
/// on the robot: a mission is a permit that is renewed every tick while link and lease live; whatever breaks, it stops.
class Driving : public LinkListener {
 public:
  /// `heavy` looks at pictures, `journal` (one worker) writes to the store what need not be waited for. `plans` is
  /// given each picture after that. `longest_mission_s`: 0 for planning::longest_mission_s of its way.
  Driving(db::Store& store, MapService& maps, PlanFollower& plans, EventHub& events, WorkPool& heavy, WorkPool& journal,
          const Clock& clock, int longest_mission_s)
      : store_(store),
        maps_(maps),
        plans_(plans),
        events_(events),
        heavy_(heavy),
        journal_(journal),
        clock_(clock),
        longest_mission_s_(longest_mission_s),
        mission_journal_(store, journal) {}

  /// `keep` is called on the journal with what each mission saw that arrived; set before the first robot connects.
  void when_arrived(std::function<void(const db::Drive&)> keep) { keep_drive_ = std::move(keep); }
  /// Reads the robots of the store. Errors: those of the store.
  Status load();
  /// Every wire::kPermitEvery_ms, on the socket thread: permits, leases that end, agents that fell silent.
  void tick(SteadyTime now);
  /// At the end: once more, what the store has not taken of missions. Before the journal finishes.
  void keep_what_is_left() { mission_journal_.try_again(SteadyTime::max()); }

  // Robots. Errors: kNotFound.
  Result<wire::RobotView> add(const std::string& name);
  /// With its missions and tokens; its link is closed. Errors: also kConflict (it is driving).
  Status remove(const RobotId& id);
  std::vector<wire::RobotView> list();
  Result<wire::RobotView> get(const RobotId& id);
  /// Errors: also kConflict (it is driving).
  Result<wire::RobotView> set_map(const RobotId& id, const std::optional<MapId>& map);
  /// Where a robot is, as a person says.
  struct SaidPlace {
    std::string label;  // of destinations and places, all of which are meant; or else, where it is empty,
    PlaceId place;
    std::string by;
  };
  /// Its belief begins anew there, with its next picture (localisation::Localiser::start_at). Errors: kNotFound,
  /// kRobotOffline, kConflict (it has no map, or is driving), kUnknownPlace.
  Result<wire::RobotView> set_place(const RobotId& id, const SaidPlace& said);
  /// The newest picture.
  Result<std::vector<std::uint8_t>> frame(const RobotId& id);
  [[nodiscard]] std::size_t online();

  // Leases. The view has the lease's id. Errors: kNotFound, kLeaseHeld.
  Result<wire::LeaseView> take_lease(const RobotId& id, const Caller& caller, bool take_over);
  Result<wire::LeaseView> keep_lease(const RobotId& id, const std::string& lease_id);
  Status release_lease(const RobotId& id, const std::string& lease_id);

  // Missions.
  struct MissionRequest {
    std::string lease_id;
    std::optional<DestinationId> destination;  // or else
    PlaceId place;
    std::string by;
  };
  /// Errors: kNotFound, kLeaseHeld, kRobotOffline, kLost, kConflict (no map), kUnknownPlace, kNoRoute.
  Result<wire::MissionView> start(const RobotId& id, const MissionRequest& request);
  Result<wire::MissionView> mission(const RobotId& id, const MissionId& mission);
  /// What a person says to the question that the robot asks on a mission.
  struct GivenAnswer {
    std::string lease_id;
    std::int64_t question = 0;  // its number
    bool here = false;          // whether the robot is at its destination
    std::string by;
  };
  /// Passes it on; the first answer counts. Errors: kNotFound, kLeaseHeld, kRobotOffline, kConflict (nothing is asked,
  /// another question, or somebody has answered).
  Result<wire::MissionView> answer(const RobotId& id, const MissionId& mission, const GivenAnswer& given);
  // Explorations: missions of a robot that maps a building by itself.
  struct ExplorationRequest {
    std::string lease_id;
    std::optional<ExplorationId> exploration;  // to go on with; nothing: a new one
    std::optional<double> limit_m;             // driven altogether
    std::optional<double> limit_s;             // explored altogether
    std::optional<double> back_after_s;        // from now on, until it is back where it began
    std::string by;
  };
  /// Errors: kNotFound, kLeaseHeld, kRobotOffline, kConflict (it does not explore, or has no exploration of that id
  /// that could go on).
  Result<wire::MissionView> start_exploration(const RobotId& id, const ExplorationRequest& request);
  /// How far it is, as the robot told last. Errors: kNotFound (also: it told of none since it connected).
  Result<std::shared_ptr<const wire::ExplorationReport>> exploration(const RobotId& id);
  /// What it keeps off from now on, in place of all fences before. Errors: kNotFound, kLeaseHeld, kRobotOffline.
  Status set_fences(const RobotId& id, const std::string& lease_id, const std::vector<wire::Fence>& fences_m);
  /// Its exploration is shared from now on with the one that `other` has now, or with none; what they say to each other
  /// is relayed once each names the other. Errors: kNotFound (also of `other`), kInvalidInput (itself), kLeaseHeld,
  /// kRobotOffline, kConflict (one of the two has no exploration that goes on).
  Status set_companion(const RobotId& id, const std::string& lease_id, const std::optional<RobotId>& other);
  /// Ends a paused one with what it has. Errors: kNotFound, kLeaseHeld, kRobotOffline, kConflict (it explores just
  /// now).
  Status finish_exploration(const RobotId& id, const std::string& lease_id);
  /// Anyone may stop, and say why in `words` or not (empty). Does not wait for the disk. Returns the stop's id.
  Result<std::string> stop(const RobotId& id, const std::string& by, const std::string& words);

  /// The near end of a new link.
  std::shared_ptr<SocketHandler> open_link(const RobotId& id);
  void received(const std::shared_ptr<AgentLink>& link, wire::AgentMessage message) override;
  void closed(const std::shared_ptr<AgentLink>& link) override;

 private:
  using Unit = std::shared_ptr<RobotUnit>;
  struct Plan {
    wire::MissionView mission;
    wire::MissionOrder order;
    std::optional<wire::RepeatOrder> repeat;  // in place of it, on a map that was taught as a path,
    std::int64_t first_arc = 0;               // from this arc of it on
    double length_m = 0.0;                    // of the way
    bool again = false;                       // a detour that is the way that failed, again
  };
  struct Look;  // one picture in a worker's hands

  Result<Unit> find(const RobotId& id);
  std::vector<Unit> units();
  // With the unit locked:
  wire::RobotView view(const RobotUnit& unit, SteadyTime now) const;
  wire::LeaseView lease_view(const RobotUnit& unit, SteadyTime now) const;
  bool lease_lives(const RobotUnit& unit, SteadyTime now) const;
  void tell(const RobotUnit& unit);
  void end_mission(RobotUnit& unit, wire::MissionState state, std::optional<wire::Reason> reason);
  // A mission of the robot's takes the place of the one that is under way; gives the number that its order goes by.
  wire::Order set_off(RobotUnit& unit, wire::MissionView& mission, SteadyTime ends);
  void stop_robot(RobotUnit& unit, const std::string& stop_id, const wire::Reason& reason, const std::string& by);
  void begin_looking(const Unit& unit);

  void received_hello(const Unit& unit, const std::shared_ptr<AgentLink>& link, wire::Hello hello);
  void received_status(const Unit& unit, wire::AgentStatus status);
  // Where to pass on what the robot of `link` says of its exploration `said` to the one that explores with it; null
  // where their latest reports do not name each other.
  std::shared_ptr<AgentLink> link_of_companion(const Unit& unit, const std::shared_ptr<AgentLink>& link,
                                               const ExplorationId& said);
  void received_explored(RobotUnit& unit, wire::ExplorationReport report);
  // With the unit locked: its mission failed, as it told just now; what may be tried after that, or the end.
  void received_failure(const Unit& unit, const wire::Reason& why, bool lifted);
  // After one more picture of a robot that was lifted, or is not known where after a drive that failed; with the unit
  // locked: sends it on from where it stands, once that has shown.
  void go_on_after_looking(const Unit& unit);
  // When a mission has lasted too long that sets off now.
  [[nodiscard]] SteadyTime end_of(double length_m, SteadyTime now) const;
  // Another way after the present one failed. begin_detour, with the unit locked: false where the mission has to end.
  bool begin_detour(const Unit& unit, const wire::Reason& reason);
  // `no_way` says why no way leads there.
  Result<Plan> plan_detour(const Unit& unit, const MissionId& mission, int number, std::optional<wire::Reason>& no_way);
  void send_detour(const Unit& unit, const MissionId& mission, const wire::Reason& reason, int number);
  void received_refusal(RobotUnit& unit, const wire::MissionRefused& refusal);
  void welcome(const Unit& unit, const std::shared_ptr<AgentLink>& link);
  // Looks at the newest picture: takes it up, sees where it was taken, and keeps and tells what has shown.
  void look(const Unit& unit);
  Look take_up(RobotUnit& unit);
  Result<wire::BeliefView> see(Look& look);
  void keep_seen(const Unit& unit, const Look& look, const Result<wire::BeliefView>& seen);
  void follow_on_plan(const RobotId& robot, Look& look, bool seen);
  Result<std::shared_ptr<Tracking>> tracking_for(std::shared_ptr<Tracking> present, const MapId& map,
                                                 const camera::CameraConfig& camera);
  Result<Plan> plan(const Unit& unit, const MissionRequest& request);
  // A way along a path that was taught, forwards, from a place to where a picture of its tour was taken.
  static void plan_repeat(const map::TopologicalMap& map, const PlaceId& start, const ImageId& end, Plan& plan);
  static void send_repeat(RobotUnit& unit, Plan& plan, const wire::Order& number);
  // Whose mission it is, and on which map.
  void note_plan(const RobotUnit& unit, const MissionRequest& request, const MapId& map, std::int64_t revision,
                 Plan& plan) const;
  // Tells the robot how probable its start is. Errors: kLost where it is unsure and could not find out.
  static Status set_start(const Start& start, wire::MissionOrder& order);
  void keep(const wire::MissionView& mission);
  // One that was added, and that something forbids by now.
  void keep_refused(wire::MissionView mission, const Error& error);
  // Of way_counts.cpp. Counts the way to the place that it leaves behind, where it has come from the one before:
  // whoever finds itself elsewhere on its path has not driven what lies between. With the unit locked, before it moves
  // on.
  void count_driven(RobotUnit& unit, std::int64_t index, wire::DriveState state);
  // Counts the way to a place of a mission's path.
  void count_way(const wire::MissionView& mission, std::int64_t index, bool driven);
  // Ways of an order that people drew and missions have driven are driven as others.
  void confirm_ways(const map::TopologicalMap& map, const std::vector<PlaceId>& path, wire::MissionOrder& order,
                    const MapId& id);
  void close_silent_links(SteadyTime now);
  void hand_over_sights(RobotUnit& unit);  // with the unit locked

  db::Store& store_;
  MapService& maps_;
  PlanFollower& plans_;
  EventHub& events_;
  WorkPool& heavy_;
  WorkPool& journal_;
  const Clock& clock_;
  const int longest_mission_s_;
  MissionJournal mission_journal_;
  std::function<void(const db::Drive&)> keep_drive_;
  std::mutex mutex_;  // of units_ and not_greeted_; never taken while a unit is locked
  std::map<RobotId, Unit> units_;
  std::vector<std::weak_ptr<AgentLink>> not_greeted_;
};

}  // namespace homeward::server
