// SPDX-License-Identifier: Apache-2.0
#include "repeat/seen.hpp"

#include <gtest/gtest.h>

#include "support/lens_room.hpp"

namespace homeward::repeat::seen_test {
namespace {

TEST(SeenAt, GivesBearingsAndWhatAPixelMeansOfAnyLens) {
  auto config = testing::small_lens_camera();
  const auto pinhole = camera::Camera::create(config).value();
  config.model = camera::Pinhole{{171.4, 171.4, 119.5, 89.5}, {-0.2, 0.05, 0.001, -0.001, 0.0}};
  const auto distorted = camera::Camera::create(config).value();
  config.model = camera::Fisheye{{110.0, 110.0, 119.5, 89.5}, {0.01, 0.0, 0.0, 0.0}, {}};
  const auto fisheye = camera::Camera::create(config).value();
  for (const auto& camera : {pinhole, distorted, fisheye}) {
    for (const Eigen::Vector2d& pixel_px : {Eigen::Vector2d(119.5, 89.5), {20.0, 30.0}, {220.0, 160.0}}) {
      const auto seen = seen_at(*camera, pixel_px);
      ASSERT_TRUE(seen);
      EXPECT_LT((seen->bearing - *camera->bearing(pixel_px)).norm(), 1e-12);
      const Eigen::Vector2d beside_px = pixel_px + Eigen::Vector2d(0.7, -0.4);
      const Eigen::Vector2d off_px = geometry::offset_px(*seen, *camera->bearing(beside_px));
      EXPECT_LT((off_px - Eigen::Vector2d(0.7, -0.4)).norm(), 0.01);
    }
  }
}

TEST(SeenAt, IsNothingWhereTheCameraSeesNothing) {
  auto config = testing::small_lens_camera();
  config.model = camera::Fisheye{{110.0, 110.0, 119.5, 89.5}, {}, {0.0, 80.0}};
  const auto ring = camera::Camera::create(config).value();
  EXPECT_TRUE(seen_at(*ring, {119.5, 100.0}));
  EXPECT_FALSE(seen_at(*ring, {10.0, 10.0}));
  EXPECT_FALSE(seen_at(*ring, {199.3, 89.5}));  // at the rim
}

}  // namespace
}  // namespace homeward::repeat::seen_test
