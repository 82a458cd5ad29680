// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/follow.hpp"

#include <gtest/gtest.h>

#include "support/landmarks.hpp"

namespace homeward::agent {
namespace {

using homeward::testing::Landmarks;

// Five views round a corner to the left; the robot starts a little behind the first.
const std::vector<Pose2> kViews = {
    {0.8, 0.0, 0.0}, {1.6, 0.1, 0.3}, {2.2, 0.5, 0.9}, {2.5, 1.2, 1.4}, {2.5, 2.0, kPi / 2.0}};

Landmarks corner() { return homeward::testing::landmarks_around(kViews, 160, 5); }

VisualPath path_through(const Landmarks& landmarks, bool with_edges) {
  VisualPath path;
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    path.views.push_back(seen_from(landmarks, kViews[i], 100 + i));
    std::optional<wire::PathEdge> edge;
    if (with_edges && i + 1 < kViews.size()) {
      const Pose2 next = inverse(kViews[i]) * kViews[i + 1];
      edge = wire::PathEdge{std::atan2(next.y_m, next.x_m), next.theta_rad, std::hypot(next.x_m, next.y_m), false};
    }
    path.edges.push_back(edge);
  }
  return path;
}

struct Drive {
  bool at_end = false;
  double error_m = 1e9;
  double way_m = 0.0;
  std::vector<int> indices;  // of the views homed to, in order
};

/// Drives towards the goal at each picture, ten a second, until the destination's view is reached.
Drive drive(const Landmarks& landmarks, const VisualPath& path, double foreign_share, const Pose2& start) {
  Drive result;
  FollowState state;
  const FollowConfig config;
  Pose2 pose = start;
  const Pose2 odometry_from_world = Pose2{3.0, -1.0, 2.0} * inverse(start);  // odometry starts anywhere
  for (std::uint64_t k = 1; k <= 400; ++k) {
    const auto seen = seen_from(landmarks, pose, 1000 + k, foreign_share);
    const Pose2 odometry = odometry_from_world * pose;
    const FollowResult followed = follow(state, path, seen, {}, odometry, config, k);
    if (result.indices.empty() || result.indices.back() != state.index) result.indices.push_back(state.index);
    if (followed.at_end) {
      result.at_end = true;
      break;
    }
    const auto to = goal(state, odometry, config);
    if (!to) continue;
    constexpr double kStep_s = 0.1;
    const double angle_rad = std::atan2(to->y(), to->x());
    const double speed_mps = std::abs(angle_rad) > 0.9 ? 0.0 : std::clamp(0.6 * to->norm(), 0.15, 0.5);
    const double turn_rad = std::clamp(1.8 * angle_rad, -1.0, 1.0) * kStep_s;
    pose = pose * Pose2{speed_mps * kStep_s, 0.0, turn_rad};
    result.way_m += speed_mps * kStep_s;
  }
  result.error_m = std::hypot(pose.x_m - kViews.back().x_m, pose.y_m - kViews.back().y_m);
  return result;
}

TEST(Follow, PassesViewAfterViewRoundACornerAndEndsAtTheLast) {
  const Landmarks landmarks = corner();
  for (const bool with_edges : {true, false}) {
    const Drive driven = drive(landmarks, path_through(landmarks, with_edges), 0.0, {0.0, 0.0, 0.0});
    EXPECT_TRUE(driven.at_end) << "edges " << with_edges;
    EXPECT_LT(driven.error_m, 0.2) << "edges " << with_edges;
    EXPECT_LT(driven.way_m, 5.0) << "edges " << with_edges;
    EXPECT_TRUE(std::is_sorted(driven.indices.begin(), driven.indices.end()));
    EXPECT_EQ(driven.indices.back(), 4);
  }
}

TEST(Follow, StandsThirtyPercentOfForeignFeatures) {
  const Landmarks landmarks = corner();
  const Drive driven = drive(landmarks, path_through(landmarks, true), 0.3, {0.0, 0.0, 0.2});
  EXPECT_TRUE(driven.at_end);
  EXPECT_LT(driven.error_m, 0.2);
}

TEST(Follow, TurnsRoundWhenTheFirstViewLiesBehind) {
  const Landmarks landmarks = corner();
  const Drive driven = drive(landmarks, path_through(landmarks, true), 0.0, {0.0, 0.1, 2.8});
  EXPECT_TRUE(driven.at_end);
  EXPECT_LT(driven.error_m, 0.2);
}

TEST(Follow, SkipsAViewThatIsNotToBeSeenWhenALaterOneIs) {
  const Landmarks landmarks = corner();
  VisualPath path = path_through(landmarks, false);
  path.views[0] = seen_from(homeward::testing::landmarks_around(kViews, 160, 77), kViews[0], 1);
  FollowState state;
  follow(state, path, seen_from(landmarks, {}, 1), {}, {}, {}, 1);
  EXPECT_GE(state.index, 1);
  const Drive driven = drive(landmarks, path, 0.0, {0.0, 0.0, 0.0});
  EXPECT_TRUE(driven.at_end);
  EXPECT_LT(driven.error_m, 0.2);
}

TEST(Follow, AForeignPictureSaysNothingAndMovesNothing) {
  const Landmarks landmarks = corner();
  const VisualPath path = path_through(landmarks, true);
  const Landmarks elsewhere = homeward::testing::landmarks_around(kViews, 160, 77);
  FollowState state;
  const FollowResult result = follow(state, path, seen_from(elsewhere, {}, 1), {}, {}, {}, 1);
  EXPECT_FALSE(result.answered);
  EXPECT_FALSE(result.at_end);
  EXPECT_FALSE(result.vector);
  EXPECT_EQ(state.index, 0);
  EXPECT_FALSE(goal(state, {}, {}));
}

TEST(Follow, AViewOfThePathIsTrustedMoreThanOneMetAnywhere) {
  const Landmarks landmarks = corner();
  const VisualPath path = path_through(landmarks, true);
  const auto seen = seen_from(landmarks, {0.0, 0.0, 0.2}, 1, 0.3);
  const auto odds = [&](double path_odds) {
    FollowConfig config;
    config.believe = 0.0;
    config.pass_m = 0.0;  // or the vector would be of a view that is left already
    config.path_odds = path_odds;
    FollowState state;
    const auto vector = follow(state, path, seen, {}, {}, config, 1).vector;
    return vector ? vector->confidence / (1.0 - vector->confidence) : -1.0;
  };
  const double met_anywhere = odds(1.0);
  ASSERT_GT(met_anywhere, 0.0);
  EXPECT_NEAR(odds(4.0) / met_anywhere, 4.0, 1e-6);
}

TEST(Follow, DrivesOnBlindlyOnlySoFar) {
  const Landmarks landmarks = corner();
  const VisualPath path = path_through(landmarks, true);
  const FollowConfig config;
  FollowState state;
  follow(state, path, seen_from(landmarks, {}, 1), {}, {}, config, 1);
  ASSERT_TRUE(goal(state, {}, config));
  EXPECT_TRUE(goal(state, {0.9 * config.blind_m, 0.0, 0.0}, config));
  EXPECT_FALSE(goal(state, {1.1 * config.blind_m, 0.0, 0.0}, config));
  // Way counts from picture to picture, there and back too.
  const features::Appearance dark;
  for (int k = 0; k < 4; ++k) {
    const Pose2 odometry{k % 2 == 0 ? 0.45 : 0.0, 0.0, 0.0};
    EXPECT_FALSE(follow(state, path, dark, {}, odometry, config, 2).answered);
  }
  EXPECT_FALSE(goal(state, {0.0, 0.0, 0.0}, config));
}

TEST(Follow, UnclearAnswersLeaveViewsFurtherOnWhereTheMapSaysTheyAre) {
  const Landmarks landmarks = corner();
  const VisualPath path = path_through(landmarks, true);
  FollowConfig config;
  config.sure_inliers = 100'000;  // no answer is clear
  FollowState state;
  const FollowResult followed = follow(state, path, seen_from(landmarks, {}, 1), {}, {}, config, 1);
  EXPECT_TRUE(followed.answered);
  ASSERT_TRUE(state.tracks[1].known());
  const Pose2 first{state.tracks[0].position_m().x(), state.tracks[0].position_m().y(), state.tracks[0].heading_rad()};
  const auto& edge = *path.edges[0];
  const Pose2 expected =
      first * Pose2{*edge.length_m * std::cos(*edge.bearing_rad), *edge.length_m * std::sin(*edge.bearing_rad), 0.0};
  EXPECT_LT((state.tracks[1].position_m() - Eigen::Vector2d(expected.x_m, expected.y_m)).norm(), 1e-9);
}

/// Features of both.
features::Appearance together(const features::Appearance& a, const features::Appearance& b) {
  features::Appearance both;
  const auto under = [](const auto& first, const auto& second, auto& result) {
    result.resize(first.rows() + second.rows(), first.cols());
    result << first, second;
  };
  under(a.sift.bearings, b.sift.bearings, both.sift.bearings);
  under(a.sift.scales_rad, b.sift.scales_rad, both.sift.scales_rad);
  under(a.sift.descriptors, b.sift.descriptors, both.sift.descriptors);
  under(a.sift.colours, b.sift.colours, both.sift.colours);
  return both;
}

TEST(Follow, AFewThingsFarOffAreNoSignOfBeingThere) {
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

/// What is seen from `pose` of a target of which only things far off are the same from here, and the target's view.
struct FarSeen {
  Landmarks far;
  Landmarks near;
  Pose2 target{6.0, 0.0, 1.0};

  explicit FarSeen(int shared)
      : far(homeward::testing::landmarks_around({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, shared, 7, 6.0, 14.0)),
        near(homeward::testing::landmarks_around({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, 600, 8)) {}
  [[nodiscard]] features::Appearance from(const Pose2& pose, std::uint64_t seed) const {
    return together(seen_from(far, pose, seed), seen_from(near, pose, seed + 1, 1.0));
  }
};

TEST(Follow, ABearingOfFewFeaturesLeadsTheRightWayAndClaimsNoDistance) {
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

TEST(Follow, AMapOfFewFeaturesDoesNotTurnItRoundOnAWayThatManyBearingsAgreeOn) {
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

TEST(Follow, AWayFollowedInVainIsGivenUpForAnotherThatFewerBearingsSay) {
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

TEST(Follow, OnHintsItDrivesNoFartherThanByOdometryAlone) {
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

TEST(Follow, OfAPathWithMoreViewsNoHintIsFollowed) {
  const FarSeen far(6);
  const VisualPath path = {{far.from(far.target, 1), far.from(far.target, 3)}, {std::nullopt, std::nullopt}};
  FollowState state;
  for (std::uint64_t k = 0; k < 8; ++k) {
    EXPECT_FALSE(follow(state, path, far.from({}, 100 + 2 * k), {}, {}, {}, k).answered) << k;
  }
}

TEST(Follow, AViewSeenWellBeforeIsReachedWhenTheCameraWasCoveredBetween) {
  const Landmarks landmarks = corner();
  const VisualPath path = {{seen_from(landmarks, kViews.back(), 1)}, {std::nullopt}};
  const FollowConfig config;
  FollowState state;
  bool at_end = false;
  const Pose2 from = kViews.back() * Pose2{-1.2, 0.0, 0.0};
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

TEST(Follow, AHandfulOfFeaturesDoesNotTurnAKnownViewRound) {
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

TEST(Follow, GoneBackForSomebodyItHomesToAViewBeforeAndComesOnAgain) {
  // The later views show other things than the first two, and those are hidden while somebody stands before them.
  const Landmarks first = homeward::testing::landmarks_around(kViews, 160, 5);
  const Landmarks later = homeward::testing::landmarks_around(kViews, 160, 6);
  VisualPath path = path_through(first, true);
  for (std::size_t i = 2; i < kViews.size(); ++i) path.views[i] = seen_from(later, kViews[i], 100 + i);
  const FollowConfig config;
  FollowState state;
  std::uint64_t seed = 0;
  const auto look = [&](const Pose2& pose, bool hidden) {
    ++seed;
    const auto seen =
        together(seen_from(first, pose, 1000 + seed), seen_from(later, pose, 2000 + seed, hidden ? 1.0 : 0.0));
    return follow(state, path, seen, {}, pose, config, seed);
  };
  const auto come_on = [&](Pose2 pose, int to_index) {
    for (int k = 0; k < 300; ++k) {
      if (look(pose, false).at_end || state.index == to_index) return pose;
      const auto to = goal(state, pose, config);
      if (!to) continue;
      const double angle_rad = std::atan2(to->y(), to->x());
      const double way_m = std::abs(angle_rad) > 0.9 ? 0.0 : std::clamp(0.06 * to->norm(), 0.015, 0.05);
      pose = pose * Pose2{way_m, 0.0, std::clamp(0.18 * angle_rad, -0.1, 0.1)};
    }
    return pose;
  };
  Pose2 pose = come_on({}, 3);
  ASSERT_EQ(state.index, 3);
  const Pose2 from = pose;
  for (int k = 1; k <= 20; ++k) {
    const double left = 1.0 - 0.05 * k;
    pose = {left * from.x_m, left * from.y_m, from.theta_rad};
    look(pose, true);
  }
  EXPECT_TRUE(look(pose, true).answered);
  EXPECT_LT(state.index, 2);
  EXPECT_EQ(state.furthest, 3);
  EXPECT_LT(state.blind_m, 0.1);
  pose = come_on(pose, -1);
  EXPECT_EQ(state.index, 4);
  EXPECT_LT(std::hypot(pose.x_m - kViews.back().x_m, pose.y_m - kViews.back().y_m), 0.2);
}

TEST(Follow, IsTheSameForTheSameSeed) {
  const Landmarks landmarks = corner();
  const VisualPath path = path_through(landmarks, true);
  const auto seen = seen_from(landmarks, {0.2, 0.1, 0.1}, 3, 0.3);
  FollowState one;
  FollowState two;
  follow(one, path, seen, {}, {}, {}, 9);
  follow(two, path, seen, {}, {}, {}, 9);
  const auto goal_one = goal(one, {}, {});
  const auto goal_two = goal(two, {}, {});
  ASSERT_TRUE(goal_one);
  ASSERT_TRUE(goal_two);
  EXPECT_EQ(*goal_one, *goal_two);
}

}  // namespace
}  // namespace homeward::agent
