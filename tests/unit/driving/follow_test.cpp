// SPDX-License-Identifier: Apache-2.0
#include "driving/follow.hpp"

#include <gtest/gtest.h>

#include "support/far_seen.hpp"
#include "support/landmarks.hpp"

namespace homeward::driving::follow_test {
namespace {

using homeward::testing::FarSeen;
using homeward::testing::Landmarks;
using homeward::testing::together;

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
  place_by_edges(path);
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
  place_by_edges(path);
  const Drive driven = drive(landmarks, path, 0.0, {0.0, 0.0, 0.0});
  EXPECT_TRUE(driven.at_end);
  EXPECT_LT(driven.error_m, 0.2);
}

TEST(Follow, WhoKnowsToBeOnALaterPieceOfThePathGoesOnFromThere) {
  std::vector<Pose2> along;
  for (int k = 0; k < 12; ++k) along.push_back({0.8 * k, 0.0, 0.0});
  const Landmarks landmarks = homeward::testing::landmarks_around(along, 300, 5);
  VisualPath path;
  for (std::size_t k = 0; k < along.size(); ++k) path.views.push_back(seen_from(landmarks, along[k], 100 + k));
  path.edges.resize(along.size());
  path.map_from_view = along;
  std::vector<const features::Appearance*> views;
  for (const features::Appearance& view : path.views) views.push_back(&view);
  path.index = std::make_shared<const ViewIndex>(views);
  const FollowConfig config;
  for (const double weight : {0.95, 0.8}) {
    FollowState state;
    state.begun = true;
    const Pose2 here{6.9, 0.05, 0.1};
    state.hypotheses =
        PoseHypotheses(config.pose, {{here, 0.01 * Eigen::Matrix3d::Identity(), weight}}, 1.0 - weight, 0.0);
    track(state, path, {}, {}, config, 1);
    EXPECT_EQ(state.index > 8, weight > config.leap_above) << weight;
  }
}

TEST(Follow, WhereItsPathDoublesBackItDoesNotTurnToAndFro) {
  // West to one view and back east to the next two, as two tours of one corridor meet.
  const std::vector<Pose2> fold = {
      {0.0, -1.0, kPi / 2.0}, {0.0, 0.0, kPi / 2.0}, {-1.05, 0.33, 0.0}, {0.3, 1.05, 0.0}, {1.1, 1.15, 0.0}};
  const Landmarks landmarks = homeward::testing::landmarks_around(fold, 160, 5);
  VisualPath path;
  for (std::size_t k = 0; k < fold.size(); ++k) path.views.push_back(seen_from(landmarks, fold[k], 100 + k));
  path.edges.resize(fold.size());
  path.map_from_view = fold;
  const FollowConfig config;
  FollowState state;
  state.begun = true;
  std::vector<int> indices;
  for (int k = 0; k < 8; ++k) {  // as near to one way as to the other, known to a few centimetres
    const Pose2 here{0.06 * (k % 2), 0.18, 1.6};
    state.hypotheses = PoseHypotheses(config.pose, {{here, 0.001 * Eigen::Matrix3d::Identity(), 0.95}}, 0.05, 0.0);
    track(state, path, {}, {}, config, 1);
    indices.push_back(state.index);
  }
  EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end())) << ::testing::PrintToString(indices);
}

