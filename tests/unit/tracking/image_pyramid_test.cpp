// SPDX-License-Identifier: Apache-2.0
#include "tracking/image_pyramid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace homeward::tracking::image_pyramid_test {
namespace {

TEST(ImagePyramid, EveryLevelShowsEachSecondPixelOfTheOneBefore) {
  Image ramp(64, 48, 1);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) *ramp.at(u, v) = static_cast<std::uint8_t>(2 * u + v);
  }
  const auto pyramid = ImagePyramid::build(ramp, {.levels = 2}).value();
  ASSERT_EQ(pyramid.levels().size(), 2U);
  const GreyLevel& half = pyramid.levels()[1];
  EXPECT_EQ(half.width_px, 32);
  EXPECT_EQ(half.height_px, 24);
  // A ramp is the same after any blur, away from the border.
  EXPECT_NEAR(pyramid.levels()[0].row(20)[30], 80.0F, 1e-3F);
  EXPECT_NEAR(half.row(10)[15], 80.0F, 1e-3F);
}

TEST(ImagePyramid, TheBorderRepeatsTheOutermostPixels) {
  Image picture(32, 32, 1);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<std::uint8_t>(i * 37 % 251);
  const auto pyramid = ImagePyramid::build(picture).value();
  const GreyLevel& level = pyramid.levels().front();
  EXPECT_EQ(level.row(-GreyLevel::kBorder_px)[-GreyLevel::kBorder_px], level.row(0)[0]);
  EXPECT_EQ(level.row(31 + GreyLevel::kBorder_px)[31 + GreyLevel::kBorder_px], level.row(31)[31]);
  EXPECT_EQ(level.row(7)[-3], level.row(7)[0]);
}

TEST(ImagePyramid, LeavesOutLevelsThatWouldBeTooSmall) {
  EXPECT_EQ(ImagePyramid::build(Image(40, 200, 1), {.levels = 5}).value().levels().size(), 2U);
  EXPECT_EQ(ImagePyramid::build(Image(16, 16, 3), {.levels = 5}).value().levels().size(), 1U);
}

TEST(ImagePyramid, RefusesWhatIsNoPictureToTrackIn) {
  EXPECT_EQ(ImagePyramid::build(Image()).error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(ImagePyramid::build(Image(15, 40, 1)).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(ImagePyramid::build(Image(40, 40, 2)).error().code, ErrorCode::kInvalidInput);
  Image cut(40, 40, 1);
  cut.data.pop_back();
  EXPECT_EQ(ImagePyramid::build(cut).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(ImagePyramid::build(Image(40, 40, 1), {.levels = 0}).error().code, ErrorCode::kInvalidInput);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ImagePyramid::build(Image(40, 40, 1), {.smoothing_px = nan}).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::tracking::image_pyramid_test
