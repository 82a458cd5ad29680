// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/thinker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "files/tour_folder.hpp"
#include "imageio/decode.hpp"
#include "support/drawn_walls.hpp"
#include "support/painted_room.hpp"
#include "support/reason_printing.hpp"
#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::thinker_test {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

const homeward::testing::PaintedRoom& room() {
  static const homeward::testing::PaintedRoom kRoom{2.6, 2.1, 1.4, -1.2, 1};
  return kRoom;
}

const camera::CameraConfig& camera_config() {
  static const camera::CameraConfig kConfig = homeward::testing::sphere_camera(320);
  return kConfig;
}

const camera::Camera& the_camera() {
  static const auto kCamera = camera::Camera::create(camera_config()).value();
  return *kCamera;
}

const pipeline::Eye& eye() {
  static const auto kEye = pipeline::Eye::create(camera_config(), pipeline::suited_feature_config(the_camera()));
  return *kEye;
}

/// A robot of no size in a painted room, 0.1 s a cycle and a picture every other one, whose program may be started
/// anew.
class ThinkerTest : public ::testing::Test {
 protected:
  ThinkerTest() {
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
    thinker_->think(mail, tell_, stop_.get_token());
  }

  /// One cycle: it sees, thinks, and drives 0.05 m towards its leg's goal.
  void cycle() {
    now_ms_ += 100;
    ToThinker mail;
    mail.link_up = link_up_;
    sweeps_.push_back({now_ms_, sweep_of(walls_, truth_), odometry()});
    if (sweeps_.size() > 3) sweeps_.pop_front();
    mail.sweeps = sweeps_;
    mail.odometry_epoch = epoch_;
    mail.blocked = blocked_;
    if (said_.wants_features && now_ms_ % 200 == 0) mail.picture = picture();
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
    for (const wire::StateRow& row : said.rows) rows_.push_back(std::get<wire::SurveyRow>(row));
  };
  std::optional<Thinker> thinker_;
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

TEST_F(ThinkerTest, ARoomIsExploredAndItsPicturesBecomeATourOnTheServer) {
  order("x1", false);
  explore_to(1000);
  ASSERT_TRUE(said_.over);
  EXPECT_FALSE(said_.over->failed);
  EXPECT_FALSE(said_.over->reason);
  EXPECT_FALSE(said_.leg);
  end_order(std::nullopt);
  ASSERT_EQ(uploads_, std::vector<std::string>{"Exploration x1"});
  EXPECT_EQ(report().phase, ExplorationPhase::kUploaded);
  EXPECT_EQ(report().tour, TourId("t7"));
  ASSERT_TRUE(uploaded_);
  ASSERT_EQ(static_cast<std::int64_t>(uploaded_->images().size()), report().pictures);
  EXPECT_GT(report().pictures, 5);
  EXPECT_EQ(report().nodes_m.size(), uploaded_->images().size());
  const Pose2 last = *uploaded_->images().back().odometry;
  EXPECT_NEAR(last.x_m, report().nodes_m.back().x(), 0.01) << "the odometry of the tour is that of the settled poses";
  EXPECT_EQ(sweeps_uploaded_, uploaded_->images().size());
  EXPECT_EQ(pictures_told(), report().pictures);
  EXPECT_EQ(ends_told(), std::vector{wire::SurveyEnd::kAllSeen});
  start_program();
  EXPECT_TRUE(told_.empty()) << "nothing is left to do";
  EXPECT_FALSE(said_.exploration);
}

TEST_F(ThinkerTest, AfterARestartItGoesOnFromWhereItStands) {
  order("x1", false);
  explore_to(6);
  const Pose2 stood = truth_;
  const auto nodes_m = report().nodes_m;
  truth_ = truth_ * Pose2{0.3, -0.2, 1.8};  // pushed a little, and turned
  start_program();
  EXPECT_EQ(told_.front().phase, ExplorationPhase::kWaiting);
  EXPECT_EQ(report().phase, ExplorationPhase::kPaused);
  EXPECT_EQ(report().pictures, 6);
  EXPECT_EQ(said_.exploration, ExplorationId("x1"));
  for (std::size_t i = 0; i < nodes_m.size(); ++i)
    EXPECT_LT((report().nodes_m[i] - nodes_m[i]).norm(), 0.02) << "node " << i;
  for (int k = 0; k < 5; ++k) cycle();
  EXPECT_LT((position_m(truth_) - position_m(stood * Pose2{0.3, -0.2, 1.8})).norm(), 1e-9) << "no order, no way";
  order("x1", true);
  explore_to(8);
  EXPECT_EQ(report().phase, ExplorationPhase::kExploring);
  ASSERT_EQ(report().pictures, 8);
  ASSERT_TRUE(report().pose);
  EXPECT_LT((position_m(first_ * *report().pose) - position_m(truth_)).norm(), 0.15);
  // And once more, with what was taken in two programs.
  start_program();
  EXPECT_EQ(report().pictures, 8);
  order("x1", true);
  explore_to(1000);
  ASSERT_TRUE(said_.over);
  EXPECT_FALSE(said_.over->failed) << said_.over->reason;
  EXPECT_EQ(pictures_told(), report().pictures) << "those of before a restart were told then";
  EXPECT_LT((position_m(first_ * *report().pose) - position_m(truth_)).norm(), 0.15);
}

TEST_F(ThinkerTest, WhatWasGivenUpStaysGivenUpAfterARestart) {
  const auto given_up = [&] { return KeptFiles::open(folder_.path() / "x1")->kept().given_up; };
  order("x1", false);
  for (int k = 0; k < 3000 && !said_.over && given_up().empty(); ++k) cycle();
  const auto before = given_up();
  ASSERT_FALSE(before.empty());
  start_program();  // as after a kill
  order("x1", true);
  explore_to(report().pictures + 1);
  const auto after = given_up();
  ASSERT_GE(after.size(), before.size()) << "what is kept is what the explorer has given up";
  EXPECT_TRUE(std::ranges::equal(before, std::span(after).first(before.size())));
}

TEST_F(ThinkerTest, WhoWasCarriedAwayMeanwhileSaysSoAndDrivesNowhere) {
  order("x1", false);
  explore_to(4);
  truth_ = {-2.0, -1.5, 2.0};
  start_program();
  order("x1", true);
  for (int k = 0; k < 20 && !said_.over; ++k) cycle();
  EXPECT_EQ(position_m(truth_), Eigen::Vector2d(-2.0, -1.5));
  ASSERT_TRUE(said_.over);
  EXPECT_TRUE(said_.over->failed);
  EXPECT_EQ(said_.over->reason, wire::Reason{ReasonCode::kRobotMovedSince});
  end_order(said_.over->reason);
  EXPECT_EQ(report().phase, ExplorationPhase::kPaused);
  EXPECT_EQ(said_.exploration, ExplorationId("x1")) << "brought back, it goes on";
}

TEST_F(ThinkerTest, WhereOdometryMayNotGoOnItLooksWhereItStandsFirst) {
  order("x1", false);
  explore_to(4);
  end_order(wire::Reason{ReasonCode::kLifted});
  truth_ = {-2.0, -1.5, 2.0};  // odometry knows nothing of it here, as the same program goes on
  began_ = truth_ * inverse(Pose2{0.5, 0.0, 0.0});
  OrderObeyed obeyed;
  obeyed.order.mission = MissionId("m9");
  obeyed.order.exploration = ExplorationId("x1");
  obeyed.order.goes_on = true;
  obeyed.odometry_epoch = epoch_ = 1;
  command(obeyed);
  for (int k = 0; k < 20 && !said_.over; ++k) cycle();
  ASSERT_TRUE(said_.over);
  EXPECT_EQ(said_.over->reason, wire::Reason{ReasonCode::kRobotMovedSince});
}

TEST_F(ThinkerTest, OdometryThatBeginsAnewWhileItDrivesEndsThatAndItGoesOnAfterALook) {
  order("x1", false);
  explore_to(4);
  began_ = truth_;  // the base was switched off and on
  epoch_ = 1;
  cycle();
  ASSERT_TRUE(said_.over);
  EXPECT_TRUE(said_.over->failed);
  EXPECT_FALSE(said_.leg);
  end_order(said_.over->reason);
  order("x1", true);
  explore_to(6);
  EXPECT_EQ(report().pictures, 6);
  EXPECT_LT((position_m(first_ * *report().pose) - position_m(truth_)).norm(), 0.15);
}

TEST_F(ThinkerTest, WhereItIsBlockedOnceItWantsAnotherPlace) {
  order("x1", false);
  explore_to(2);
  while (!report().target_m) cycle(), command(wire::Finish{ExplorationId("none")});
  const Eigen::Vector2d before_m = *report().target_m;
  blocked_ = true;
  cycle();
  blocked_ = false;
  cycle();
  command(wire::Finish{ExplorationId("none")});
  ASSERT_TRUE(report().target_m);
  EXPECT_GT((*report().target_m - before_m).norm(), 0.1);
}

TEST_F(ThinkerTest, WithoutAPictureThereIsNothingToUploadAndNothingStays) {
  order("x1", false);
  end_order(wire::Reason{ReasonCode::kStoppedBy, {{"by", "anna"}}});
  command(wire::Finish{ExplorationId("x1")});
  cycle();
  EXPECT_TRUE(uploads_.empty());
  EXPECT_EQ(report().phase, ExplorationPhase::kUploaded);
  EXPECT_FALSE(report().tour);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "x1"));
}

