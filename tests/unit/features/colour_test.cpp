// SPDX-License-Identifier: Apache-2.0
#include "features/colour.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/painted_room.hpp"

namespace homeward::features::colour_test {
namespace {

TEST(ColourMoments, AreTheMomentsOfTheValidPixels) {
  camera::Panorama panorama;
  panorama.geometry.width_px = 2;
  panorama.rgb = Image(2, 2, 3);
  panorama.rgb.data = {0, 51, 255, 255, 51, 0, 255, 51, 0, 77, 77, 77};
  panorama.valid = {1, 1, 1, 0};  // the last pixel does not count
  const auto moments = colour_moments(panorama);
  const double mean = 2.0 / 3.0;
  const double spread = std::sqrt(2.0 / 9.0);
  const double third = (2.0 * std::pow(1.0 / 3.0, 3) - std::pow(2.0 / 3.0, 3)) / 3.0;
  EXPECT_NEAR(moments[0], mean, 1e-6);
  EXPECT_NEAR(moments[1], spread, 1e-6);
  EXPECT_NEAR(moments[2], std::cbrt(third), 1e-6);
  EXPECT_NEAR(moments[3], 0.2, 1e-6);
  EXPECT_NEAR(moments[4], 0.0, 1e-4);
  EXPECT_NEAR(moments[6], 1.0 - mean, 1e-6);
  EXPECT_NEAR(moments[8], -std::cbrt(third), 1e-6);
}

TEST(ColourMoments, OfNothingSeenAreZero) {
  camera::Panorama panorama;
  panorama.rgb = Image(4, 2, 3);
  panorama.valid.assign(8, 0);
  for (const float moment : colour_moments(panorama)) EXPECT_EQ(moment, 0.0F);
}

TEST(ColourMoments, ATurnDoesNotChangeThemAndAnotherRoomDoes) {
  camera::PanoramaGeometry geometry;
  geometry.width_px = 256;
  const auto seen = [&](std::uint64_t seed, double heading_rad) {
    homeward::testing::PaintedRoom room;
    room.seed = seed;
    return colour_moments(homeward::testing::painted_panorama(room, {0.4, 0.3, heading_rad}, geometry));
  };
  const double turned = colour_moment_distance(seen(1, 0.0), seen(1, 1.0));
  EXPECT_LT(turned, 0.01);
  EXPECT_GT(colour_moment_distance(seen(1, 0.0), seen(2, 0.0)), 3.0 * turned);
  EXPECT_EQ(colour_moment_distance(seen(1, 0.0), seen(1, 0.0)), 0.0);
}

/// Three bands of waves along u.
Image waves(double phase_of_green_rad, double gain_of_blue) {
  Image image(64, 32, 3);
  for (int v = 0; v < 32; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double angle_rad = 2.0 * kPi * u / 16.0;
      image.at(u, v)[0] = static_cast<std::uint8_t>(std::lround(120.0 + 60.0 * std::sin(angle_rad)));
      image.at(u, v)[1] =
          static_cast<std::uint8_t>(std::lround(120.0 + 60.0 * std::sin(angle_rad + phase_of_green_rad)));
      image.at(u, v)[2] = static_cast<std::uint8_t>(std::lround(120.0 + gain_of_blue * 60.0 * std::sin(angle_rad)));
    }
  }
  return image;
}

TEST(ColourInvariants, AreCorrelationsOfTheBands) {
  // 9 samples over 16 columns, both ends in phase.
  const auto same = colour_invariants(waves(0.0, 0.5), 32.0, 16.0, 8.0);
  EXPECT_GT(same[0], 124);
  EXPECT_GT(same[1], 124);  // weaker, but proportional: an illuminant's colour does not matter
  const auto opposite = colour_invariants(waves(kPi, 1.0), 32.0, 16.0, 8.0);
  EXPECT_LT(opposite[0], -124);
  EXPECT_GT(opposite[1], 124);
  EXPECT_LT(opposite[2], -124);
}

TEST(ColourInvariants, ABandWithoutVariationGivesZero) {
  const auto flat = colour_invariants(waves(0.0, 0.0), 32.0, 16.0, 8.0);
  EXPECT_GT(flat[0], 124);
  EXPECT_EQ(flat[1], 0);
  EXPECT_EQ(flat[2], 0);
}

TEST(ColourInvariants, PatchesWrapAtTheSeamAndStayInsideAboveAndBelow) {
  const Image image = waves(1.0, 1.0);  // the pattern repeats every 16 columns: the seam is like column 32
  EXPECT_EQ(colour_invariants(image, 0.0, 16.0, 8.0), colour_invariants(image, 32.0, 16.0, 8.0));
  EXPECT_EQ(colour_invariants(image, 63.0, 16.0, 8.0), colour_invariants(image, 31.0, 16.0, 8.0));
  EXPECT_EQ(colour_invariants(image, 32.0, 0.0, 40.0), colour_invariants(image, 32.0, 31.0, 40.0));
}

/// The room's panorama with even values up to 126, so that half and three-halves of them are whole numbers.
Image even_values() {
  camera::PanoramaGeometry geometry;
  geometry.width_px = 256;
  Image image = homeward::testing::painted_panorama({}, {0.4, 0.3, 0.0}, geometry).rgb;
  for (std::uint8_t& value : image.data) value = static_cast<std::uint8_t>(2 * (value / 4));
  return image;
}

Image with_gain_and_offset(Image image, const std::array<double, 3>& gain, const std::array<double, 3>& offset) {
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = static_cast<std::uint8_t>(std::lround(gain[i % 3] * image.data[i] + offset[i % 3]));
  }
  return image;
}

