// SPDX-License-Identifier: Apache-2.0
#include "geometry/five_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "support/planar_scene.hpp"

namespace homeward::geometry::five_point_test {
namespace {

using homeward::testing::bearing_from;
using homeward::testing::room_points;

/// A view that is turned about all three axes, and its place.
ViewMotion some_motion() {
  ViewMotion motion;
  motion.current_from_target = Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.2, -0.5, 0.8).normalized()).toRotationMatrix();
  motion.target_in_current = Eigen::Vector3d(0.8, 0.3, -0.2).normalized();
  return motion;
}

std::vector<Correspondence> seen_by(const ViewMotion& motion, int count) {
  std::mt19937_64 random(3);
  std::vector<Correspondence> matches;
  for (const Eigen::Vector3d& point : room_points(count, random)) {
    const Eigen::Vector3d target = motion.current_from_target.transpose() * (point - motion.target_in_current);
    matches.push_back({bearing_from({}, point), target.normalized()});
  }
  return matches;
}

TEST(FivePoint, FindsTheFullRotationAndTheDirectionOfExactMatches) {
  const ViewMotion truth = some_motion();
  const auto found = search_essentials(seen_by(truth, 60), {}, 1);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.front().cost, 1e-3F);
  double turn_off = 10.0;
  double direction_off = 10.0;
  for (const ViewMotion& motion : motions_of(found.front().essential)) {
    const double off = (motion.current_from_target - truth.current_from_target).norm();
    if (off > turn_off) continue;
    turn_off = off;
    direction_off = motion.target_in_current.cross(truth.target_in_current).norm();
  }
  EXPECT_LT(turn_off, 1e-6);
  EXPECT_LT(direction_off, 1e-6);
}

TEST(FivePoint, FourMatchesGiveNone) { EXPECT_TRUE(search_essentials(seen_by(some_motion(), 4), {}, 1).empty()); }

TEST(FivePoint, TheTwoMotionsOfAMatrixMakeItAgain) {
  const ViewMotion truth = some_motion();
  Eigen::Matrix3d essential;
  const Eigen::Vector3d& t = truth.target_in_current;
  essential << 0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0;
  essential *= truth.current_from_target;
  for (const ViewMotion& motion : motions_of(essential)) {
    EXPECT_NEAR(motion.current_from_target.determinant(), 1.0, 1e-9);
    EXPECT_NEAR(motion.target_in_current.norm(), 1.0, 1e-9);
    for (const Correspondence& match : seen_by(truth, 20)) {
      const Eigen::Vector3d turned = motion.current_from_target * match.target;
      EXPECT_NEAR(match.current.dot(motion.target_in_current.cross(turned)), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace homeward::geometry::five_point_test
