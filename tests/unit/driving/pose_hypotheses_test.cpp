// SPDX-License-Identifier: Apache-2.0
#include "driving/pose_hypotheses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/angles.hpp"

namespace homeward::driving::pose_hypotheses_test {
namespace {

/// What a robot at `map_from_robot` truly sees of a view, well recognised.
ViewSighting seen_from(const Pose2& map_from_robot, const Pose2& map_from_view) {
  const Pose2 robot_from_view = inverse(map_from_robot) * map_from_view;
  ViewSighting sighting;
  sighting.map_from_view = map_from_view;
  sighting.share = 0.4;
  sighting.agreeing = 240;
  sighting.direction = SightedDirection{std::atan2(robot_from_view.y_m, robot_from_view.x_m), robot_from_view.theta_rad,
                                        0.95, std::max(0.5, std::hypot(robot_from_view.x_m, robot_from_view.y_m))};
  return sighting;
}

/// A view near the robot in which nothing is recognised.
ViewSighting not_seen(const Pose2& map_from_view) {
  ViewSighting sighting;
  sighting.map_from_view = map_from_view;
  sighting.share = 0.0;
  return sighting;
}

Pose2 along(double x_m) { return {x_m, 0.0, 0.0}; }

/// The views of a corridor lie a metre apart, and now left, now right of the robot's way.
Pose2 view_of(double number, double corridor_m = 0.0) {
  const double aside_m = std::fmod(number, 2.0) == 0.0 ? 0.4 : -0.4;
  return {number + 0.4, corridor_m + aside_m, 0.0};
}

/// Drives straight on along a corridor with a view every metre, seeing the views around it.
class Corridor {
 public:
  Corridor() { look(1.0); }

  void drive(double way_m) {
    constexpr double kStep_m = 0.1;
    for (double left_m = way_m; left_m > 1e-9; left_m -= kStep_m) {
      at_m_ += kStep_m;
      hypotheses_.predict({kStep_m, 0.0, 0.0});
      look(1e-3);
    }
  }
  void look(double prior_share) {
    std::vector<ViewSighting> sightings;
    for (const double number : {std::floor(at_m_), std::floor(at_m_) + 1.0}) {
      sightings.push_back(seen_from(along(at_m_), view_of(number)));
      sightings.back().prior_share = prior_share;
    }
    hypotheses_.weigh(sightings);
  }
  [[nodiscard]] double error_m() const {
    const Pose2& pose = hypotheses_.best()->map_from_robot;
    return std::hypot(pose.x_m - at_m_, pose.y_m);
  }

