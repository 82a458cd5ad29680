// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "driving/follow.hpp"
#include "recording/recorder.hpp"
#include "support/painted_tour.hpp"
#include "support/reason_printing.hpp"
#include "support/scratch_folder.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::recording {

/// A robot that drives through a painted corridor with real pictures, and is recorded.
class RecordedDrive : public ::testing::Test {
 protected:
  RecordedDrive() : camera_(camera::Camera::create(homeward::testing::sphere_camera(320)).value()) {
    robot_.agent = "test";
    robot_.camera = camera_->config();
    robot_.features.panorama_width_px = 512;
    robot_.features.max_sift = 200;
    robot_.features.max_columns = 50;
    robot_.driving.feature_config_id = features::feature_config_id(robot_.features);
    eye_.emplace(pipeline::Eye::create(robot_.camera, robot_.features).value());
    options_.folder = folder_.path() / "recordings";
    options_.wait_for_disk = true;
  }

  void open_recorder() {
    auto created = Recorder::create(options_, robot_, [this](const std::string& what) {
      const std::lock_guard lock(mutex_);
      log_ += what + "\n";
    });
    ASSERT_TRUE(created) << created.error().message;
    recorder_ = std::move(*created);
  }
  /// Everything is on disk after this.
  void close_recorder() { recorder_.reset(); }

  [[nodiscard]] CameraPicture picture(const Pose2& pose) const {
    driving::TakenPicture taken{
        now_ms_, homeward::testing::painted_picture(homeward::testing::painted_corridor(), pose, *camera_), pose};
    return as_sent(std::move(taken));
  }

  [[nodiscard]] wire::MissionOrder mission(const std::string& id, std::int64_t seq) const {
    wire::MissionOrder order;
    order.mission = MissionId(id);
    order.order = {1, seq};
    order.map = MapId("map");
    order.feature_config_id = robot_.driving.feature_config_id;
    order.valid_for_ms = 1500;
    order.speed_limit_mps = 0.4;
    order.label = "end of the corridor";
    wire::PathPlace place;
    place.place = PlaceId("p1");
    place.image = ImageId("tour/1.jpg");
    place.appearance = wire::encode_appearance(*look(picture({0.6, 0.0, 0.0}), *eye_).value().appearance);
    order.path.push_back(place);
    order.final_image = ImageId("tour/2.jpg");
    order.final_appearance = wire::encode_appearance(*look(picture({1.4, 0.0, 0.0}), *eye_).value().appearance);
    return order;
  }

  /// A tenth of a second of the loop.
  driving::Outputs tick(std::vector<wire::ServerMessage> messages = {}) {
    now_ms_ += 100;
    driving::Inputs inputs;
    inputs.link_up = true;
    inputs.odometry = pose_;
    inputs.messages = std::move(messages);
    inputs.messages.emplace_back(wire::Permit{MissionId("m1"), {1, ++seq_}, 1500});
    PictureBytes bytes;
    if (pictures_ && !looks_) inputs.picture = driving::SeenPicture{now_ms_, nullptr, {}, pose_};
    if (pictures_ && looks_) {
      CameraPicture sent = picture(pose_);
      sent.recognised = driving::wants_features(state_.follow);
      inputs.picture = look(sent, *eye_).value();
      bytes = sent.bytes;
    }
    if (robot_link_up_)
      inputs.scan = driving::SeenScan{now_ms_, {std::vector<float>(60, 3.0F), 0.0, kPi / 30.0, 3.0, {}}};
    inputs.robot_link_up = robot_link_up_;
    inputs.rider = hand_;
    if (hand_) inputs.rider->said_ms = now_ms_;
    inputs.leg = leg_;
    inputs.exploration_over = over_;
    inputs.why_not_exploring = why_not_exploring_;
    inputs.path_sight = path_sight_;
    if (inputs.path_sight) inputs.path_sight->taken_ms = now_ms_;
    inputs.why_not_repeating = why_not_repeating_;
    const driving::Outputs outputs = recorder_->step(state_, inputs, bytes, now_ms_, std::exchange(rows_, {}));
    pose_ = pose_ * Pose2{0.1 * outputs.motion.speed_mps, 0.0, 0.1 * outputs.motion.turn_radps};
    return outputs;
  }

  /// A whole mission: some way, then a stop by hand.
  void drive(int ticks) {
    tick({mission("m1", 1)});
    for (int i = 1; i < ticks; ++i) tick();
    if (state_.drive == wire::DriveState::kDriving)
      tick({wire::StopOrder{"s1", 1, wire::Reason{wire::ReasonCode::kStoppedByHand}, "test"}});
  }

  [[nodiscard]] std::vector<std::filesystem::path> recordings() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options_.folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  [[nodiscard]] std::filesystem::path recording() const {
    const auto files = recordings();
    EXPECT_EQ(files.size(), 1U);
    return files.empty() ? std::filesystem::path() : files.front();
  }
  void change(const std::string& sql) const {
    SQLite::Database(recording().string(), SQLite::OPEN_READWRITE).exec(sql);
  }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

  homeward::testing::ScratchFolder folder_;
  std::shared_ptr<const camera::Camera> camera_;
  Recorder::Robot robot_;
  std::optional<pipeline::Eye> eye_;
  RecordingOptions options_;
  std::unique_ptr<Recorder> recorder_;
  driving::DrivingState state_;
  driving::Milliseconds now_ms_ = 50'000;
  std::int64_t seq_ = 1;
  bool robot_link_up_ = true;
  Pose2 pose_;
  bool pictures_ = true;
  bool looks_ = true;  // else it is only told that pictures are taken
  std::vector<wire::StateRow> rows_;
  std::optional<driving::JoystickReading> hand_;
  std::optional<driving::Leg> leg_;  // of an exploration
  std::optional<driving::ExplorationOver> over_;
  std::optional<wire::Reason> why_not_exploring_;
  std::optional<driving::PathSight> path_sight_;
  std::optional<wire::Reason> why_not_repeating_;

 private:
  std::mutex mutex_;
  std::string log_;
};

}  // namespace homeward::recording