TEST_F(ThinkerTest, WhatCannotBeReadAgainIsLeftOutFromThereOn) {
  order("x1", false);
  explore_to(4);
  std::ofstream(folder_.path() / "x1" / "tour" / "00002.jpg") << "no picture";
  start_program();
  EXPECT_EQ(report().phase, ExplorationPhase::kPaused);
  EXPECT_EQ(report().pictures, 2);
  order("x1", true);
  explore_to(3);
  start_program();
  EXPECT_EQ(report().pictures, 3) << "what was left out does not come back behind the new one";
  std::ofstream(folder_.path() / "x1" / "tour" / "00000.jpg") << "no picture";
  start_program();
  EXPECT_FALSE(said_.exploration);
  EXPECT_TRUE(wire::says(report().reason, ReasonCode::kExplorationBroken));
}

TEST_F(ThinkerTest, AnEndedOneIsNotGoneOnWith) {
  link_up_ = false;
  order("x1", false);
  explore_to(3);
  end_order(std::nullopt);
  command(wire::Finish{ExplorationId("x1")});
  order("x1", true);
  ASSERT_TRUE(said_.over);
  EXPECT_EQ(said_.over->reason, wire::Reason{ReasonCode::kExplorationUnknown});
  EXPECT_FALSE(said_.leg);
}

