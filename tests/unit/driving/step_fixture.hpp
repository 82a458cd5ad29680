// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "driving/step.hpp"
#include "support/landmarks.hpp"
#include "support/reason_printing.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::driving {

/// A robot in open space whose ideal wheels do what they are ordered; the test decides what it is given.
class StepTest : public ::testing::Test {
 protected:
  static constexpr Milliseconds kTick_ms = 50;
  static constexpr float kOpen_m = 20.0F;  // a range beyond the scanner's reach: nothing is there

  StepTest() : landmarks_(homeward::testing::landmarks_around(views(), 90, 3)) {
    config_.feature_config_id = "hw1-test";
    belief_.lost = false;  // it names no place
  }

  static std::vector<Pose2> views() { return {{0.8, 0.0, 0.0}, {1.6, 0.0, 0.0}, {2.4, 0.0, 0.0}}; }

  [[nodiscard]] wire::MissionOrder mission(const std::string& id, std::int64_t epoch, std::int64_t seq) const {
    wire::MissionOrder order;
    order.mission = MissionId(id);
    order.order = {epoch, seq};
    order.feature_config_id = config_.feature_config_id;
    order.valid_for_ms = 1500;
    order.speed_limit_mps = 0.5;
    order.label = "kitchen";
    const auto poses = views();
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
      wire::PathPlace place;
      place.place = PlaceId("p" + std::to_string(i));
      place.image = ImageId("tour/" + std::to_string(i) + ".jpg");
      place.appearance = wire::encode_appearance(seen_from(landmarks_, poses[i], 50 + i));
      place.next = wire::PathEdge{0.0, 0.0, 0.8, false};
      order.path.push_back(place);
    }
    order.path.back().next.reset();
    order.final_image = ImageId("tour/9.jpg");
    order.final_appearance = wire::encode_appearance(seen_from(landmarks_, poses.back(), 59));
    return order;
  }

  static wire::Permit permit(const std::string& id, std::int64_t epoch, std::int64_t seq) {
    return {MissionId(id), {epoch, seq}, 1500};
  }

  /// One tick later. A fresh sweep, and a picture every other time as a camera takes them, unless switched off; the
  /// messages given, and a word of the server.
  Outputs tick(std::vector<wire::ServerMessage> messages = {}) {
    now_ms_ += kTick_ms;
    ++ticks_;
    Inputs inputs;
    inputs.link_up = link_up_;
    inputs.robot_link_up = robot_link_up_;
    inputs.odometry = pose_;
    inputs.leg = leg_;
    inputs.exploration_over = over_;
    inputs.why_not_exploring = why_not_exploring_;
    inputs.path_sight = std::exchange(path_sight_, std::nullopt);
    inputs.why_not_repeating = why_not_repeating_;
    inputs.messages = std::move(messages);
    if (server_talks_) inputs.messages.emplace_back(belief_);
    if (pictures_ && ticks_ % ticks_per_picture_ == 0) {
      const auto count = static_cast<std::uint64_t>(now_ms_);
      const bool covered = covered_ || (covered_now_and_then_ && (now_ms_ / kTick_ms) % 8 == 0);
      auto seen = covered ? features::Appearance() : seen_from(landmarks_, pose_, count, hidden_ ? 1.0 : 0.0);
      inputs.picture = SeenPicture{
          now_ms_ - picture_age_ms_, std::make_shared<const features::Appearance>(std::move(seen)), {}, pose_};
    }
    if (sweeps_) {
      Scan scan;
      scan.ranges_m = ranges_m_;
      scan.angle_step_rad = field_rad_ / static_cast<double>(ranges_m_.size());
      if (field_rad_ < 2.0 * kPi) scan.angle_min_rad = -0.5 * field_rad_;
      inputs.scan = SeenScan{now_ms_ - sweep_age_ms_, scan};
    }
    if (hand_)
      inputs.rider =
          JoystickReading{now_ms_ - hand_age_ms_, hand_->speed_mps != 0.0 || hand_->turn_radps != 0.0, *hand_};
    const Outputs outputs = step(state_, inputs, config_, now_ms_);
    const double seconds = static_cast<double>(kTick_ms) / 1000.0;
    pose_ = pose_ * Pose2{outputs.motion.speed_mps * seconds, 0.0, outputs.motion.turn_radps * seconds};
    return outputs;
  }

  /// Sends a mission and drives for a moment; fails the test when nothing moves.
  void set_off(std::int64_t epoch = 1, std::int64_t seq = 1) {
    seq_ = seq;
    tick({mission("m1", epoch, seq)});
    double speed_mps = 0.0;
    for (int k = 0; k < 4; ++k) speed_mps = tick({permit("m1", epoch, ++seq_)}).motion.speed_mps;
    ASSERT_GT(speed_mps, 0.05) << state_.reason;
    ASSERT_EQ(state_.drive, wire::DriveState::kDriving);
  }

  static bool stands(const Outputs& outputs) {
    return outputs.motion.speed_mps == 0.0 && outputs.motion.turn_radps == 0.0;
  }

  /// Ticks until it no longer drives, with permits when asked; milliseconds gone, or -1 when it never stopped.
  Milliseconds until_stopped(bool permits, Milliseconds at_most_ms = 5000) {
    const Milliseconds from_ms = now_ms_;
    while (now_ms_ - from_ms < at_most_ms) {
      std::vector<wire::ServerMessage> messages;
      if (permits) messages.emplace_back(permit("m1", state_.newest.epoch, ++seq_));
      const Outputs outputs = tick(std::move(messages));
      if (state_.drive == wire::DriveState::kDriving) continue;
      EXPECT_TRUE(stands(outputs));
      return now_ms_ - from_ms;
    }
    return -1;
  }

  /// Drives on to `near_m` of the destination, where something stands in the way; gives when that was. Goes on until
  /// the mission ends, or long enough to be taken for arrived.
  Milliseconds drive_beside_destination(double near_m) {
    const Pose2 there = views().back();
    const auto left_m = [&] { return std::hypot(there.x_m - pose_.x_m, there.y_m - pose_.y_m); };
    for (int k = 0; k < 400 && left_m() > near_m; ++k) tick({permit("m1", 1, ++seq_)});
    EXPECT_EQ(state_.drive, wire::DriveState::kDriving) << state_.reason;
    EXPECT_LE(left_m(), near_m);
    ranges_m_.assign(ranges_m_.size(), 0.4F);
    const Milliseconds from_ms = state_.near_since_ms.value_or(now_ms_);
    while (state_.drive == wire::DriveState::kDriving && now_ms_ - from_ms < config_.near_ms + 4000) {
      tick({permit("m1", 1, ++seq_)});
    }
    return from_ms;
  }

  /// Drives almost there, rolls on 0.2 m past it and goes on for a while; its least speed, negative: backwards.
  double slowest_past_destination() {
    const double there_m = views().back().x_m;
    for (int k = 0; k < 400 && there_m - pose_.x_m > 0.2; ++k) tick({permit("m1", 1, ++seq_)});
    EXPECT_EQ(state_.drive, wire::DriveState::kDriving) << state_.reason;
    pose_.x_m = there_m + 0.2;
    double slowest_mps = 0.0;
    for (int k = 0; k < 60; ++k) slowest_mps = std::min(slowest_mps, tick({permit("m1", 1, ++seq_)}).motion.speed_mps);
    return slowest_mps;
  }

  /// From the next tick on the sweep shows a wall across the way, at x in the frame of the views.
  void see_wall_across(double wall_x_m) {
    const double step_rad = 2.0 * kPi / static_cast<double>(ranges_m_.size());
    for (std::size_t i = 0; i < ranges_m_.size(); ++i) {
      const double towards = std::cos(pose_.theta_rad + step_rad * static_cast<double>(i));
      const double range_m = towards > 0.0 ? (wall_x_m - pose_.x_m) / towards : kOpen_m;
      ranges_m_[i] = std::min(static_cast<float>(range_m), kOpen_m);
    }
  }

  /// Everything is fine again, and permits come: it must not move.
  void expect_stays() {
    link_up_ = robot_link_up_ = server_talks_ = pictures_ = sweeps_ = true;
    covered_ = false;
    const Pose2 before = pose_;
    for (int k = 0; k < 40; ++k) {
      EXPECT_TRUE(stands(tick({permit("m1", state_.newest.epoch, ++seq_)})));
      EXPECT_NE(state_.drive, wire::DriveState::kDriving);
    }
    EXPECT_DOUBLE_EQ(pose_.x_m, before.x_m);
  }

  DrivingConfig config_;
  DrivingState state_;
  homeward::testing::Landmarks landmarks_;
  Milliseconds now_ms_ = 1'000'000;
  int ticks_ = 0;
  int ticks_per_picture_ = 2;  // of a camera with ten pictures a second
  std::int64_t seq_ = 1;
  Pose2 pose_;
  std::optional<Leg> leg_;  // of an exploration
  std::optional<ExplorationOver> over_;
  std::optional<wire::Reason> why_not_exploring_;
  std::optional<PathSight> path_sight_;  // of the next tick
  std::optional<wire::Reason> why_not_repeating_;
  std::optional<Motion> hand_;  // the rider's, on a joystick; zero: it is at rest
  Milliseconds hand_age_ms_ = 0;
  Milliseconds picture_age_ms_ = 0;  // when it is given
  Milliseconds sweep_age_ms_ = 0;
  bool link_up_ = true;
  bool robot_link_up_ = true;
  bool server_talks_ = true;
  wire::BeliefReport belief_;  // that it tells each time
  bool pictures_ = true;
  bool sweeps_ = true;
  bool covered_ = false;
  bool covered_now_and_then_ = false;
  bool hidden_ = false;           // somebody stands before all that it would recognise
  double field_rad_ = 2.0 * kPi;  // of the range sensor, about straight ahead
  std::vector<float> ranges_m_ = std::vector<float>(90, kOpen_m);
};

}  // namespace homeward::driving
