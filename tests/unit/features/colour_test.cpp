// SPDX-License-Identifier: Apache-2.0
#include "features/colour.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/painted_room.hpp"

namespace homeward::features {
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

}  // namespace
}  // namespace homeward::features
