// SPDX-License-Identifier: Apache-2.0
#include "scenario/leg_drive.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "scenario/drive_loop.hpp"
#include "scenario/order_to_explore.hpp"
#include "wire/lease_durations.hpp"
#include "wire/reason.hpp"

namespace homeward::scenario {

LegDrive::LegDrive(SimulatedRobot& robot, const driving::Body& body, const std::string& feature_config_id,
                   double speed_limit_mps, double limit_m, recording::Recorder* recorder)
    : robot_(robot),
      recorder_(recorder),
      config_(exploring_config(body, feature_config_id)),
      speed_limit_mps_(speed_limit_mps),
      limit_m_(limit_m) {}

void LegDrive::step(const std::optional<driving::Leg>& leg, const std::optional<driving::ExplorationOver>& over) {
  driving::Inputs inputs;
  inputs.odometry = robot_.odometry();
  inputs.link_up = true;
  inputs.scan = {now_ms_, robot_.sweep()};
  // What the camera shows on the way is of no use: it is not rendered.
  inputs.picture = driving::SeenPicture{now_ms_, nullptr, {}, inputs.odometry};
  inputs.leg = leg;
  inputs.exploration_over = over;
  if (!std::exchange(begun_, true)) inputs.messages.emplace_back(order_to_explore(speed_limit_mps_));
  inputs.messages.emplace_back(wire::Permit{MissionId("exploration"), {1, ++permit_}, wire::kPermitValid_ms});
  const driving::Outputs outputs = recorder_ != nullptr
                                       ? recorder_->step(state_, inputs, nullptr, now_ms_, std::exchange(rows_, {}))
                                       : driving::step(state_, inputs, config_, now_ms_);
  robot_.command(outputs.motion);
}

void LegDrive::cycle(const std::optional<driving::Leg>& leg) {
  step(leg, std::nullopt);
  constexpr int kParts = 5;
  for (int part = 0; part < kParts; ++part) robot_.advance(kScenarioCycle_s / kParts);
  now_ms_ += static_cast<driving::Milliseconds>(1000.0 * kScenarioCycle_s);
  if (stopped() && state_.reason) reason_ = wire::english(*state_.reason);
}

void LegDrive::end(const driving::ExplorationOver& over) {
  if (!stopped()) step(std::nullopt, over);
}

LegEnd LegDrive::drive(const Eigen::Vector2d& goal_in_robot_m, double within_m) {
  const Pose2 begin = robot_.odometry();
  const driving::Leg leg{position_m(begin * Pose2{goal_in_robot_m.x(), goal_in_robot_m.y(), 0.0}), within_m};
  LegEnd end = LegEnd::kReached;
  while ((position_m(robot_.odometry()) - leg.goal_m).norm() > leg.within_m) {
    cycle(leg);
    if (stopped()) end = LegEnd::kStopped;
    if (robot_.vehicle().path_m() >= limit_m_) end = LegEnd::kLimit;
    if (state_.leg.blocked && end == LegEnd::kReached) end = LegEnd::kBlocked;
    if (end != LegEnd::kReached) break;
  }
  // Without a leg the driving step forgets this one, and the robot comes to rest.
  constexpr int kRest = 5;
  for (int i = 0; i < kRest && !stopped(); ++i) cycle(std::nullopt);
  return end;
}

}  // namespace homeward::scenario