TEST_F(ThinkerTest, FencesThatCannotBeKeptHoldAndStopIt) {
  order("x1", false);
  explore_to(2);
  std::filesystem::remove_all(folder_.path() / "x1");
  command(wire::Fences{ExplorationId("x1"), {{{5.0, 5.0}, {6.0, 5.0}, {6.0, 6.0}}}});
  ASSERT_TRUE(said_.over);
  EXPECT_TRUE(wire::says(said_.over->reason, ReasonCode::kExplorationBroken));
}

TEST_F(ThinkerTest, APauseKeepsAllAndTheSameProgramGoesOn) {
  order("x1", false);
  explore_to(3);
  end_order(wire::Reason{ReasonCode::kStoppedBy, {{"by", "anna"}}});
  EXPECT_EQ(report().phase, ExplorationPhase::kPaused);
  EXPECT_TRUE(wire::says(report().reason, ReasonCode::kStoppedBy));
  const auto pictures = report().pictures;
  const Pose2 stands = truth_;
  for (int k = 0; k < 5; ++k) cycle();
  EXPECT_EQ(position_m(truth_), position_m(stands));
  order("x1", true);
  explore_to(pictures + 1);
  EXPECT_EQ(report().pictures, pictures + 1);
  EXPECT_FALSE(report().reason);
}

