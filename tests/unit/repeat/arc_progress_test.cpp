// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_progress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/straight_path.hpp"

namespace homeward::repeat::arc_progress_test {
namespace {

using testing::StraightPath;

ArcPose pose(double x, double y, double heading_rad = 0.0) {
  return {Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {x, y, 0.0}};
}

TEST(ArcProgress, IsTheShareOfTheWayWhateverIsBesideIt) {
  const StraightPath straight({0.0, 2.0, 3.0});
  const ArcSurroundings around = surroundings_of(straight.path, 0, 1, 3);
  EXPECT_NEAR(progress_along(around, 0, pose(0.25, 0.3, 0.4)).value(), 0.25, 1e-9);
  EXPECT_NEAR(progress_along(around, 0, pose(1.2, -0.3)).value(), 1.2, 1e-9);
  EXPECT_NEAR(progress_along(around, 1, pose(1.2, -0.3)).value(), 0.4, 1e-9);  // half as long
  EXPECT_FALSE(progress_along(around, 0, pose(0.25, 0.3)).of_turn);
  EXPECT_NEAR(*lateral_of(around, 0, pose(0.25, 0.3)), 0.3, 1e-9);
  EXPECT_NEAR(*lateral_of(around, 1, pose(1.2, -0.3)), -0.6, 1e-9);
}

TEST(ArcProgress, OnATurnOnTheSpotIsTheShareOfTheTurn) {
  StraightPath straight({0.0, 1.0, 1.0});
  straight.turn_at(1, 0.5);
  const ArcSurroundings around = surroundings_of(straight.path, 1, 1, 3);
  const ArcProgress progress = progress_along(around, 1, pose(0.1, 0.2, 0.2));
  ASSERT_TRUE(progress.of_turn);
  EXPECT_NEAR(progress.value(), 0.4, 1e-6);
  EXPECT_FALSE(progress.of_way);
  EXPECT_FALSE(lateral_of(around, 1, pose(0.1, 0.2, 0.2)));
}

TEST(ArcProgress, TellsByHowMuchTheWayChangesWhatIsSeen) {
  StraightPath straight({0.0, 0.1, 0.1, 0.3});
  straight.turn_at(1, 0.5);
  const ArcSurroundings around = surroundings_of(straight.path, 1, 2, 3);
  const ArcPose there = {Eigen::Matrix3d::Identity(), Eigen::Vector3d(2.0, 0.5, 0.0)};
  EXPECT_EQ(progress_along(around, 1, there).gone_rad, 0.0);  // of the turn itself
  EXPECT_FALSE(progress_along(around, 1, there).past_rad);
  const ArcProgress after = progress_along(around, 2, there);
  EXPECT_NEAR(after.gone_rad, 2.0 * around.nearness, 1e-9);
  EXPECT_NEAR(after.past_rad.value(), 0.0, 1e-6);  // the way after the turn is twice as long as the one before
}

TEST(ArcProgress, AnArcThatLeadsNowhereIsPassed) {
  const StraightPath standing({0.0, 1.0, 1.0});
  const ArcSurroundings around = surroundings_of(standing.path, 1, 1, 3);
  EXPECT_EQ(progress_along(around, 1, pose(0.0, 0.0)).value(), 1.0);
}

TEST(ArcProgress, TellsWhereTheNextKeyImageIs) {
  const StraightPath straight({0.0, 1.0, 2.0});
  const ArcSurroundings around = surroundings_of(straight.path, 0, 1, 3);
  EXPECT_NEAR(*bearing_of_key(around, 1, pose(0.5, -0.5)), 0.25 * EIGEN_PI, 1e-9);
  EXPECT_NEAR(*bearing_of_key(around, 1, pose(0.5, -0.5, 0.25 * EIGEN_PI)), 0.0, 1e-9);
  EXPECT_FALSE(bearing_of_key(around, 1, pose(1.0, 0.0)));
}

}  // namespace
}  // namespace homeward::repeat::arc_progress_test
