// SPDX-License-Identifier: Apache-2.0
#include "linemodel/hough_space.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

TEST(HoughSpaceOfAPinhole, IsThatOfTheLineInThePicture) {
  const auto camera = camera::Camera::create(small_pinhole()).value();
  const HoughSpace space(camera->config());
  // The line through two pixels, by its own normal form from the principal point.
  const Eigen::Vector2d a_px(40.0, 30.0);
  const Eigen::Vector2d b_px(250.0, 200.0);
  const Eigen::Vector3d normal = camera->bearing(a_px)->cross(*camera->bearing(b_px));
  const auto point = space.point(normal.cast<float>());
  ASSERT_TRUE(point);
  const Eigen::Vector2d across(std::cos(point->angle_rad), std::sin(point->angle_rad));
  EXPECT_NEAR(across.dot(a_px - Eigen::Vector2d(159.5, 119.5)), point->offset, 0.01);
  EXPECT_NEAR(across.dot(b_px - Eigen::Vector2d(159.5, 119.5)), point->offset, 0.01);
}

TEST(HoughSpaceOfAPinhole, HasNoLineThatThePictureDoesNotReach) {
  const HoughSpace space(small_pinhole());
  EXPECT_FALSE(space.point(Eigen::Vector3f(1.0F, 0.0F, 0.02F))) << "a line far above the picture";
}

TEST(HoughSpace, GivesALineAndItsTurnedNormalTheSamePoint) {
  for (const auto& config : {small_pinhole(), small_panorama()}) {
    const HoughSpace space(config);
    for (const Eigen::Vector3f& normal :
         {Eigen::Vector3f(0.1F, 0.9F, 0.3F), Eigen::Vector3f(0.2F, -0.3F, 0.9F), Eigen::Vector3f(0.0F, 1.0F, 0.0F)}) {
      const auto one = space.point(normal);
      const auto other = space.point(-normal);
      ASSERT_EQ(one.has_value(), other.has_value());
      if (!one) continue;
      EXPECT_NEAR(one->angle_rad, other->angle_rad, 1e-4);
      EXPECT_NEAR(one->offset, other->offset, 1e-3);
      EXPECT_GE(one->angle_rad, 0.0F);
      EXPECT_LT(one->angle_rad, static_cast<float>(kPi));
    }
  }
}

TEST(HoughSpaceOfNormals, PutsAnUprightLineAtNoElevation) {
  const HoughSpace space(small_panorama());
  const Eigen::Vector3f foot(3.0F, 1.0F, -1.2F);
  const Eigen::Vector3f head(3.0F, 1.0F, 1.3F);
  const auto point = space.point(foot.cross(head));
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->offset, 0.0, 1e-6);
}

}  // namespace
}  // namespace homeward::linemodel
