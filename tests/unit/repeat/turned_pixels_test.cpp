// SPDX-License-Identifier: Apache-2.0
#include "repeat/turned_pixels.hpp"

#include <gtest/gtest.h>

#include "support/lens_room.hpp"

namespace homeward::repeat::turned_pixels_test {
namespace {

TEST(TurnedPixels, MoveAsATurnMovesThem) {
  const auto camera = camera::Camera::create(testing::small_lens_camera()).value();
  const TurnedPixels turned(*camera, {30.0, 0.0});
  ASSERT_TRUE(turned.after_from_before());
  const Eigen::Vector2d at_px(20.0, 40.0);
  const Eigen::Vector2d moved_px = turned(at_px);
  EXPECT_GT(moved_px.x(), at_px.x() + 30.0);  // more than the middle, far from it
  const Eigen::Vector3d bearing = *turned.after_from_before() * *camera->bearing(at_px);
  EXPECT_LT((bearing - *camera->bearing(moved_px)).norm(), 1e-9);
}

TEST(TurnedPixels, StayWithoutAShift) {
  const auto camera = camera::Camera::create(testing::small_lens_camera()).value();
  const TurnedPixels turned(*camera, Eigen::Vector2d::Zero());
  EXPECT_FALSE(turned.after_from_before());
  EXPECT_EQ(turned({20.0, 40.0}), Eigen::Vector2d(20.0, 40.0));
}

}  // namespace
}  // namespace homeward::repeat::turned_pixels_test
