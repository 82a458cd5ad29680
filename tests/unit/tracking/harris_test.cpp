// SPDX-License-Identifier: Apache-2.0
#include "tracking/harris.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/wavy_picture.hpp"

namespace homeward::tracking::harris_test {
namespace {

ImagePyramid wavy(unsigned seed) {
  return ImagePyramid::build(testing::picture_of(testing::WavyTexture(seed), {})).value();
}

TEST(Harris, FindsTheCornersOfASquareAndNothingOnItsEdges) {
  Image square(100, 80, 1);
  for (int v = 30; v < 55; ++v) {
    for (int u = 40; u < 70; ++u) *square.at(u, v) = 200;
  }
  const auto corners = harris_corners(ImagePyramid::build(square).value(), {}).value();
  ASSERT_EQ(corners.size(), 4U);
  for (const Corner& corner : corners) {
    EXPECT_LT(std::min(std::abs(corner.pixel_px.x() - 39.5), std::abs(corner.pixel_px.x() - 69.5)), 3.0);
    EXPECT_LT(std::min(std::abs(corner.pixel_px.y() - 29.5), std::abs(corner.pixel_px.y() - 54.5)), 3.0);
  }
}

TEST(Harris, CornersAreStrongestFirstApartAndWithinTheMargin) {
  const HarrisConfig config{.most = 60, .spacing_px = 12.0, .margin_px = 20, .least_strength = 1.0};
  const auto corners = harris_corners(wavy(1), config).value();
  ASSERT_GT(corners.size(), 20U);
  ASSERT_LE(corners.size(), 60U);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& at = corners[i].pixel_px;
    EXPECT_TRUE(at.x() >= 20 && at.y() >= 20 && at.x() < 300 && at.y() < 220);
    EXPECT_LE(corners[i].strength, corners[i == 0 ? 0 : i - 1].strength);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((corners[j].pixel_px - at).norm(), 12.0);
  }
}

TEST(Harris, ACellHoldsNoMoreThanItsShare) {
  HarrisConfig config{.most = 24, .cells_across = 2, .cells_down = 1, .cells_share = 1.0, .least_strength = 1.0};
  Image picture = testing::picture_of(testing::WavyTexture(2), {});
  for (int v = 0; v < 240; ++v) std::fill_n(picture.at(200, v), 120, std::uint8_t{128});
  const auto pyramid = ImagePyramid::build(picture).value();
  const auto in_left_half = [](const std::vector<Corner>& corners) {
    return std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.pixel_px.x() < 160.0; });
  };
  EXPECT_EQ(in_left_half(harris_corners(pyramid, config).value()), 12);
  config.cells_share = 0.0;
  EXPECT_GT(in_left_half(harris_corners(pyramid, config).value()), 12);
}

TEST(Harris, KeepsAwayFromWhatIsOccupied) {
  const HarrisConfig config{.spacing_px = 15.0, .least_strength = 1.0};
  const auto all = harris_corners(wavy(3), config).value();
  ASSERT_FALSE(all.empty());
  const std::vector<Eigen::Vector2d> occupied{all.front().pixel_px, {std::nan(""), 1.0}, {-1e30, 1e30}};
  const auto others = harris_corners(wavy(3), config, occupied).value();
  ASSERT_FALSE(others.empty());
  for (const Corner& corner : others) {
    EXPECT_GE((corner.pixel_px - occupied.front()).norm(), 15.0);
  }
}

TEST(Harris, APlainPictureHasNone) {
  EXPECT_TRUE(harris_corners(ImagePyramid::build(Image(64, 64, 1)).value(), {}).value().empty());
}

TEST(Harris, RefusesABadConfiguration) {
  EXPECT_EQ(harris_corners(wavy(4), {.cells_across = 0}).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(harris_corners(wavy(4), {.window_px = 4}).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::tracking::harris_test
