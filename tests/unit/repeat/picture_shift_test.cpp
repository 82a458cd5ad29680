// SPDX-License-Identifier: Apache-2.0
#include "repeat/picture_shift.hpp"

#include <gtest/gtest.h>

#include "support/wavy_picture.hpp"

namespace homeward::repeat::picture_shift_test {
namespace {

using testing::picture_of;
using testing::Seen;
using testing::WavyTexture;
using tracking::ImagePyramid;

TEST(PictureShift, FindsATurnOfAThirdOfThePictureToACoarsePixel) {
  const WavyTexture texture(3);
  const auto first = ImagePyramid::build(picture_of(texture, {})).value();
  for (const Eigen::Vector2d& moved_px : {Eigen::Vector2d(0.0, 0.0), {57.0, -9.0}, {-96.0, 16.0}}) {
    const Seen seen{.moved_px = moved_px, .gain = 0.8, .offset = 10.0};
    const auto shift_px = picture_shift(first, ImagePyramid::build(picture_of(texture, seen)).value());
    ASSERT_TRUE(shift_px);
    EXPECT_LE((*shift_px - moved_px).cwiseAbs().maxCoeff(), 4.0) << moved_px.transpose();
  }
}

TEST(PictureShift, OfPlainPicturesOrOtherSizesIsNone) {
  const auto some = ImagePyramid::build(picture_of(WavyTexture(3), {})).value();
  EXPECT_FALSE(picture_shift(some, ImagePyramid::build(Image(320, 240, 1)).value()));
  EXPECT_FALSE(picture_shift(some, ImagePyramid::build(Image(160, 120, 1)).value()));
}

}  // namespace
}  // namespace homeward::repeat::picture_shift_test
