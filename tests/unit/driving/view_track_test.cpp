// SPDX-License-Identifier: Apache-2.0
#include "driving/view_track.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"

namespace homeward::driving::view_track_test {
namespace {

const Eigen::Vector2d kView(2.0, 1.0);

homing::HomeVector answer_from(const Pose2& robot, double parallax_rad = 0.2, double confidence = 0.95) {
  homing::HomeVector answer;
  answer.bearing_rad = wrap_angle(std::atan2(kView.y() - robot.y_m, kView.x() - robot.x_m) - robot.theta_rad);
  answer.turn_rad = wrap_angle(0.5 - robot.theta_rad);
  answer.median_parallax_rad = parallax_rad;
  answer.inliers = 60;
  answer.confidence = confidence;
  return answer;
}

TEST(ViewTrack, KnowsNothingBeforeItsFirstAnswer) {
  ViewTrack track;
  EXPECT_FALSE(track.known());
  const Pose2 robot{0.5, 0.0, 0.3};
  EXPECT_TRUE(track.observe(robot, answer_from(robot), {}));
  ASSERT_TRUE(track.known());
  // The direction is right at once, the distance is a guess and says so.
  const Eigen::Vector2d to = track.position_m() - Eigen::Vector2d(robot.x_m, robot.y_m);
  const Eigen::Vector2d truth = kView - Eigen::Vector2d(robot.x_m, robot.y_m);
  EXPECT_NEAR(std::atan2(to.y(), to.x()), std::atan2(truth.y(), truth.x()), 1e-9);
  EXPECT_GT(track.doubt_m(), 0.5);
  EXPECT_NEAR(track.heading_rad(), 0.5, 1e-9);
}

TEST(ViewTrack, TriangulatesFromBearingsAlongTheWay) {
  ViewTrack track;
  for (int k = 0; k <= 12; ++k) {
    const Pose2 robot{0.1 * k, 0.0, 0.2 * k};
    EXPECT_TRUE(track.observe(robot, answer_from(robot), {}));
    track.drift(0.1, {});
  }
  EXPECT_LT((track.position_m() - kView).norm(), 0.25);
  EXPECT_LT(track.doubt_m(), 0.5);
  EXPECT_NEAR(track.heading_rad(), 0.5, 1e-6);
}

TEST(ViewTrack, PassesOverOneWrongAnswerAndYieldsToThree) {
  ViewTrack track;
  for (int k = 0; k <= 12; ++k) {
    const Pose2 robot{0.1 * k, 0.0, 0.0};
    track.observe(robot, answer_from(robot), {});
  }
  const Eigen::Vector2d before = track.position_m();
  const Pose2 robot{1.2, 0.0, 0.0};
  homing::HomeVector wrong = answer_from(robot);
  wrong.bearing_rad = wrap_angle(wrong.bearing_rad + kPi);
  EXPECT_FALSE(track.observe(robot, wrong, {}));
  EXPECT_EQ(track.position_m(), before);
  EXPECT_TRUE(track.observe(robot, answer_from(robot), {}));  // a right one in between forgives
  EXPECT_FALSE(track.observe(robot, wrong, {}));
  EXPECT_FALSE(track.observe(robot, wrong, {}));
  EXPECT_TRUE(track.observe(robot, wrong, {}));
  EXPECT_LT((track.position_m() - Eigen::Vector2d(1.2, 0.0)).dot(kView - Eigen::Vector2d(1.2, 0.0)), 0.0);
}

TEST(ViewTrack, DoubtGrowsWithTheWayDriven) {
  ViewTrack track;
  const ViewTrackConfig config;
  track.settle({1.0, 0.0}, Eigen::Matrix2d::Identity() * 1e-6, 0.0);
  track.drift(10.0, config);
  EXPECT_NEAR(track.doubt_m(), 10.0 * config.drift_per_m, 1e-3);
}

}  // namespace
}  // namespace homeward::driving::view_track_test
