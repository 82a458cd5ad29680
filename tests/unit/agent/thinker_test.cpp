// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/thinker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "support/reason_printing.hpp"
#include "unit/agent/thinking_robot.hpp"

namespace homeward::agent::thinker_test {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

class ThinkerTest : public ::testing::Test, protected ThinkingRobot {};

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
