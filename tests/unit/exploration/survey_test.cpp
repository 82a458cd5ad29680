// SPDX-License-Identifier: Apache-2.0
#include "exploration/survey.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

/// Cells of 0.1 m are enough for what is drawn here.
ExplorerConfig coarse() {
  ExplorerConfig config;
  config.floor.cell_m = 0.1;
  return config;
}

/// A robot of no size that goes straight to each goal, 0.05 m a cycle.
struct Walker {
  std::vector<testing::DrawnWall> walls = testing::two_rooms();
  Pose2 start{1.0, 2.0, 0.3};
  Pose2 truth = start;
  Survey survey{coarse(), SurveyConfig{}};
  std::vector<Pose2> pictures;
  std::int64_t now_ms = 0;
  double driven_m = 0.0;
  std::optional<SurveyEnd> ended;
  std::vector<SurveyRow> rows;

  /// False: the survey is complete.
  bool cycle(bool blocked = false) {
    constexpr double kStep_m = 0.05;
    const RangeSweep sweep = sweep_of(walls, truth);
    const Pose2 odometry = inverse(start) * truth;
    const SurveyStep step = survey.go_on(sweep, odometry, blocked, now_ms);
    if (step.takes_picture) {
      survey.take(sweep, odometry, nullptr);
      pictures.push_back(truth);
    }
    now_ms += 100;
    ended = step.ended;
    for (SurveyRow& row : survey.take_rows()) rows.push_back(row);
    if (step.ended) return false;
    if (!step.goal_m || blocked) return true;
    const Pose2 goal = start * Pose2{step.goal_m->x(), step.goal_m->y(), 0.0};
    const Eigen::Vector2d way = position_m(goal) - position_m(truth);
    const double length_m = std::min(kStep_m, way.norm());
    if (length_m < 1e-6) return true;
    truth = {truth.x_m + length_m * way.x() / way.norm(), truth.y_m + length_m * way.y() / way.norm(),
             std::atan2(way.y(), way.x())};
    driven_m += length_m;
    return true;
  }

  [[nodiscard]] std::vector<SurveyRow> rows_of(SurveyState state) const {
    std::vector<SurveyRow> found;
    for (const SurveyRow& row : rows)
      if (row.state == state) found.push_back(row);
    return found;
  }
};

TEST(SurveyTest, BothRoomsAreCoveredAndThenItIsComplete) {
  Walker walker;
  int cycles = 0;
  while (walker.cycle() && cycles < 4000) ++cycles;
  ASSERT_LT(cycles, 4000);
  EXPECT_LT(walker.driven_m, 40.0);
  const Explorer& explorer = walker.survey.explorer();
  for (const Eigen::Vector2d& spot_m :
       std::vector<Eigen::Vector2d>{{0.6, 0.6}, {4.5, 3.4}, {6.0, 0.7}, {9.3, 0.6}, {9.3, 3.4}}) {
    const Pose2 there = inverse(walker.start) * Pose2{spot_m.x(), spot_m.y(), 0.0};
    EXPECT_TRUE(explorer.coverage().covers(position_m(there))) << spot_m.transpose();
  }
  EXPECT_FALSE(walker.survey.target_m());
  EXPECT_EQ(walker.ended, SurveyEnd::kAllSeen);
}

TEST(SurveyTest, ItIsBackWhereItBeganBeforeItsTimeIsOver) {
  Walker walker;
  constexpr std::int64_t kBackBy_ms = 40'000;
  walker.survey.be_back_by(kBackBy_ms);
  double farthest_m = 0.0;
  while (walker.now_ms < 2 * kBackBy_ms && walker.cycle())
    farthest_m = std::max(farthest_m, (position_m(walker.truth) - position_m(walker.start)).norm());
  EXPECT_EQ(walker.ended, SurveyEnd::kBack);
  EXPECT_LE(walker.now_ms, kBackBy_ms);
  EXPECT_GT(farthest_m, 1.5) << "it has explored before";
  EXPECT_LT((position_m(walker.truth) - position_m(walker.start)).norm(), 0.3);
}