  PoseHypotheses hypotheses_;
  double at_m_ = 0.0;
};

TEST(PoseHypotheses, KnowsNothingBeforeItHasSeenAnything) {
  PoseHypotheses hypotheses;
  hypotheses.predict({1.0, 0.0, 0.0});
  hypotheses.weigh(std::vector<ViewSighting>{not_seen(along(0.0))});
  EXPECT_EQ(hypotheses.best(), nullptr);
  EXPECT_EQ(hypotheses.best_probability(), 0.0);
  EXPECT_EQ(hypotheses.probability_within({0.0, 0.0}, 1.0), 0.0);
  EXPECT_NEAR(hypotheses.elsewhere(), 1.0, 1e-12);
}

TEST(PoseHypotheses, FollowsARobotThatDrivesPastItsViews) {
  Corridor corridor;
  corridor.drive(6.0);
  EXPECT_LT(corridor.error_m(), 0.15);
  EXPECT_GT(corridor.hypotheses_.best_probability(), 0.95);
  EXPECT_GT(corridor.hypotheses_.probability_within({corridor.at_m_, 0.0}, 0.5), 0.9);
  EXPECT_LT(corridor.hypotheses_.probability_within({corridor.at_m_ - 3.0, 0.0}, 0.5), 0.05);
}

TEST(PoseHypotheses, AClearViewOfAnotherCorridorMovesItNotAtAllAsLongAsItsOwnViewsAreSeen) {
  Corridor corridor;
  corridor.drive(3.0);
  // Four places ahead, in a corridor that looks alike: as clear as its own views, again and again.
  for (int k = 0; k < 40; ++k) {
    corridor.at_m_ += 0.1;
    corridor.hypotheses_.predict({0.1, 0.0, 0.0});
    std::vector<ViewSighting> sightings;
    sightings.push_back(seen_from(along(corridor.at_m_), view_of(std::floor(corridor.at_m_))));
    sightings.push_back(seen_from({corridor.at_m_, 20.0, 0.0}, view_of(std::floor(corridor.at_m_) + 4.0, 20.0)));
    sightings.back().share = 0.45;
    corridor.hypotheses_.weigh(sightings);
    EXPECT_LT(corridor.error_m(), 0.3) << k;
    EXPECT_GT(corridor.hypotheses_.best_probability(), 0.9) << k;
  }
}

TEST(PoseHypotheses, CarriedOffItBelievesSoOnceTheViewsThereAreSeenAndItsOwnAreNot) {
  Corridor corridor;
  corridor.drive(3.0);
  double way_m = 0.0;
  for (; way_m < 4.0; way_m += 0.1) {
    corridor.hypotheses_.predict({0.1, 0.0, 0.0});
    corridor.at_m_ += 0.1;
    const Pose2 truly{corridor.at_m_, 20.0, 0.0};
    const std::vector<ViewSighting> sightings = {not_seen(view_of(std::floor(corridor.at_m_))),
                                                 seen_from(truly, view_of(std::floor(corridor.at_m_), 20.0)),
                                                 seen_from(truly, view_of(std::floor(corridor.at_m_) + 1.0, 20.0))};
    corridor.hypotheses_.weigh(sightings);
    if (corridor.hypotheses_.best()->map_from_robot.y_m > 15.0 && corridor.hypotheses_.best_probability() > 0.7) break;
  }
  EXPECT_LT(way_m, 3.5);
  EXPECT_GT(way_m, 1.0);  // a few pictures may mislead
}

/// Two corridors, equally likely at first, and how well the second one is recognised beside the first.
class Twins {
 public:
  explicit Twins(int agreeing) : agreeing_(agreeing) { look(1.0); }

  void drive(double way_m, const std::function<double(double)>& of_other) {
    constexpr double kStep_m = 0.1;
    for (const double until_m = x_m_ + way_m; x_m_ < until_m - 1e-9;) {
      x_m_ += kStep_m;
      hypotheses_.predict({kStep_m, 0.0, 0.0});
      look(of_other(x_m_));
    }
  }
  [[nodiscard]] double first() const {
    double sum = 0.0;
    for (const PoseHypothesis& one : hypotheses_.all()) sum += one.map_from_robot.y_m < 10.0 ? one.weight : 0.0;
    return sum;
  }

  PoseHypotheses hypotheses_;

 private:
  void look(double of_other) {
    std::vector<ViewSighting> sightings;
    for (const double number : {std::floor(x_m_), std::floor(x_m_) + 1.0}) {
      sightings.push_back(seen_from(along(x_m_), view_of(number)));
      sightings.back().agreeing = agreeing_;
      sightings.back().share = kShare;
      sightings.push_back(seen_from({x_m_, 20.0, 0.0}, view_of(number, 20.0)));
      sightings.back().share = kShare * of_other;
      sightings.back().agreeing = static_cast<int>(agreeing_ * of_other);
    }
    for (ViewSighting& sighting : sightings) sighting.prior_share = hypotheses_.empty() ? 0.5 : 1e-5;
    hypotheses_.weigh(sightings);
  }

