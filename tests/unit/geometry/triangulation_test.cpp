// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/pinhole_scene.hpp"

namespace homeward::geometry::triangulation_test {
namespace {

using homeward::testing::pinhole_point;
using homeward::testing::pinhole_scene;

ViewMotion half_forward() {
  ViewMotion motion;
  motion.current_from_target = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  motion.target_in_current = Eigen::Vector3d(0.8, 0.6, 0.1).normalized();
  return motion;
}

TEST(Triangulation, PutsExactRaysWhereThePointIs) {
  const ViewMotion motion = half_forward();
  const auto scene = pinhole_scene(motion, {.count = 50, .noise_px = 0.0, .baseline = 0.5});
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const PointPair& pair = scene.pairs[i];
    const MeetingRays rays = triangulate(motion, pair.current.bearing, pair.target.bearing);
    ASSERT_GT(rays.nearness, 0.0);
    const Eigen::Vector3d point = 0.5 * rays.current / rays.nearness;
    EXPECT_LT((point - scene.points[i]).norm(), 1e-6);
    const Eigen::Vector3d from_target =
        motion.current_from_target.transpose() * (scene.points[i] - 0.5 * motion.target_in_current);
    EXPECT_NEAR(0.5 / rays.from_target, from_target.norm(), 1e-6);
    EXPECT_NEAR(rays.parallax_rad,
                std::acos(pair.current.bearing.dot(motion.current_from_target * pair.target.bearing)), 1e-6);
    EXPECT_LT(reprojection_px2(pair, rays), 1e-12);
  }
}

TEST(Triangulation, RaysThatPartMeetBehind) {
  ViewMotion motion;
  motion.target_in_current = Eigen::Vector3d::UnitY();  // to the left, from where the ray must lean right
  const Eigen::Vector3d left = Eigen::Vector3d(1.0, 0.2, 0.0).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d(1.0, -0.2, 0.0).normalized();
  EXPECT_GT(triangulate(motion, left, right).nearness, 0.0);
  EXPECT_LT(triangulate(motion, right, left).nearness, 0.0);
}

TEST(Triangulation, ParallelRaysMeetNowhere) {
  const ViewMotion motion = half_forward();
  const Eigen::Vector3d bearing = Eigen::Vector3d(1.0, -0.2, 0.1).normalized();
  const MeetingRays rays = triangulate(motion, bearing, motion.current_from_target.transpose() * bearing);
  EXPECT_NEAR(rays.nearness, 0.0, 1e-9);
  EXPECT_NEAR(rays.parallax_rad, 0.0, 1e-7);
}

/// A pixel up in one picture is half a pixel off in each.
TEST(Triangulation, TheErrorIsSharedByBothPictures) {
  ViewMotion sideways;
  sideways.target_in_current = Eigen::Vector3d::UnitY();
  const PointPair pair{pinhole_point({20.0, 0.0}), pinhole_point({50.0, 1.0})};
  const MeetingRays rays = triangulate(sideways, pair.current.bearing, pair.target.bearing);
  EXPECT_NEAR(reprojection_px2(pair, rays), 0.5, 0.02);
}

TEST(SeenPoint, TellsABearingsOffsetInPixels) {
  const SeenPoint seen = pinhole_point({100.0, -60.0});
  const Eigen::Vector2d off_px(0.8, -0.5);
  const Eigen::Vector2d found_px = offset_px(seen, pinhole_point(Eigen::Vector2d(100.0, -60.0) + off_px).bearing);
  EXPECT_LT((found_px - off_px).norm(), 0.01);
  EXPECT_FALSE(offset_px(seen, -seen.bearing).allFinite());
}

}  // namespace
}  // namespace homeward::geometry::triangulation_test