TEST(SurveyTest, WhatIsFencedOffIsNotDriven) {
  Walker walker;
  // The second room, and a bit more than its door.
  std::vector<Eigen::Vector2d> corners_m;
  for (const Eigen::Vector2d& corner_m : std::vector<Eigen::Vector2d>{{4.8, 0.0}, {10.0, 0.0}, {10.0, 4.0}, {4.8, 4.0}})
    corners_m.push_back(position_m(inverse(walker.start) * Pose2{corner_m.x(), corner_m.y(), 0.0}));
  walker.survey.set_fences({corners_m});
  int cycles = 0;
  double farthest_m = 0.0;
  while (walker.cycle() && ++cycles < 4000) farthest_m = std::max(farthest_m, walker.truth.x_m);
  EXPECT_EQ(walker.ended, SurveyEnd::kAllSeen);
  EXPECT_GT(farthest_m, 3.0);
  EXPECT_LT(farthest_m, 4.8);
}

TEST(SurveyTest, WhatWasBlockedIsTriedAgainWhenNothingElseIsLeft) {
  Walker walker;
  const auto behind_door = [&] {
    const auto& target_m = walker.survey.target_m();
    return target_m && (walker.start * Pose2{target_m->x(), target_m->y(), 0.0}).x_m > 4.5;
  };
  // Somebody stands in the door the first time that the robot wants to go through it.
  int cycles = 0;
  while (!behind_door() && ++cycles < 4000) ASSERT_TRUE(walker.cycle());
  ASSERT_TRUE(walker.cycle(true));
  while (walker.cycle() && ++cycles < 4000) {
  }
  EXPECT_EQ(walker.ended, SurveyEnd::kAllSeen);
  EXPECT_EQ(walker.survey.explorer().put_off(), 0U);
  const Pose2 far = inverse(walker.start) * Pose2{9.0, 3.0, 0.0};
  EXPECT_TRUE(walker.survey.explorer().coverage().covers(position_m(far)));
}

TEST(SurveyTest, ARoomThatStaysShutDoesNotKeepItFromTheRest) {
  Walker walker;
  int cycles = 0;
  const auto beyond = [&] {
    const auto& target_m = walker.survey.target_m();
    return target_m && (walker.start * Pose2{target_m->x(), target_m->y(), 0.0}).x_m > 4.4;
  };
  while (walker.cycle(beyond()) && ++cycles < 6000) {
  }
  const Pose2 near = inverse(walker.start) * Pose2{0.6, 3.4, 0.0};
  EXPECT_TRUE(walker.survey.explorer().coverage().covers(position_m(near)));
  EXPECT_TRUE(walker.ended);
  EXPECT_GT(walker.survey.explorer().put_off(), 0U) << "it knows that it has not seen all";
}

TEST(SurveyTest, WhoHasSeenAllGoesBackWhereThatIsWanted) {
  Walker walker;
  walker.survey.be_back_by(1'000'000);
  int cycles = 0;
  while (walker.cycle() && ++cycles < 6000) {
  }
  EXPECT_EQ(walker.ended, SurveyEnd::kAllSeen);
  EXPECT_LT((position_m(walker.truth) - position_m(walker.start)).norm(), 0.3);
}