  static constexpr double kShare = 0.2;
  double x_m_ = 0.0;
  int agreeing_;
};

TEST(PoseHypotheses, OfTwoPlacesThatLookAlikeNowOneNowTheOtherIsRecognisedBetterAndTheyStayTwo) {
  Twins twins(60);
  twins.drive(40.0, [](double x_m) { return std::fmod(x_m, 6.0) < 3.0 ? 0.8 : 1.25; });
  EXPECT_GT(twins.first(), 0.2);
  EXPECT_LT(twins.first(), 0.8);
}

TEST(PoseHypotheses, OfTwoPlacesThatLookAlikeTheOneThatIsLastinglyRecognisedBetterIsTheRightOne) {
  Twins dark(60);
  dark.drive(12.0, [](double) { return 0.7; });
  Twins bright(300);
  bright.drive(1.0, [](double) { return 0.7; });
  EXPECT_GT(dark.first(), 0.95);
  EXPECT_GT(bright.first(), 0.95) << "the more features, the sooner";
  Twins soon(60);
  soon.drive(1.0, [](double) { return 0.7; });
  EXPECT_LT(soon.first(), 0.95);
}

TEST(PoseHypotheses, AViewIsRecognisedTheLessTheFartherItIsAndThatIsNoEvidence) {
  // Both places are recognised as well as the distance to their views lets them be.
  PoseHypotheses hypotheses;
  const auto seen = [](double y_m, double distance_m, double share) {
    ViewSighting sighting = seen_from({0.0, y_m, 0.0}, {distance_m, y_m, 0.0});
    sighting.share = share;
    sighting.agreeing = 100;
    sighting.direction->distance_m = distance_m;
    sighting.prior_share = 0.5;
    return sighting;
  };
  const double there = 0.2 / (1.4 * 1.4);
  hypotheses.weigh(std::vector<ViewSighting>{seen(0.0, 0.2, 0.2 / (1.1 * 1.1)), seen(20.0, 0.8, there)});
  double near = 0.0;
  for (const PoseHypothesis& one : hypotheses.all()) near += one.map_from_robot.y_m < 10.0 ? one.weight : 0.0;
  EXPECT_GT(near, 0.3);
  EXPECT_LT(near, 0.8);
}

TEST(PoseHypotheses, AViewBehindAWallMakesItHardlyLessProbable) {
  for (const double of_second : {1.0, 0.0}) {
    PoseHypotheses hypotheses = Corridor().hypotheses_;
    for (int k = 0; k < 30; ++k) {
      hypotheses.predict({0.1, 0.0, 0.0});
      const double x_m = 0.1 * (k + 1);
      std::vector<ViewSighting> sightings = {seen_from(along(x_m), {x_m + 0.3, 0.0, 0.0}),
                                             seen_from(along(x_m), {x_m, 0.6, 0.0}),
                                             seen_from({x_m, 20.0, 0.0}, {x_m + 0.3, 20.0, 0.0})};
      if (of_second == 0.0) sightings[1] = not_seen({x_m, 0.6, 0.0});
      sightings[2].share *= 0.5;
      sightings[2].agreeing /= 2;
      hypotheses.weigh(sightings);
    }
    EXPECT_GT(hypotheses.best_probability(), 0.95) << of_second;
    EXPECT_NEAR(hypotheses.best()->map_from_robot.y_m, 0.0, 0.3) << of_second;
  }
}

TEST(PoseHypotheses, StandingStillManyPicturesSayLittleMoreThanOne) {
  Corridor moving;
  Corridor standing;
  moving.drive(3.0);
  standing.drive(3.0);
  const auto off = [](Corridor& corridor) {
    const std::vector<ViewSighting> sightings = {not_seen(view_of(std::floor(corridor.at_m_))),
                                                 seen_from({0.0, 20.0, 0.0}, view_of(0.0, 20.0))};
    corridor.hypotheses_.weigh(sightings);
  };
  for (int k = 0; k < 6; ++k) off(standing);
  for (int k = 0; k < 6; ++k) {
    moving.hypotheses_.predict({0.3, 0.0, 0.0});
    moving.at_m_ += 0.3;
    off(moving);
  }
  EXPECT_GT(standing.hypotheses_.best_probability(), 0.9);
  EXPECT_LT(std::abs(standing.hypotheses_.best()->map_from_robot.y_m), 1.0);
}

TEST(PoseHypotheses, WhatShowsNothingKnownChangesNothing) {
  Corridor corridor;
  corridor.drive(3.0);
  const double before = corridor.hypotheses_.best_probability();
  for (int k = 0; k < 30; ++k) corridor.hypotheses_.weigh(std::vector<ViewSighting>{not_seen(along(3.4))});
  EXPECT_EQ(corridor.hypotheses_.best_probability(), before);
}

TEST(PoseHypotheses, ALocalMapPlacesItToCentimetresAndOnlyWhereThatCanBe) {
  Corridor corridor;
  corridor.drive(3.0);
  ViewSighting sighting;
  sighting.map_from_view = along(3.6);
  sighting.spread_m = 0.02;
  sighting.pose =
      SightedPose{inverse(Pose2{3.08, 0.05, 0.02}) * sighting.map_from_view, 1e-4 * Eigen::Matrix2d::Identity()};
  ASSERT_TRUE(corridor.hypotheses_.agrees(sighting));
  for (int k = 0; k < 60; ++k) corridor.hypotheses_.refine(sighting);
  EXPECT_NEAR(corridor.hypotheses_.best()->map_from_robot.x_m, 3.08, 0.03);
  EXPECT_NEAR(corridor.hypotheses_.best()->map_from_robot.y_m, 0.05, 0.03);
  sighting.pose->robot_from_view = inverse(Pose2{6.0, 0.0, 0.0}) * sighting.map_from_view;
  EXPECT_FALSE(corridor.hypotheses_.agrees(sighting));
  corridor.hypotheses_.refine(sighting);
  EXPECT_NEAR(corridor.hypotheses_.best()->map_from_robot.x_m, 3.08, 0.03);
}

TEST(PoseHypotheses, TheProbabilityOfBeingThereGrowsWithTheRadius) {
  Corridor corridor;
  corridor.drive(2.0);
  const Eigen::Vector2d here_m(2.0, 0.0);
  double before = 0.0;
  for (const double radius_m : {0.01, 0.05, 0.2, 1.0, 5.0}) {
    const double probability = corridor.hypotheses_.probability_within(here_m, radius_m);
    EXPECT_GE(probability, before);
    EXPECT_LE(probability, 1.0 + 1e-12);
    before = probability;
  }
  EXPECT_GT(before, 0.95);
}

/// Sees `here` and another view that look alike; how probable it is to be within half a metre of the robot's true
/// place.
class WeighWithin : public ::testing::Test {
 protected:
  void look(double prior_here, double prior_there) {
    std::vector<ViewSighting> sightings = {seen_from(along(0.0), along(1.0)), seen_from(along(30.0), along(31.0))};
    sightings[0].prior_share = prior_here;
    sightings[1].prior_share = prior_there;
    hypotheses_.weigh(sightings);
  }
  [[nodiscard]] double here() const { return hypotheses_.probability_within({0.0, 0.0}, kRadius_m); }
  void answer(double odds) { hypotheses_.weigh_within({0.0, 0.0}, kRadius_m, odds); }
  static double with_odds(double probability, double odds) {
    return probability * odds / (probability * odds + 1.0 - probability);
  }

