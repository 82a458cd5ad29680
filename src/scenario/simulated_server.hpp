// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/belief_tracker.hpp"
#include "planning/route.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/taught_world.hpp"
#include "wire/mission_order.hpp"

namespace homeward::scenario {

/// What a server does for a mission, without one: says where the robot is, plans its way, and after a drive has failed
/// looks again and gives an order for another way, as `planning::detour_after` decides.
class SimulatedServer {
 public:
  /// `destination` must be of the map of `taught`, which outlives this. `speed_limit_mps`: of its orders. Errors: those
  /// of BeliefTracker::create.
  static Result<SimulatedServer> create(const TaughtWorld& taught, const map::Destination& destination,
                                        double speed_limit_mps);

  /// Looks at where the robot stands: the likeliest place, however unlikely. Nothing: there is nothing to be seen.
  Result<std::optional<PlaceId>> find_place(SimulatedRobot& robot);
  /// The way to the destination, round what has failed; or a second look at it, from its own place. Errors: those of
  /// plan_detour and plan_second_look.
  Result<wire::MissionOrder> order_from(const PlaceId& place, bool second_look = false);
  /// Why order_from gave none.
  [[nodiscard]] wire::Reason why_no_order(const PlaceId& place, const Error& error) const;
  /// The next order after a drive that failed. Nothing: a person decides, and `why` may say what for.
  Result<std::optional<wire::MissionOrder>> order_after(DriveLoop& drive, std::optional<wire::Reason>& why);
  /// Where an order's pictures were truly taken, one for each of its views.
  [[nodiscard]] std::vector<Pose2> way_of(const wire::MissionOrder& order) const;
  /// The belief by one more picture of the drive, and by where the robot takes itself to be.
  wire::BeliefReport believe(const features::Appearance& seen, const Pose2& odometry,
                             const std::optional<wire::EstimateReport>& estimate);
  /// Orders that were given anew.
  [[nodiscard]] int detours() const { return detours_ + restarts_; }

 private:
  Result<std::optional<PlaceId>> find_again(DriveLoop& drive);
  void begin_by_belief();
  std::optional<PlaceId> believed_start(const driving::DrivingState& robot, bool sees, bool& unsure);
  Result<std::optional<PlaceId>> look_anew(DriveLoop& drive);
  SimulatedServer(const TaughtWorld& taught, const map::Destination& destination, double speed_limit_mps,
                  pipeline::BeliefTracker tracker)
      : taught_(&taught), destination_(&destination), speed_limit_mps_(speed_limit_mps), tracker_(std::move(tracker)) {}

  const TaughtWorld* taught_;
  const map::Destination* destination_;
  double speed_limit_mps_;
  pipeline::BeliefTracker tracker_;
  std::vector<PlaceId> path_;
  std::vector<planning::Way> closed_;
  std::vector<PlaceId> likely_;     // where else the robot may be, as it begins
  double start_probability_ = 1.0;  // that it is where its path begins
  int displaced_ = 0;               // how often the robot had noticed a lift when its belief was begun anew
  localisation::Belief belief_;     // the latest
  int detours_ = 0;
  int restarts_ = 0;          // after the robot was elsewhere than on its way, or unsure
  int unsure_restarts_ = 0;   // of them, those of a robot that was unsure
  bool fails_again_ = false;  // where it failed before
  std::int64_t orders_ = 0;
};

}  // namespace homeward::scenario