TEST_F(ThinkerTest, ALimitOfWayEndsItAndItsPicturesAreATour) {
  order("x1", false, 1.5);
  explore_to(1000);
  ASSERT_TRUE(said_.over);
  EXPECT_EQ(said_.over->reason, wire::Reason{ReasonCode::kExplorationLimit});
  EXPECT_EQ(ends_told(), std::vector{wire::SurveyEnd::kLimit});
  end_order(std::nullopt);
  EXPECT_EQ(report().phase, ExplorationPhase::kUploaded);
  EXPECT_NEAR(report().driven_m, 1.5, 0.1);
}

TEST_F(ThinkerTest, FencesHoldAndOutliveARestart) {
  order("x1", false);
  explore_to(2);
  // All that lies 0.5 m and more behind where it began.
  const wire::Fence behind = {{-0.5, -9.0}, {-9.0, -9.0}, {-9.0, 9.0}, {-0.5, 9.0}};
  command(wire::Fences{ExplorationId("x1"), {behind}});
  ASSERT_EQ(report().fences_m.size(), 1U);
  end_order(std::nullopt);
  start_program();
  ASSERT_EQ(report().fences_m.size(), 1U);
  EXPECT_EQ(report().fences_m[0], behind);
  order("x1", true);
  explore_to(1000);
  ASSERT_TRUE(said_.over);
  for (const Eigen::Vector2d& node_m : report().nodes_m) EXPECT_GT(node_m.x(), -0.5);
}

TEST_F(ThinkerTest, APausedOneIsEndedByHandAndOneThatExploresIsNot) {
  order("x1", false);
  explore_to(3);
  command(wire::Finish{ExplorationId("x1")});
  EXPECT_EQ(report().phase, ExplorationPhase::kExploring);
  end_order(wire::Reason{ReasonCode::kStoppedBy, {{"by", "anna"}}});
  upload_fails_ = true;
  command(wire::Finish{ExplorationId("x1")});
  EXPECT_EQ(report().phase, ExplorationPhase::kEnded);
  ASSERT_TRUE(wire::says(report().reason, ReasonCode::kExplorationNotUploaded));
  EXPECT_FALSE(said_.exploration) << "there is nothing to go on with";
  start_program();
  upload_fails_ = false;
  cycle();
  EXPECT_EQ(report().phase, ExplorationPhase::kUploaded) << "it is tried again, after a restart too";
  EXPECT_EQ(static_cast<std::int64_t>(uploaded_->images().size()), 3);
}

TEST_F(ThinkerTest, ANewOneEndsThePausedOneAndLosesNothingOfIt) {
  link_up_ = false;
  order("x1", false);
  explore_to(3);
  end_order(std::nullopt);
  order("x2", false);
  explore_to(2);
  EXPECT_EQ(report().id, ExplorationId("x2"));
  end_order(std::nullopt);
  EXPECT_TRUE(uploads_.empty()) << "no link, no upload";
  link_up_ = true;
  cycle();
  EXPECT_EQ(uploads_, std::vector<std::string>{"Exploration x1"});
  EXPECT_EQ(said_.exploration, ExplorationId("x2"));
}

TEST_F(ThinkerTest, WhatCannotBeWrittenStopsItWithTheReason) {
  order("x1", false);
  explore_to(2);
  std::filesystem::remove_all(folder_.path() / "x1" / "views");
  explore_to(1000);
  ASSERT_TRUE(said_.over);
  EXPECT_TRUE(said_.over->failed);
  EXPECT_TRUE(wire::says(said_.over->reason, ReasonCode::kExplorationBroken)) << said_.over->reason;
  end_order(said_.over->reason);
  EXPECT_EQ(report().phase, ExplorationPhase::kPaused);
  EXPECT_EQ(report().pictures, 2) << "what was kept is kept";
}

TEST_F(ThinkerTest, AnIdThatLeadsOutOfItsFolderIsRefused) {
  order("../x1", false);
  ASSERT_TRUE(said_.over);
  EXPECT_TRUE(said_.over->failed);
  EXPECT_FALSE(std::filesystem::exists(folder_.path().parent_path() / "x1"));
}

}  // namespace
}  // namespace homeward::agent::thinker_test
