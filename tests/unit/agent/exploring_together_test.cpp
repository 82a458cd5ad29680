// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "unit/agent/thinking_robot.hpp"

namespace homeward::agent::thinker_test {
namespace {

using wire::ExplorationPhase;

/// Two robots in one painted room, whose programs speak to each other over a link that may lose messages.
class ExploringTogether : public ::testing::Test {
 protected:
  ExploringTogether() {
    b_.truth_ = b_.first_ = {-1.2, -0.8, 2.0};
    for (ThinkingRobot* robot : {&a_, &b_}) {
      robot->together_ = true;
      robot->start_program();
    }
  }

  void begin() {
    a_.order("x1", false);
    b_.order("x2", false);
    a_.command(wire::Companion{ExplorationId("x1"), ExplorationId("x2")});
    b_.command(wire::Companion{ExplorationId("x2"), ExplorationId("x1")});
  }
  void pass(ThinkingRobot& from, ThinkingRobot& to) {
    for (const auto& bytes : std::exchange(from.to_companion_, {})) {
      auto message = *wire::decode_server_message(bytes);
      if (auto* view = std::get_if<wire::CompanionView>(&message)) {
        views_.push_back(view->index);
        if (loses_ > 0 && views_.size() % loses_ == 0) continue;
        to.from_companion_.push_back({std::move(*view), to.now()});
      } else {
        to.from_companion_.push_back({std::get<wire::CompanionState>(message), to.now()});
      }
    }
  }
  void cycle() {
    for (ThinkingRobot* robot : {&a_, &b_}) {
      robot->other_ = (robot == &a_ ? b_ : a_).truth_;
      robot->cycle();
    }
    if (!linked_) return;
    pass(a_, b_);
    pass(b_, a_);
  }
  /// Until each has so many pictures, and then both stand.
  void explore_to(std::int64_t of_a, std::int64_t of_b) {
    for (int k = 0; k < 3000 && (kept(a_) < of_a || kept(b_) < of_b); ++k) {
      cycle();
      if (kept(a_) >= of_a) a_.command(OrderEnded{});
      if (kept(b_) >= of_b) b_.command(OrderEnded{});
    }
  }
  void stand(int cycles) {
    for (int k = 0; k < cycles; ++k) cycle();
  }
  static std::int64_t kept(const ThinkingRobot& robot) {
    return static_cast<std::int64_t>(KeptFiles::open(robot.folder_.path() / (robot.report().id.str()))->size());
  }
  /// So many pictures of the other's it has.
  static std::int64_t has(ThinkingRobot& robot) {
    robot.command(wire::Finish{ExplorationId("none")});  // reports at once
    return robot.report().companion ? robot.report().companion->pictures : -1;
  }