TEST(SurveyTest, WithoutAWayHomeItSaysThatItIsStuck) {
  Walker walker;
  walker.survey.be_back_by(40'000);
  while (walker.now_ms < 12'000) ASSERT_TRUE(walker.cycle());
  // Its start is fenced off.
  std::vector<Eigen::Vector2d> corners_m = {{-0.4, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {-0.4, 0.4}};
  walker.survey.set_fences({corners_m});
  while (walker.now_ms < 90'000 && walker.cycle()) {
  }
  EXPECT_EQ(walker.ended, SurveyEnd::kStuck);
}

TEST(SurveyTest, ABlockedPlaceIsGivenUpAndAnotherOneIsDrivenTo) {
  Walker walker;
  while (!walker.survey.target_m()) ASSERT_TRUE(walker.cycle());
  const Eigen::Vector2d first = *walker.survey.target_m();
  ASSERT_TRUE(walker.cycle(true));
  ASSERT_TRUE(walker.survey.target_m());
  EXPECT_GT((*walker.survey.target_m() - first).norm(), 0.25);
}

TEST(SurveyTest, WhoDoesNotGetAwayIsStuckAndHasNotSeenAll) {
  Walker walker;
  while (!walker.survey.target_m()) ASSERT_TRUE(walker.cycle());
  int cycles = 0;
  while (walker.cycle(true) && ++cycles < 100) {
  }
  EXPECT_EQ(walker.ended, SurveyEnd::kStuck);
}

TEST(SurveyTest, TheFirstThingThatItDoesIsTakeAPicture) {
  Walker walker;
  const SurveyStep step = walker.survey.go_on(sweep_of(walker.walls, walker.truth), {}, false, 0);
  EXPECT_TRUE(step.takes_picture);
  EXPECT_FALSE(step.goal_m);
  EXPECT_FALSE(step.ended);
}

TEST(SurveyTest, WhereNothingIsSeenNothingIsDriven) {
  Survey survey{ExplorerConfig{}, SurveyConfig{}};
  RangeSweep nothing;
  nothing.angle_step_rad = 0.1;
  nothing.ranges_m.assign(62, std::numeric_limits<float>::infinity());
  ASSERT_TRUE(survey.go_on(nothing, {}, false, 0).takes_picture);
  survey.take(nothing, {}, nullptr);
  for (std::int64_t now_ms = 100; now_ms < 20'000; now_ms += 100) {
    const SurveyStep step = survey.go_on(nothing, {}, false, now_ms);
    ASSERT_FALSE(step.goal_m);
    ASSERT_FALSE(step.ended) << "it waits";
  }
  EXPECT_EQ(survey.go_on(nothing, {}, false, 21'000).ended, SurveyEnd::kStuck)
      << "to call that explored would be wrong";
}

TEST(SurveyRows, ThereIsOneOfEachPictureAndOneOfTheEnd) {
  Walker walker;
  while (walker.cycle()) {
  }
  EXPECT_FALSE(walker.cycle());  // to be asked again changes nothing
  const auto fresh = walker.rows_of(SurveyState::kNew);
  const auto known = walker.rows_of(SurveyState::kKnownAgain);
  ASSERT_EQ(fresh.size() + known.size(), walker.pictures.size());
  EXPECT_EQ(walker.rows.front().state, SurveyState::kNew);
  int picture = 0;
  for (const SurveyRow& row : walker.rows) {
    if (row.state == SurveyState::kNew || row.state == SurveyState::kKnownAgain) {
      EXPECT_EQ(row.picture, picture++);
    }
  }
  ASSERT_EQ(walker.rows_of(SurveyState::kEnded).size(), 1U);
  EXPECT_EQ(walker.rows.back().state, SurveyState::kEnded);
  EXPECT_EQ(walker.rows.back().end, SurveyEnd::kAllSeen);
}

TEST(SurveyRows, APlaceThatIsKnownAgainNamesItsPictureAndHowWellTheyAgree) {
  Survey survey{ExplorerConfig{}, SurveyConfig{}};
  const std::vector<testing::DrawnWall> walls = testing::rooms_with_two_doors();
  const Pose2 start{1.0, 0.7, 0.0};
  Pose2 truth = start;
  const std::vector<Eigen::Vector2d> round_m = {{8.9, 0.7}, {8.9, 3.3}, {1.0, 3.3}, {1.0, 0.7}, {3.0, 0.7}};
  for (const Eigen::Vector2d& to_m : round_m) {
    const Eigen::Vector2d way_m = to_m - position_m(truth);
    truth.theta_rad = std::atan2(way_m.y(), way_m.x());
    for (double left_m = way_m.norm(); left_m > 0.0; left_m -= 0.1) {
      const RangeSweep sweep = sweep_of(walls, truth);
      const Pose2 odometry = inverse(start) * truth;
      survey.go_on(sweep, odometry, false, 0);  // it has seen all before it is round
      if (survey.explorer().wants_picture(odometry)) survey.take(sweep, odometry, nullptr);
      truth = truth * Pose2{0.1, 0.0, 0.0};
    }
  }
  std::vector<KnownAgain> told;
  for (const SurveyRow& row : survey.take_rows()) {
    if (row.state != SurveyState::kKnownAgain) continue;
    ASSERT_TRUE(row.picture && row.known && row.agreement);
    told.push_back({*row.picture, *row.known, *row.agreement, false});
  }
  const std::vector<KnownAgain>& known = survey.explorer().known_again();
  ASSERT_FALSE(known.empty());
  ASSERT_EQ(told.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(told[i].now, known[i].now);
    EXPECT_EQ(told[i].then, known[i].then);
    EXPECT_EQ(told[i].agreement, known[i].agreement);
    EXPECT_GE(told[i].agreement, survey.explorer().config().loop_agreement);
    EXPECT_LE(told[i].agreement, 1.0);
  }
  EXPECT_TRUE(survey.take_rows().empty()) << "rows are given once";
}

TEST(SurveyRows, EachPlaceDrivenToIsReachedOrBlockedOrPassedOver) {
  Walker walker;
  while (walker.cycle(walker.now_ms == 4000)) {
  }
  const auto next = walker.rows_of(SurveyState::kNextPlace);
  ASSERT_GT(next.size(), 3U);
  for (const SurveyRow& row : next) {
    ASSERT_TRUE(row.place_m && row.gain_m2 && row.cost_m);
    EXPECT_GE(*row.gain_m2, walker.survey.explorer().config().view.least_gain_m2);
    EXPECT_GT(*row.cost_m, 0.0);
  }
  std::optional<Eigen::Vector2d> driven_to_m;
  for (const SurveyRow& row : walker.rows) {
    if (row.state == SurveyState::kReached || row.state == SurveyState::kBlocked) {
      EXPECT_EQ(row.place_m, driven_to_m) << "it left a place that it did not drive to";
    }
    if (row.state == SurveyState::kNextPlace) {
      EXPECT_NE(row.place_m, driven_to_m) << "that is no other place";
      driven_to_m = row.place_m;
    }
  }
  EXPECT_EQ(walker.rows_of(SurveyState::kBlocked).size(), 1U);
  EXPECT_FALSE(walker.rows_of(SurveyState::kReached).empty());
}

TEST(SurveyRows, TheyTellThatItTriesAgainAndThatItIsStuck) {
  Walker walker;
  while (!walker.survey.target_m()) ASSERT_TRUE(walker.cycle());
  while (walker.cycle(true) && walker.now_ms < 20'000) {
  }
  EXPECT_EQ(walker.rows.back().end, SurveyEnd::kStuck);
  EXPECT_GE(walker.rows_of(SurveyState::kBlocked).size(), 5U);
  Walker other;
  while (other.cycle(other.now_ms == 4000)) {
  }
  EXPECT_FALSE(other.rows_of(SurveyState::kTriesAgain).empty());
}

TEST(SurveyRows, TheyTellOfTheWayHomeOnce) {
  Walker walker;
  walker.survey.be_back_by(40'000);
  while (walker.cycle()) {
  }
  const auto home = walker.rows_of(SurveyState::kGoesHome);
  ASSERT_EQ(home.size(), 1U);
  EXPECT_EQ(home.front().end, SurveyEnd::kBack);
  EXPECT_GT(home.front().cost_m.value_or(0.0), 1.0);
  EXPECT_EQ(walker.rows.back().end, SurveyEnd::kBack);
}

TEST(SurveyRows, ALimitIsAnEndUntilItGoesOn) {
  Walker walker;
  while (walker.now_ms < 3000) ASSERT_TRUE(walker.cycle());
  walker.survey.end_at_limit(inverse(walker.start) * walker.truth);
  EXPECT_FALSE(walker.cycle());
  EXPECT_EQ(walker.ended, SurveyEnd::kLimit);
  ASSERT_EQ(walker.rows_of(SurveyState::kEnded).size(), 1U);
  EXPECT_EQ(walker.rows.back().end, SurveyEnd::kLimit);
  walker.survey.go_on_anew(std::nullopt);
  EXPECT_TRUE(walker.cycle());
}

}  // namespace
}  // namespace homeward::exploration
