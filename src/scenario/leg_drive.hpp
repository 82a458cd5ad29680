// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "driving/step.hpp"
#include "recording/recorder.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::scenario {

/// How a leg ended.
enum class LegEnd : std::uint8_t {
  kReached,
  kBlocked,  // it did not get on for as long as `driving::LegConfig` waits; the robot stands where it is
  kLimit,    // the way of the whole drive is used up
  kStopped,  // the driving step refuses to go on
};

/// Drives a simulated robot leg by leg, in simulated time and by the agent's own driving step under permits that never
/// end: its avoidance has priority, and goes round what stands in the way.
class LegDrive {
 public:
  /// `robot` and `recorder`, which may be null, must outlive it. `limit_m`: of everything driven.
  LegDrive(SimulatedRobot& robot, const driving::Body& body, const std::string& feature_config_id,
           double speed_limit_mps, double limit_m, recording::Recorder* recorder);

  /// Drives to a point given in the robot's present frame, turning to it first.
  LegEnd drive(const Eigen::Vector2d& goal_in_robot_m, double within_m);
  /// A row of the table of states, for the recording: it is kept with the next step.
  void note(wire::StateRow row) { rows_.push_back(std::move(row)); }
  /// The exploration is over by itself: the last step.
  void end(const driving::ExplorationOver& over);
  /// Why the driving step refused to go on; empty where it did not.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] double seconds() const { return 0.001 * static_cast<double>(now_ms_); }

 private:
  /// One cycle, but for the time that passes.
  void step(const std::optional<driving::Leg>& leg, const std::optional<driving::ExplorationOver>& over);
  /// One cycle. Without a leg the robot comes to rest.
  void cycle(const std::optional<driving::Leg>& leg);
  [[nodiscard]] bool stopped() const { return begun_ && state_.drive != wire::DriveState::kDriving; }

  SimulatedRobot& robot_;
  recording::Recorder* recorder_;
  driving::DrivingConfig config_;
  driving::DrivingState state_;
  double speed_limit_mps_;
  double limit_m_;
  driving::Milliseconds now_ms_ = 0;
  std::int64_t permit_ = 1;
  bool begun_ = false;
  std::string reason_;
  std::vector<wire::StateRow> rows_;  // that no step has taken with it yet
};

}  // namespace homeward::scenario
