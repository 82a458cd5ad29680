// SPDX-License-Identifier: Apache-2.0
#include "homing/visual_compass.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/painted_room.hpp"

namespace homeward::homing::visual_compass_test {
namespace {

using testing::painted_panorama;

double off_deg(double angle_rad, double truth_rad) { return std::abs(degrees(wrap_angle(angle_rad - truth_rad))); }

TEST(VisualCompass, ReadsTheTurnOnTheSpot) {
  const camera::Panorama home = painted_panorama({}, {0.3, 0.2, 0.5});
  for (const double turn_rad : {0.0, 0.01, 0.4, 1.7, -1.0, -3.1}) {
    const auto reading = visual_compass(painted_panorama({}, {0.3, 0.2, 0.5 - turn_rad}), home);
    ASSERT_TRUE(reading) << reading.error().message;
    EXPECT_LT(off_deg(reading->turn_rad, turn_rad), 0.4) << turn_rad;
    EXPECT_GT(reading->sharpness, 0.8);
  }
}

TEST(VisualCompass, HoldsNearTheTarget) {
  const camera::Panorama home = painted_panorama({}, {0.3, 0.2, 0.5});
  const auto reading = visual_compass(painted_panorama({}, {0.5, 0.1, 1.3}), home);
  ASSERT_TRUE(reading);
  EXPECT_LT(off_deg(reading->turn_rad, -0.8), 6.0);
}

TEST(VisualCompass, LightMakesNoDifference) {
  const camera::Panorama home = painted_panorama({}, {0.3, 0.2, 0.5});
  camera::Panorama dim = painted_panorama({}, {0.3, 0.2, 0.2});
  for (std::uint8_t& value : dim.rgb.data) value = static_cast<std::uint8_t>(value / 3 + 10);
  const auto reading = visual_compass(dim, home);
  ASSERT_TRUE(reading);
  EXPECT_LT(off_deg(reading->turn_rad, 0.3), 0.5);
}

TEST(VisualCompass, AnotherRoomIsNotSharp) {
  testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const auto reading = visual_compass(painted_panorama(elsewhere, {}), painted_panorama({}, {}));
  ASSERT_TRUE(reading);
  EXPECT_LT(reading->sharpness, 0.5);
}

TEST(VisualCompass, PicturesWithoutDirectionAreRefused) {
  const camera::Panorama home = painted_panorama({}, {});
  camera::Panorama grey = home;
  std::ranges::fill(grey.rgb.data, std::uint8_t{90});
  const auto flat = visual_compass(grey, home);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::kTooFewFeatures);
  camera::Panorama narrow = home;
  for (std::size_t i = 0; i < narrow.valid.size(); ++i) narrow.valid[i] = i % 1024 < 300 ? 1 : 0;
  const auto partly = visual_compass(narrow, home);
  ASSERT_FALSE(partly);
  EXPECT_EQ(partly.error().code, ErrorCode::kInvalidInput);
  const auto other_size = visual_compass(painted_panorama({}, {}, {512, 0.34, -0.95}), home);
  ASSERT_FALSE(other_size);
  EXPECT_EQ(other_size.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::homing::visual_compass_test
