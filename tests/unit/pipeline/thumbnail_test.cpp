// SPDX-License-Identifier: Apache-2.0
#include "pipeline/thumbnail.hpp"

#include <gtest/gtest.h>

#include "imageio/decode.hpp"
#include "support/painted_tour.hpp"

namespace homeward::pipeline::thumbnail_test {
namespace {

class Thumbnail : public ::testing::Test {
 protected:
  Thumbnail() : camera_(camera::Camera::create(homeward::testing::sphere_camera(512)).value()) {}

  std::shared_ptr<const camera::Camera> camera_;
  Result<Eye> eye_ = Eye::create(camera_->config(), suited_feature_config(*camera_));
};

TEST_F(Thumbnail, IsAStripOfTheWantedWidthInTheShapeOfThePanorama) {
  ASSERT_TRUE(eye_);
  const Image picture = homeward::testing::painted_picture(homeward::testing::painted_corridor(), {}, *camera_);
  const auto bytes = make_thumbnail(*eye_, picture, 200);
  ASSERT_TRUE(bytes);
  const auto small = imageio::decode(*bytes, "thumbnail");
  ASSERT_TRUE(small);
  EXPECT_EQ(small->width_px, 200);
  const auto panorama = eye_->unwrap(picture);
  ASSERT_TRUE(panorama);
  const double shape = static_cast<double>(panorama->rgb.height_px) / panorama->rgb.width_px;
  EXPECT_NEAR(small->height_px, 200 * shape, 1.0);
}

TEST_F(Thumbnail, APictureOfAnotherSizeIsAnErrorThatNamesIt) {
  ASSERT_TRUE(eye_);
  const auto bytes = make_thumbnail(*eye_, Image(100, 50, 3), 200);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kWrongImageSize);
}

}  // namespace
}  // namespace homeward::pipeline::thumbnail_test