TEST(ColourCorrelations, GainAndOffsetOfTheBandsChangeNothing) {
  const Image before = even_values();
  const std::array<Image, 3> after = {with_gain_and_offset(before, {1.5, 1.5, 1.5}, {40.0, 40.0, 40.0}),
                                      with_gain_and_offset(before, {1.0, 1.0, 1.0}, {100.0, 100.0, 100.0}),
                                      with_gain_and_offset(before, {1.5, 1.0, 2.0}, {0.0, 90.0, 3.0})};
  for (const double u_px : {0.0, 37.0, 128.0, 250.5}) {
    for (const double radius_px : {4.0, 9.0, 20.0}) {
      const auto expected = colour_correlations(before, u_px, 24.0, radius_px);
      for (const Image& changed : after) {
        const auto measured = colour_correlations(changed, u_px, 24.0, radius_px);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(measured[k], expected[k], 1e-3) << u_px << " " << radius_px;
      }
      for (const double value : expected) EXPECT_NE(value, 0.0);
    }
  }
}

camera::Panorama whole(const Image& image) {
  camera::Panorama panorama;
  panorama.rgb = image;
  panorama.valid.assign(static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px), 1);
  return panorama;
}

TEST(ColourCorrelations, OfAWholePictureAreThoseOfItsBands) {
  // Green is red, blue is red turned round: +1, -1, -1; then red up and down, green up, up, down, down: 0.
  camera::Panorama panorama;
  panorama.rgb = Image(4, 1, 3);
  panorama.valid = {1, 1, 1, 1};
  panorama.rgb.data = {10, 20, 90, 30, 40, 70, 50, 60, 50, 70, 80, 30};
  auto measured = colour_correlations(panorama);
  EXPECT_DOUBLE_EQ(measured[0], 1.0);
  EXPECT_DOUBLE_EQ(measured[1], -1.0);
  EXPECT_DOUBLE_EQ(measured[2], -1.0);
  panorama.rgb.data = {0, 0, 7, 100, 0, 7, 0, 100, 7, 100, 100, 7};
  measured = colour_correlations(panorama);
  EXPECT_DOUBLE_EQ(measured[0], 0.0);
  EXPECT_DOUBLE_EQ(measured[1], 0.0) << "blue does not vary";
  panorama.rgb.data = {10, 20, 90, 30, 40, 70, 50, 60, 50, 255, 0, 255};
  panorama.valid[3] = 0;  // what the camera does not see does not count
  EXPECT_DOUBLE_EQ(colour_correlations(panorama)[0], 1.0);
  panorama.valid.assign(4, 0);
  EXPECT_EQ(colour_correlations(panorama), (std::array<double, 3>{}));
}

TEST(ColourCorrelations, GainAndOffsetChangeNothingInAWholePicture) {
  const Image before = even_values();
  const auto expected = colour_correlations(whole(before));
  for (const double value : expected) EXPECT_NE(value, 0.0);
  const auto measured = colour_correlations(whole(with_gain_and_offset(before, {1.5, 1.0, 2.0}, {0.0, 90.0, 3.0})));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(measured[k], expected[k], 1e-12);
}

TEST(ColourCorrelations, RoundingToGreyLevelsCostsLittle) {
  const Image before = even_values();
  const Image after = with_gain_and_offset(before, {1.37, 1.37, 1.37}, {11.3, 11.3, 11.3});
  double worst = 0.0;
  for (double u_px = 0.0; u_px < 256.0; u_px += 16.0) {
    const auto a = colour_correlations(before, u_px, 24.0, 9.0);
    const auto b = colour_correlations(after, u_px, 24.0, 9.0);
    for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(ColourCorrelations, TheEightBitFormIsTheirRounding) {
  const Image image = even_values();
  for (double u_px = 0.0; u_px < 256.0; u_px += 31.0) {
    const auto exact = colour_correlations(image, u_px, 30.0, 7.0);
    const auto bytes = colour_invariants(image, u_px, 30.0, 7.0);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(std::abs(exact[k]), 1.0);
      EXPECT_NEAR(bytes[k], 127.0 * exact[k], 0.5);
    }
  }
}

TEST(Monochrome, IsAPictureWithoutAnyColourWhereTheCameraSees) {
  camera::Panorama panorama;
  panorama.rgb = Image(2, 1, 3);
  panorama.valid = {1, 1};
  panorama.rgb.data = {9, 9, 9, 200, 200, 200};
  EXPECT_TRUE(is_monochrome(panorama));
  panorama.rgb.data[5] = 201;
  EXPECT_FALSE(is_monochrome(panorama));
  panorama.valid[1] = 0;
  EXPECT_TRUE(is_monochrome(panorama));
}

TEST(ColoursAgree, UnlessABandDiffersTooMuchAndAlwaysWithoutColour) {
  const std::array<std::int8_t, 3> a = {100, 0, -100};
  const std::array<std::int8_t, 3> near = {60, 30, -127};
  const std::array<std::int8_t, 3> far = {100, 0, 10};
  const std::array<std::int8_t, 3> none = {kNoColour, kNoColour, kNoColour};
  EXPECT_TRUE(colours_agree(a.data(), near.data(), 50));
  EXPECT_FALSE(colours_agree(a.data(), far.data(), 50));
  EXPECT_TRUE(colours_agree(a.data(), none.data(), 0));
  EXPECT_TRUE(colours_agree(none.data(), far.data(), 0));
}

}  // namespace
}  // namespace homeward::features::colour_test
