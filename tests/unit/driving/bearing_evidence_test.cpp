// SPDX-License-Identifier: Apache-2.0
#include "driving/bearing_evidence.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/angles.hpp"

namespace homeward::driving::bearing_evidence_test {
namespace {

const Pose2 kView{5.0, 1.0, 0.8};

homing::HomeVector answer_from(const Pose2& robot, const Pose2& view = kView, double confidence = 0.5) {
  homing::HomeVector answer;
  answer.bearing_rad = wrap_angle(std::atan2(view.y_m - robot.y_m, view.x_m - robot.x_m) - robot.theta_rad);
  answer.turn_rad = wrap_angle(view.theta_rad - robot.theta_rad);
  answer.confidence = confidence;
  return answer;
}

homing::HomeVector turned_round(homing::HomeVector answer) {
  answer.bearing_rad = wrap_angle(answer.bearing_rad + kPi);
  return answer;
}

/// One answer every 5 cm along x, of which those that `wrong` names are turned round.
BearingEvidence drive(double way_m, double guess_m, const std::function<bool(int)>& wrong) {
  BearingEvidence evidence;
  for (int k = 0; 0.05 * k <= way_m; ++k) {
    const Pose2 robot{0.05 * k, 0.0, 0.1 * k};
    const homing::HomeVector right = answer_from(robot);
    evidence.add(robot, wrong(k) ? turned_round(right) : right, true, guess_m);
  }
  return evidence;
}

double direction_off_rad(const TriangulatedView& view, const Pose2& robot) {
  const double said_rad = std::atan2(view.position_m.y() - robot.y_m, view.position_m.x() - robot.x_m);
  return std::abs(wrap_angle(said_rad - std::atan2(kView.y_m - robot.y_m, kView.x_m - robot.x_m)));
}

TEST(BearingEvidence, WithoutBearingsThereIsNoView) {
  const BearingEvidence evidence;
  EXPECT_TRUE(evidence.empty());
  EXPECT_FALSE(evidence.best());
}

TEST(BearingEvidence, OneHintIsTooLittleAndACertainAnswerIsNot) {
  const Pose2 robot{0.5, 0.2, 2.0};
  BearingEvidence evidence;
  evidence.add(robot, answer_from(robot), false, 5.0);
  EXPECT_FALSE(evidence.empty());
  EXPECT_FALSE(evidence.best());
  evidence.add(robot, answer_from(robot, kView, 0.95), true, 5.0);
  const auto view = evidence.best();
  ASSERT_TRUE(view);
  EXPECT_LT(direction_off_rad(*view, robot), 1e-3);
  EXPECT_NEAR(view->heading_rad, kView.theta_rad, 1e-6);
  // From one spot the distance stays a guess.
  EXPECT_GT(std::sqrt(view->covariance_m2.trace()), 1.5);
  EXPECT_TRUE(BearingEvidence::agrees(*view, robot, answer_from(robot)));
  EXPECT_FALSE(BearingEvidence::agrees(*view, robot, turned_round(answer_from(robot))));
}

TEST(BearingEvidence, HintsThatAgreeAreFollowedAndDividedOnesAreNot) {
  const Pose2 robot{};
  BearingEvidence agreeing;
  BearingEvidence divided;
  for (int k = 0; k < 12; ++k) {
    const homing::HomeVector scattered = answer_from(robot, {3.0 * std::cos(k), 3.0 * std::sin(k), 2.0 * k});
    agreeing.add(robot, k % 2 == 0 ? answer_from(robot) : scattered, false, 5.0);
    divided.add(robot, answer_from(robot, k % 2 == 0 ? kView : Pose2{-4.0, 2.0, -1.0}), false, 5.0);
  }
  const auto view = agreeing.best();
  ASSERT_TRUE(view);
  EXPECT_LT(direction_off_rad(*view, robot), 0.02);
  EXPECT_FALSE(divided.best());
}

TEST(BearingEvidence, DividedOnesSayTheLikeliestWhereAskedAndTheOthersWithoutIt) {
  const Pose2 robot{};
  const Pose2 other{-4.0, 2.0, -1.0};
  BearingEvidence evidence;
  EXPECT_FALSE(evidence.best(true));
  for (int k = 0; k < 12; ++k) evidence.add(robot, answer_from(robot, k % 12 < 7 ? kView : other), false, 5.0);
  ASSERT_FALSE(evidence.best());
  const auto likeliest = evidence.best(true);
  ASSERT_TRUE(likeliest);
  EXPECT_LT(direction_off_rad(*likeliest, robot), 0.02);
  const auto then = evidence.without(*likeliest).best(true);
  ASSERT_TRUE(then);
  EXPECT_NEAR(then->heading_rad, other.theta_rad, 0.02);
  EXPECT_TRUE(evidence.without(*likeliest).without(*then).empty());
}

TEST(BearingEvidence, BearingsAlongTheWayMeetInTheView) {
  const Pose2 aside{2.0, 3.0, -0.5};
  BearingEvidence evidence;
  double doubt_m = 0.0;
  for (int k = 0; k <= 60; ++k) {
    const Pose2 robot{0.05 * k, 0.0, 0.1 * k};
    evidence.add(robot, answer_from(robot, aside), true, 6.0);
    if (k == 10) doubt_m = std::sqrt(evidence.best()->covariance_m2.trace());
  }
  const auto view = evidence.best();
  ASSERT_TRUE(view);
  EXPECT_LT((view->position_m - Eigen::Vector2d(aside.x_m, aside.y_m)).norm(), 0.5);
  EXPECT_LT(std::sqrt(view->covariance_m2.trace()), 0.7 * doubt_m);
}

TEST(BearingEvidence, AnswersTurnedRoundInARowMoveNothing) {
  // A metre of right answers, then half a metre of wrong ones.
  const auto view = drive(1.5, 5.0, [](int k) { return k > 20; }).best();
  ASSERT_TRUE(view);
  EXPECT_LT(direction_off_rad(*view, {1.5, 0.0, 0.0}), 0.1);
}

TEST(BearingEvidence, AViewOfWhichSoLittleIsSeenIsNotNear) {
  // Ahead at first, then behind: passed at 1 m, or turned round from there on.
  const auto passed_at_1_m = [](double guess_m) {
    BearingEvidence evidence;
    for (int k = 0; k <= 40; ++k) {
      const Pose2 robot{0.05 * k, 0.0, 0.0};
      const homing::HomeVector ahead = answer_from(robot, {9.0, 0.0, 0.0});
      evidence.add(robot, k < 20 ? ahead : turned_round(ahead), true, guess_m);
    }
    return evidence.best();
  };
  const auto near = passed_at_1_m(0.5);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->position_m.x(), 1.0, 0.5);
  const auto far = passed_at_1_m(5.0);
  EXPECT_FALSE(far && std::abs(far->position_m.x() - 1.0) < 1.5);
}

TEST(BearingEvidence, PicturesFromOneSpotAreNoCrowd) {
  const Pose2 robot{};
  BearingEvidence evidence;
  for (int k = 0; k < 500; ++k) evidence.add(robot, answer_from(robot, kView, 1.0), true, 5.0);
  const auto standing = evidence.best();
  ASSERT_TRUE(standing);
  EXPECT_LE(standing->support, 12.0 * 1.5 + 1e-9);
  // Half a metre of other answers outweighs them.
  for (int k = 3; k < 23; ++k) {
    const Pose2 at{0.0, -0.05 * k, 0.0};
    for (int n = 0; n < 3; ++n) evidence.add(at, answer_from(at, {-5.0, 0.0, 2.5}, 1.0), true, 5.0);
  }
  const auto driven = evidence.best();
  ASSERT_TRUE(driven);
  EXPECT_LT(driven->position_m.x(), 0.0);
}

}  // namespace
}  // namespace homeward::driving::bearing_evidence_test
