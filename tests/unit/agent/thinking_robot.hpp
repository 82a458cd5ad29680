// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "agent/explore/thinker.hpp"
#include "files/tour_folder.hpp"
#include "imageio/decode.hpp"
#include "support/drawn_walls.hpp"
#include "support/painted_room.hpp"
#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::thinker_test {

inline const homeward::testing::PaintedRoom& room() {
  static const homeward::testing::PaintedRoom kRoom{2.6, 2.1, 1.4, -1.2, 1};
  return kRoom;
}

inline const camera::CameraConfig& camera_config() {
  static const camera::CameraConfig kConfig = homeward::testing::sphere_camera(320);
  return kConfig;
}

inline const camera::Camera& the_camera() {
  static const auto kCamera = camera::Camera::create(camera_config()).value();
  return *kCamera;
}

inline const pipeline::Eye& eye() {
  static const auto kEye = pipeline::Eye::create(camera_config(), pipeline::suited_feature_config(the_camera()));
  return *kEye;
}

/// A robot of no size in a painted room, 0.1 s a cycle and a picture every other one, whose program may be started
/// anew.
class ThinkingRobot {
 public:
  ThinkingRobot() {
    homeward::testing::add_box(walls_, -room().half_length_m, -room().half_width_m, room().half_length_m,
                               room().half_width_m);
    start_program();
  }

  void start_program() {
    thinker_.reset();
    ThinkerOptions options;
    options.folder = folder_.path();
    options.explorer.floor.cell_m = 0.1;
    options.upload_again_after = std::chrono::milliseconds(0);
    if (together_) options.now = [this] { return now(); };
    options.log = [this](const std::string& line) { log_.push_back(line); };
    options.upload = [this](const KeptFiles& kept, const std::string& name,
                            const std::function<bool(double)>& progress) -> Result<TourId> {
      uploads_.push_back(name);
      progress(0.5);
      if (upload_fails_) return fail(ErrorCode::kIo, "The server is away.", "server");
      uploaded_ = *files::TourFolder::open(kept.tour_folder());
      sweeps_uploaded_ = kept.sweeps()->size();
      return TourId("t7");
    };
    thinker_.emplace(options, camera_config(), eye());
    said_ = {};
    told_.clear();
    // Odometry counts from where a program starts.
    began_ = truth_;
    thinker_->take_up_kept(tell_, stop_.get_token());
  }

  /// By the clock of robots that explore together.
  [[nodiscard]] std::chrono::steady_clock::time_point now() const {
    return std::chrono::steady_clock::time_point(std::chrono::milliseconds(now_ms_));
  }
  [[nodiscard]] Pose2 odometry() const { return inverse(began_) * truth_; }

  void order(const std::string& id, bool goes_on, std::optional<double> limit_m = {}) {
    OrderObeyed obeyed;
    obeyed.order.mission = MissionId("m" + std::to_string(++missions_));
    obeyed.order.exploration = ExplorationId(id);
    obeyed.order.goes_on = goes_on;
    obeyed.order.limit_m = limit_m;
    obeyed.odometry_epoch = epoch_;
    command(obeyed);
  }
  void command(const ExploringCommand& what) {
    ToThinker mail;
    mail.commands = {what};
    mail.link_up = link_up_;
    mail.companion = std::exchange(from_companion_, {});
    thinker_->think(mail, tell_, stop_.get_token());
  }