TEST(Follow, APathAwayAndBackIsDrivenToItsEndAndHome) {
  std::vector<Pose2> along;
  for (const int k : {0, 1, 2, 3, 2, 1, 0}) along.push_back({0.8 * k, 0.0, 0.0});
  const Landmarks landmarks = homeward::testing::landmarks_around({along.begin(), along.begin() + 4}, 160, 5);
  VisualPath path;
  for (std::size_t k = 0; k < along.size(); ++k) path.views.push_back(seen_from(landmarks, along[k], 100 + k));
  path.edges.resize(along.size());
  path.map_from_view = along;
  const FollowConfig config;
  FollowState state;
  Pose2 pose{0.05, 0.05, 0.1};
  double farthest_m = 0.0;
  bool at_end = false;
  for (std::uint64_t k = 1; k <= 600 && !at_end; ++k) {
    at_end = follow(state, path, seen_from(landmarks, pose, 1000 + k), {}, pose, config, k).at_end;
    farthest_m = std::max(farthest_m, pose.x_m);
    const auto to = goal(state, pose, config);
    if (!to || at_end) continue;
    const double angle_rad = std::atan2(to->y(), to->x());
    const double speed_mps = std::abs(angle_rad) > 0.9 ? 0.0 : std::clamp(0.6 * to->norm(), 0.15, 0.5);
    pose = pose * Pose2{0.1 * speed_mps, 0.0, 0.1 * std::clamp(1.8 * angle_rad, -1.0, 1.0)};
  }
  EXPECT_TRUE(at_end);
  // It may turn as soon as it could be level with the farthest view, which is `abreast_m` before it.
  EXPECT_GT(farthest_m, along[3].x_m - config.abreast_m - 0.2);
  EXPECT_LT(std::hypot(pose.x_m, pose.y_m), 0.2);
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

TEST(Follow, OfAPathWithMoreViewsNoHintIsFollowed) {
  const FarSeen far(6);
  VisualPath path = {{far.from(far.target, 1), far.from(far.target, 3)}, {std::nullopt, std::nullopt}};
  place_by_edges(path);
  FollowState state;
  for (std::uint64_t k = 0; k < 8; ++k) {
    EXPECT_FALSE(follow(state, path, far.from({}, 100 + 2 * k), {}, {}, {}, k).answered) << k;
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

/// A robot that has just seen a picture at `odometry`, and may be at one of two places of which only one has a wall
/// across its way, 1.5 m ahead of where it is.
FollowState between_twins(const Pose2& odometry) {
  FollowState state;
  state.begun = true;
  state.odometry = odometry;
  std::vector<PoseHypothesis> both(2);
  for (PoseHypothesis& one : both) {
    one.covariance = 0.001 * Eigen::Matrix3d::Identity();
    one.weight = 0.5;
  }
  both[1].map_from_robot.x_m = 50.0;
  state.hypotheses = PoseHypotheses({}, both, 0.0, 0.0);
  return state;
}

double twin_probability(const FollowState& state) {
  double sum = 0.0;
  for (const PoseHypothesis& one : state.hypotheses.all()) sum += one.map_from_robot.x_m > 25.0 ? one.weight : 0.0;
  return sum;
}

std::vector<Eigen::Vector2d> wall_ahead(double away_m) {
  std::vector<Eigen::Vector2d> points_m;
  for (int k = -10; k <= 10; ++k) points_m.emplace_back(away_m, 0.1 * k);
  return points_m;
}

VisualPath driven_past_the_wall_by_one_twin() {
  VisualPath path;
  path.ways = {{{0.0, 0.0}, {0.9, 0.0}}, {{50.0, 0.0}, {53.0, 0.0}}};
  return path;
}

TEST(SeeWays, AWallOnAWayThatATourDroveSpeaksOnceForEachStretchOfWay) {
  const VisualPath path = driven_past_the_wall_by_one_twin();
  FollowState state = between_twins({});
  see_ways(state, path, wall_ahead(1.5), {});
  const double at_first = twin_probability(state);
  EXPECT_LT(at_first, 0.15);
  for (int k = 0; k < 50; ++k) see_ways(state, path, wall_ahead(1.5), {});
  EXPECT_EQ(twin_probability(state), at_first) << "standing there it sees the same again";
  see_ways(state, path, wall_ahead(1.2), {0.3, 0.0, 0.0});
  const double a_little_on = twin_probability(state);
  EXPECT_LT(a_little_on, at_first);
  EXPECT_GT(a_little_on, 0.5 * at_first);
}

TEST(SeeWays, ASweepIsOfWhereOdometrySaysThatTheRobotIsByThen) {
  const VisualPath path = driven_past_the_wall_by_one_twin();
  // Turned to the left since its latest picture, it sees the wall at its right.
  const Pose2 before{3.0, -1.0, 0.7};
  std::vector<Eigen::Vector2d> at_its_right_m;
  for (const Eigen::Vector2d& point_m : wall_ahead(1.5)) at_its_right_m.emplace_back(point_m.y(), -point_m.x());
  FollowState turned = between_twins(before);
  see_ways(turned, path, at_its_right_m, before * Pose2{0.0, 0.0, kPi / 2.0});
  EXPECT_LT(twin_probability(turned), 0.15);
  FollowState straight = between_twins(before);
  see_ways(straight, path, at_its_right_m, before);
  EXPECT_GT(twin_probability(straight), 0.4) << "a wall beside the way is none across it";
}

}  // namespace
}  // namespace homeward::driving::follow_test
