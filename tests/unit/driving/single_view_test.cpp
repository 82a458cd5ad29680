// SPDX-License-Identifier: Apache-2.0
#include "driving/single_view.hpp"

#include <gtest/gtest.h>

#include "driving/follow.hpp"
#include "support/far_seen.hpp"
#include "support/landmarks.hpp"

namespace homeward::driving::single_view_test {
namespace {

using homeward::testing::FarSeen;
using homeward::testing::Landmarks;
using homeward::testing::together;

TEST(SingleView, AFewThingsFarOffAreNoSignOfBeingThere) {
  const std::vector<Pose2> ends = {{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}};
  // Everything near looks otherwise from the other end.
  const Landmarks near = homeward::testing::landmarks_around(ends, 800, 8);
  for (const int shared : {30, 65}) {
    const Landmarks far = homeward::testing::landmarks_around(ends, shared, 7, 25.0, 60.0);
    const VisualPath path = {{together(seen_from(far, ends[1], 1), seen_from(near, ends[1], 2, 1.0))}, {std::nullopt}};
    FollowState state;
    int answered = 0;
    for (std::uint64_t k = 0; k < 60; ++k) {
      const Pose2 pose{0.05 * static_cast<double>(k), 0.0, 0.0};
      const auto seen = together(seen_from(far, pose, 100 + k), seen_from(near, pose, 200 + k, 1.0));
      const FollowResult followed = follow(state, path, seen, {}, pose, {}, k);
      EXPECT_FALSE(followed.at_end) << shared << " " << k;
      answered += followed.answered ? 1 : 0;
      const auto goal_m = goal(state, pose, {});
      if (!goal_m) continue;
      EXPECT_GT(goal_m->norm(), 0.6) << shared << " " << k;
    }
    EXPECT_GT(answered, 0) << shared;
  }
}

TEST(SingleView, ABearingOfFewFeaturesLeadsTheRightWayAndClaimsNoDistance) {
  const FarSeen far(25);
  const VisualPath path = {{far.from(far.target, 1)}, {std::nullopt}};
  FollowState state;
  int led = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const Pose2 pose{0.1 * static_cast<double>(k), 0.0, 0.3};
    const FollowResult followed = follow(state, path, far.from(pose, 100 + 2 * k), {}, pose, {}, k);
    EXPECT_FALSE(followed.at_end) << k;
    EXPECT_FALSE(state.measured) << k;
    const auto goal_m = goal(state, pose, {});
    if (!goal_m) continue;
    ++led;
    EXPECT_NEAR(std::atan2(goal_m->y(), goal_m->x()), -0.3, 0.15) << k;
    EXPECT_GT(goal_m->norm(), 1.5) << k;
  }
  EXPECT_GT(led, 15);
}

TEST(SingleView, AMapOfFewFeaturesDoesNotTurnItRoundOnAWayThatManyBearingsAgreeOn) {
  const FarSeen far(25);
  const Landmarks others = homeward::testing::landmarks_around({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, 30, 9, 2.0, 8.0);
  const VisualPath path = {{together(far.from(far.target, 1), seen_from(others, far.target, 3))}, {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  Pose2 pose;
  for (std::uint64_t k = 0; k < 20; ++k) {
    pose = {0.1 * static_cast<double>(k), 0.0, 0.0};
    const auto seen = together(far.from(pose, 100 + 2 * k), seen_from(others, pose, 200 + k, 1.0));
    follow(state, path, seen, {}, pose, config, k);
  }
  ASSERT_TRUE(goal(state, pose, config));
  // Now some things look as these few would from the far side of the view.
  const Pose2 beyond{far.target.x_m + 2.0, 0.0, 0.0};
  for (std::uint64_t k = 0; k < 8; ++k) {
    const auto seen = together(far.from(pose, 300 + 2 * k), seen_from(others, beyond, 400 + k));
    follow(state, path, seen, {}, pose, config, 100 + k);
    const auto goal_m = goal(state, pose, config);
    ASSERT_TRUE(goal_m) << k;
    EXPECT_GT(goal_m->x(), 0.0) << k;
  }
}

TEST(SingleView, AWayFollowedInVainIsGivenUpForAnotherThatFewerBearingsSay) {
  const std::vector<Pose2> around = {{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}};
  const Pose2 target{6.0, 0.0, 1.0};
  const Landmarks right = homeward::testing::landmarks_around(around, 25, 7, 6.0, 14.0);
  const Landmarks wrong = homeward::testing::landmarks_around(around, 25, 9, 6.0, 14.0);
  const Landmarks near = homeward::testing::landmarks_around(around, 600, 8);
  const auto look = [&](const Pose2& pose, bool of_right, bool of_wrong, std::uint64_t seed) {
    // What is wrong looks as if the target were at the opposite end.
    const Pose2 mirrored{2.0 * target.x_m - pose.x_m, 0.0, pose.theta_rad};
    return together(together(seen_from(right, pose, seed, of_right ? 0.0 : 1.0),
                             seen_from(wrong, mirrored, seed + 1, of_wrong ? 0.0 : 1.0)),
                    seen_from(near, pose, seed + 2, 1.0));
  };
  const VisualPath path = {
      {together(together(seen_from(right, target, 1), seen_from(wrong, target, 2)), seen_from(near, target, 3, 1.0))},
      {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  std::uint64_t k = 0;
  for (; k < 4; ++k) follow(state, path, look({}, true, false, 100 + 10 * k), {}, {}, config, k);
  const auto first_m = goal(state, {}, config);
  ASSERT_TRUE(first_m);
  for (; k < 14; ++k) follow(state, path, look({}, false, true, 100 + 10 * k), {}, {}, config, k);
  const auto misled_m = goal(state, {}, config);
  ASSERT_TRUE(misled_m);
  ASSERT_LT(misled_m->normalized().dot(first_m->normalized()), 0.5);
  // There nothing of it is seen.
  Pose2 pose;
  for (int step = 1; step <= 18; ++step, ++k) {
    const Eigen::Vector2d at_m = 0.1 * step * misled_m->normalized();
    pose = {at_m.x(), at_m.y(), 0.0};
    follow(state, path, look(pose, false, false, 100 + 10 * k), {}, pose, config, k);
  }
  const auto other_m = goal(state, pose, config);
  ASSERT_TRUE(other_m);
  EXPECT_GT(other_m->normalized().dot(first_m->normalized()), 0.8);
  EXPECT_TRUE(is_unsure(state));
}

TEST(SingleView, OnHintsItDrivesNoFartherThanByOdometryAlone) {
  const FarSeen far(6);  // too few for an answer
  const VisualPath path = {{far.from(far.target, 1)}, {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  int led = 0;
  for (std::uint64_t k = 0; k < 30; ++k) {
    const Pose2 pose{0.1 * static_cast<double>(k), 0.0, 0.0};
    const FollowResult followed = follow(state, path, far.from(pose, 100 + 2 * k), {}, pose, config, k);
    led += followed.answered ? 1 : 0;
    if (pose.x_m <= config.blind_m) continue;
    EXPECT_FALSE(followed.answered) << k;
    EXPECT_FALSE(goal(state, pose, config)) << k;
  }
  EXPECT_GT(led, 0);
}

TEST(SingleView, AViewSeenWellBeforeIsReachedWhenTheCameraWasCoveredBetween) {
  const Pose2 target{2.5, 2.0, kPi / 2.0};
  const Landmarks landmarks = homeward::testing::landmarks_around({{0.8, 0.0, 0.0}, target}, 160, 5);
  const VisualPath path = {{seen_from(landmarks, target, 1)}, {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  bool at_end = false;
  const Pose2 from = target * Pose2{-1.2, 0.0, 0.0};
  for (std::uint64_t k = 0; k < 60 && !at_end; ++k) {
    // A metre on, and then the last bit.
    const double way_m = std::min(1.2, 0.04 * static_cast<double>(k));
    const Pose2 pose = from * Pose2{way_m, 0.0, 0.0};
    const bool covered = way_m > 0.5 && way_m < 0.9;
    const auto seen = covered ? features::Appearance{} : seen_from(landmarks, pose, 100 + k);
    const FollowResult followed = follow(state, path, seen, {}, pose, config, k);
    EXPECT_NE(followed.answered, covered) << k;
    at_end = followed.at_end;
    EXPECT_FALSE(at_end && way_m < 1.1) << k;
    EXPECT_TRUE(!covered || state.most_alike >= homing::VisualHoming::kLeastShare) << k;
  }
  EXPECT_TRUE(at_end);
}

TEST(SingleView, AHandfulOfFeaturesDoesNotTurnAKnownViewRound) {
  const std::vector<Pose2> around = {{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}};
  const Pose2 target{3.0, 0.0, 0.5};
  const Landmarks few = homeward::testing::landmarks_around(around, 12, 7);
  const Landmarks others = homeward::testing::landmarks_around(around, 280, 8);
  const VisualPath path = {{together(seen_from(few, target, 1), seen_from(others, target, 2))}, {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  Pose2 pose;
  for (std::uint64_t k = 0; k < 12; ++k) {
    pose = {0.08 * static_cast<double>(k), 0.0, 0.0};
    const auto seen = together(seen_from(few, pose, 100 + k, 1.0), seen_from(others, pose, 200 + k));
    ASSERT_TRUE(follow(state, path, seen, {}, pose, config, k).answered) << k;
  }
  ASSERT_TRUE(state.measured);
  EXPECT_FALSE(is_unsure(state));
  // Now something else looks as these few would from the far side of the view; the rest is hidden.
  const Pose2 beyond{2.0 * target.x_m - pose.x_m, 0.0, 0.0};
  for (std::uint64_t k = 0; k < 12; ++k) {
    const auto seen = together(seen_from(few, beyond, 300 + k), seen_from(others, pose, 400 + k, 1.0));
    follow(state, path, seen, {}, pose, config, 100 + k);
    const auto goal_m = goal(state, pose, config);
    ASSERT_TRUE(goal_m) << k;
    EXPECT_NEAR(goal_m->x(), target.x_m - pose.x_m, 0.5) << k;
    EXPECT_NEAR(goal_m->y(), 0.0, 0.3) << k;
  }
}

}  // namespace
}  // namespace homeward::driving::single_view_test