  ThinkingRobot a_;
  ThinkingRobot b_;
  std::vector<std::int64_t> views_;  // that were told
  std::size_t loses_ = 0;            // one of so many of them
  bool linked_ = true;
};

TEST_F(ExploringTogether, EachFindsHowTheOthersFloorLiesToItsOwn) {
  begin();
  const auto joined = [](const ThinkingRobot& robot) {
    return robot.report().companion && robot.report().companion->joined;
  };
  for (int k = 0; k < 3000 && !(joined(a_) && joined(b_)) && !(a_.said_.over && b_.said_.over); ++k) cycle();
  for (ThinkingRobot* robot : {&a_, &b_}) {
    ASSERT_TRUE(robot->report().companion);
    EXPECT_TRUE(robot->report().companion->joined);
    EXPECT_GT(has(*robot), 0);
  }
}

TEST_F(ExploringTogether, WhatIsLostOnTheWayIsToldAgain) {
  begin();
  loses_ = 3;
  explore_to(5, 1);
  stand(200);
  EXPECT_EQ(has(a_), 1);
  EXPECT_EQ(has(b_), 5);
  EXPECT_GT(views_.size(), 6U);
  EXPECT_LT(views_.size(), 30U) << "and no more than it takes";
}

TEST_F(ExploringTogether, WhoWasStartedAnewIsCaughtUpWithAndKnowsItsCompanionStill) {
  begin();
  explore_to(4, 1);
  stand(60);
  ASSERT_EQ(has(b_), 4);
  b_.start_program();
  EXPECT_EQ(b_.report().companion->exploration, ExplorationId("x1"));
  EXPECT_EQ(has(b_), 0);
  stand(60);
  EXPECT_EQ(has(b_), 4);
  EXPECT_EQ(has(a_), 1) << "and nothing is lost of what it told before";
}

TEST_F(ExploringTogether, WhoHasLostPicturesTellsThemAnew) {
  begin();
  explore_to(1, 4);
  stand(60);
  ASSERT_EQ(has(a_), 4);
  std::ofstream(b_.folder_.path() / "x2" / "tour" / "00002.jpg") << "no picture";
  b_.start_program();
  stand(60);
  EXPECT_EQ(has(a_), 2);
}

TEST_F(ExploringTogether, WithoutTheLinkEachGoesOnAlone) {
  begin();
  linked_ = false;
  for (int k = 0; k < 3000 && !(a_.said_.over && b_.said_.over); ++k) cycle();
  ASSERT_TRUE(a_.said_.over && b_.said_.over);
  EXPECT_FALSE(a_.said_.over->failed);
  EXPECT_EQ(has(a_), 0);
  EXPECT_FALSE(a_.report().companion->joined);
}

TEST_F(ExploringTogether, WhatNoCompanionTellsIsPassedOverWithAWordInTheLog) {
  begin();
  explore_to(1, 2);
  stand(40);
  ASSERT_EQ(has(a_), 2);
  wire::CompanionView view{ExplorationId("x9"), 2, *KeptFiles::open(b_.folder_.path() / "x2")->view(1), {}};
  a_.log_.clear();
  a_.from_companion_ = {{view, a_.now()}};
  a_.cycle();
  ASSERT_EQ(a_.log_.size(), 1U);
  EXPECT_NE(a_.log_[0].find("x9"), std::string::npos);
  stand(120);
  a_.log_.clear();
  view.exploration = ExplorationId("x2");
  view.appearance = {1, 2, 3};
  a_.from_companion_ = {{view, a_.now()}, {view, a_.now()}};
  a_.cycle();
  EXPECT_EQ(a_.log_.size(), 1U) << "once, as it may come again and again";
  EXPECT_EQ(has(a_), 2);
  a_.from_companion_.assign(1000, FromCompanion{view, a_.now()});
  a_.cycle();
  EXPECT_EQ(has(a_), 2);
}

TEST_F(ExploringTogether, OnlyTheExplorationThatItHasIsSharedAndNotWithItself) {
  a_.order("x1", false);
  const auto with = [&](const char* exploration, const char* companion) {
    a_.command(wire::Companion{ExplorationId(exploration), ExplorationId(companion)});
    return a_.report().companion ? a_.report().companion->exploration.str() : "none";
  };
  EXPECT_EQ(with("x7", "x2"), "none");
  EXPECT_EQ(with("x1", "x1"), "none");
  EXPECT_EQ(with("x1", "x2"), "x2");
  a_.start_program();
  EXPECT_EQ(a_.report().companion->exploration, ExplorationId("x2"));
  a_.command(wire::Companion{ExplorationId("x1"), std::nullopt});
  EXPECT_FALSE(a_.report().companion);
  a_.start_program();
  EXPECT_FALSE(a_.report().companion);
}

TEST_F(ExploringTogether, PicturesGoToTheServerOnceTheCompanionHasThemOrIsGone) {
  begin();
  explore_to(4, 1);
  a_.command(wire::Finish{ExplorationId("x1")});
  EXPECT_TRUE(a_.uploads_.empty()) << "the companion lacks some";
  stand(60);
  EXPECT_EQ(a_.uploads_.size(), 1U);
  EXPECT_EQ(has(b_), 4);
  linked_ = false;
  b_.command(wire::Finish{ExplorationId("x2")});
  stand(200);
  EXPECT_EQ(b_.uploads_.size(), 1U);
}

}  // namespace
}  // namespace homeward::agent::thinker_test