  /// One cycle: it sees, thinks, and drives 0.05 m towards its leg's goal.
  void cycle() {
    now_ms_ += 100;
    ToThinker mail;
    mail.link_up = link_up_;
    auto walls = walls_;
    if (other_)
      homeward::testing::add_box(walls, other_->x_m - 0.2, other_->y_m - 0.2, other_->x_m + 0.2, other_->y_m + 0.2);
    sweeps_.push_back({now_ms_, sweep_of(walls, truth_), odometry()});
    if (sweeps_.size() > 3) sweeps_.pop_front();
    mail.sweeps = sweeps_;
    mail.odometry_epoch = epoch_;
    mail.blocked = blocked_;
    if (said_.wants_features && now_ms_ % 200 == 0) mail.picture = picture();
    mail.companion = std::exchange(from_companion_, {});
    thinker_->think(mail, tell_, stop_.get_token());
    if (!said_.leg) return;
    const Pose2 goal = began_ * Pose2{said_.leg->goal_m.x(), said_.leg->goal_m.y(), 0.0};
    const Eigen::Vector2d way_m = position_m(goal) - position_m(truth_);
    if (way_m.norm() < 0.01) return;
    const double step_m = std::min(0.05, way_m.norm());
    truth_ = {truth_.x_m + step_m * way_m.x() / way_m.norm(), truth_.y_m + step_m * way_m.y() / way_m.norm(),
              std::atan2(way_m.y(), way_m.x())};
  }
  /// Until that many pictures are kept, or it is over.
  void explore_to(std::int64_t pictures, int cycles = 3000) {
    for (int k = 0; k < cycles && !said_.over && report().pictures < pictures; ++k) {
      cycle();
      if (k % 5 == 0) command(wire::Finish{ExplorationId("none")});  // reports at once
    }
  }
  [[nodiscard]] SeenByCamera picture() const {
    const Image image = homeward::testing::painted_picture(room(), truth_, the_camera());
    auto bytes = std::make_shared<const std::vector<std::uint8_t>>(imageio::encode_jpeg(image, 95));
    const auto seen = eye().look(*imageio::decode(*bytes, "picture"));
    return {{now_ms_, std::make_shared<const features::Appearance>(*seen), {}, odometry()}, bytes};
  }
  [[nodiscard]] const wire::ExplorationReport& report() const {
    static const wire::ExplorationReport kNone;
    return told_.empty() ? kNone : told_.back();
  }
  void end_order(std::optional<wire::Reason> reason) {
    command(OrderEnded{std::move(reason)});
    sweeps_.clear();
  }

  /// Of how many pictures rows of the table of states tell.
  [[nodiscard]] std::int64_t pictures_told() const {
    return std::ranges::count_if(rows_, [](const wire::SurveyRow& row) {
      return row.state == wire::SurveyState::kNew || row.state == wire::SurveyState::kKnownAgain;
    });
  }
  [[nodiscard]] std::vector<wire::SurveyEnd> ends_told() const {
    std::vector<wire::SurveyEnd> ends;
    for (const wire::SurveyRow& row : rows_)
      if (row.end) ends.push_back(*row.end);
    return ends;
  }

  homeward::testing::ScratchFolder folder_;
  std::vector<testing::DrawnWall> walls_;
  Pose2 truth_{1.0, 0.5, 0.4};
  Pose2 first_ = truth_;  // where the exploration began
  Pose2 began_ = truth_;
  std::stop_source stop_;
  FromThinker said_;
  std::vector<wire::ExplorationReport> told_;
  std::vector<wire::SurveyRow> rows_;
  Thinker::Tell tell_ = [this](const FromThinker& said) {
    said_ = said;
    if (said.report) told_.push_back(*said.report);
    to_companion_.insert(to_companion_.end(), said.to_companion.begin(), said.to_companion.end());
    for (const wire::StateRow& row : said.rows) rows_.push_back(std::get<wire::SurveyRow>(row));
  };
  std::optional<Thinker> thinker_;
  std::optional<Pose2> other_;  // a robot, as a box
  bool together_ = false;       // its clock is the cycles'
  std::vector<FromCompanion> from_companion_;
  std::vector<std::vector<std::uint8_t>> to_companion_;
  std::deque<Sensed> sweeps_;
  std::int64_t now_ms_ = 0;
  int missions_ = 0;
  int epoch_ = 0;  // of odometry
  bool blocked_ = false;
  bool link_up_ = true;
  bool upload_fails_ = false;
  std::vector<std::string> uploads_;
  std::optional<files::TourFolder> uploaded_;
  std::size_t sweeps_uploaded_ = 0;
  std::vector<std::string> log_;
};

}  // namespace homeward::agent::thinker_test