  static constexpr double kRadius_m = 2.5;  // it is known to half the distance of what it sees
  PoseHypotheses hypotheses_;
};

TEST_F(WeighWithin, MultipliesTheOddsByAFactor) {
  look(0.5, 0.5);
  const double before = here();
  ASSERT_GT(before, 0.2);
  ASSERT_LT(before, 0.6);
  answer(19.0);
  EXPECT_NEAR(here(), with_odds(before, 19.0), 0.02);
  answer(1.0 / 19.0);
  EXPECT_NEAR(here(), before, 0.05) << "the contrary takes it back";
}

TEST_F(WeighWithin, MakesNoArrivalOfWhatIsImprobable) {
  look(0.001, 0.999);
  const double before = here();
  ASSERT_LT(before, 0.002);
  answer(19.0);
  EXPECT_GT(here(), before);
  EXPECT_LT(here(), 0.04);
}

TEST_F(WeighWithin, OfBeingElsewhereCountsTheSame) {
  look(0.3, 1e-6);
  const double elsewhere = hypotheses_.elsewhere();
  ASSERT_GT(elsewhere, 0.001);
  answer(1.0 / 19.0);
  EXPECT_GT(hypotheses_.elsewhere(), 5.0 * elsewhere);
}

TEST_F(WeighWithin, PlacesARobotThatKnewItRoughly) {
  look(1.0, 1e-6);
  hypotheses_.predict({0.0, 0.0, 0.0});
  const double rough = hypotheses_.probability_within({0.0, 0.0}, 0.5);
  hypotheses_.weigh_within({0.0, 0.0}, 0.5, 19.0);
  EXPECT_GT(hypotheses_.probability_within({0.0, 0.0}, 0.5), rough);
  EXPECT_GT(hypotheses_.probability_within({0.0, 0.0}, 0.5), 0.9);
}

TEST_F(WeighWithin, SaysNothingToARobotThatKnowsNothing) {
  answer(19.0);
  EXPECT_TRUE(hypotheses_.empty());
  EXPECT_NEAR(hypotheses_.elsewhere(), 1.0, 1e-12);
}

TEST(PoseHypotheses, WeightsAreProbabilities) {
  Corridor corridor;
  corridor.drive(2.5);
  double sum = corridor.hypotheses_.elsewhere();
  for (const PoseHypothesis& one : corridor.hypotheses_.all()) sum += one.weight;
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

/// As probable here as 20 m away.
PoseHypotheses undecided() {
  PoseHypotheses hypotheses;
  ViewSighting here = seen_from(along(1.0), view_of(1.0));
  here.prior_share = 0.5;
  ViewSighting twin = seen_from(along(1.0), view_of(1.0, 20.0));
  twin.map_from_view.y_m = view_of(1.0).y_m + 20.0;
  twin.direction = here.direction;
  twin.prior_share = 0.5;
  hypotheses.weigh(std::vector<ViewSighting>{here, twin});
  return hypotheses;
}

TEST(PoseHypotheses, AnothersWordMakesNothingMoreProbableThanHeIsSureOfIt) {
  PoseHypotheses hypotheses = undecided();
  const Eigen::Vector2d there_m(1.0, 20.0);
  for (int k = 0; k < 5; ++k) hypotheses.apply_odds(there_m, 3.0, 3.0, 0.84);
  double there = 0.0;
  for (const PoseHypothesis& one : hypotheses.all()) there += one.map_from_robot.y_m > 10.0 ? one.weight : 0.0;
  EXPECT_NEAR(there, 0.84, 1e-6);
  hypotheses.apply_odds(there_m, 3.0, 3.0, 0.6);
  EXPECT_NEAR(hypotheses.best_probability(), there, 0.05) << "and nothing less probable";
}

TEST(PoseHypotheses, AnothersWordMovesTheWeightsByItsOdds) {
  PoseHypotheses hypotheses = undecided();
  const Eigen::Vector2d here_m(1.0, 0.0);
  const Eigen::Vector2d there_m(1.0, 20.0);
  const double before = hypotheses.probability_within(there_m, 3.0);
  ASSERT_NEAR(before, 0.5, 0.1);
  hypotheses.apply_odds(there_m, 3.0, 3.0, 1.0);
  const double odds = hypotheses.probability_within(there_m, 3.0) / hypotheses.probability_within(here_m, 3.0);
  EXPECT_NEAR(odds, 3.0 * before / (1.0 - before), 0.3);
}

TEST(PoseHypotheses, AWordOfAPlaceThatNobodyThoughtOfMakesItLessSure) {
  Corridor corridor;
  corridor.drive(3.0);
  PoseHypotheses hypotheses = corridor.hypotheses_;
  const double before = hypotheses.best_probability();
  const double elsewhere = hypotheses.elsewhere();
  hypotheses.apply_odds(std::nullopt, 2.0, 3.0, 1.0);
  EXPECT_LT(hypotheses.best_probability(), before);
  EXPECT_GT(hypotheses.elsewhere(), elsewhere);
}

}  // namespace
}  // namespace homeward::driving::pose_hypotheses_test
