// SPDX-License-Identifier: Apache-2.0
#include "camera/mirror_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace homeward::camera::mirror_ring_test {
namespace {

struct Drawn {
  Eigen::Vector2d centre_px{331.3, 228.8};
  double radius_min_px = 42.0;
  double radius_max_px = 205.4;
  int seed = 1;
  double dark_from_rad = 0.0;  // a part of the surroundings is as dark as the rim
  double dark_to_rad = 0.0;
};

/// A ring of coloured-in boxes before a dark surrounding with noise; edges a pixel wide.
Image draw(const Drawn& drawn, int width_px = 640, int height_px = 480) {
  std::mt19937_64 random(static_cast<std::uint64_t>(drawn.seed));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> greys;
  for (int i = 0; i < 24 * 6; ++i) greys.push_back(70.0 + 170.0 * unit(random));
  Image picture(width_px, height_px, 1);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const Eigen::Vector2d off_px = Eigen::Vector2d(u, v) - drawn.centre_px;
      const double radius_px = off_px.norm();
      const double azimuth_rad = std::atan2(off_px.y(), off_px.x()) + M_PI;
      const int sector = std::min(23, static_cast<int>(azimuth_rad / (2.0 * M_PI) * 24.0));
      const int band = std::clamp(static_cast<int>(6.0 * radius_px / drawn.radius_max_px), 0, 5);
      double grey = greys[static_cast<std::size_t>(6 * sector + band)];
      if (azimuth_rad > drawn.dark_from_rad && azimuth_rad < drawn.dark_to_rad) grey = 20.0;
      const double inside = std::clamp(drawn.radius_max_px - radius_px + 0.5, 0.0, 1.0) *
                            std::clamp(radius_px - drawn.radius_min_px + 0.5, 0.0, 1.0);
      const double value = 18.0 + inside * (grey - 18.0) + 4.0 * (unit(random) - 0.5);
      *picture.at(u, v) = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    }
  }
  return picture;
}

TEST(MirrorRing, IsFoundToAFractionOfAPixel) {
  const Drawn drawn;
  const auto ring = find_mirror_ring({draw(drawn)});
  ASSERT_TRUE(ring) << ring.error().message;
  EXPECT_LT((ring->centre_px - drawn.centre_px).norm(), 0.2);
  EXPECT_NEAR(ring->radius_max_px, drawn.radius_max_px, 0.3);
  EXPECT_NEAR(ring->radius_min_px, drawn.radius_min_px, 0.5);
  EXPECT_GT(ring->rim_share, 0.95);
  EXPECT_LT(ring->spread_px, 0.5);
}

TEST(MirrorRing, MayLieFarFromTheMiddleAndBeCutByTheEdge) {
  Drawn drawn;
  drawn.centre_px = {250.6, 270.2};
  drawn.radius_max_px = 251.0;
  const auto ring = find_mirror_ring({draw(drawn)});
  ASSERT_TRUE(ring) << ring.error().message;
  EXPECT_LT((ring->centre_px - drawn.centre_px).norm(), 0.3);
  EXPECT_NEAR(ring->radius_max_px, drawn.radius_max_px, 0.3);
}

TEST(MirrorRing, SeveralPicturesMakeItSurer) {
  Drawn one;
  one.dark_from_rad = 0.5;
  one.dark_to_rad = 3.0;
  Drawn other;
  other.seed = 2;
  other.dark_from_rad = 3.5;
  other.dark_to_rad = 5.5;
  const auto alone = find_mirror_ring({draw(one)});
  const auto both = find_mirror_ring({draw(one), draw(other)});
  ASSERT_TRUE(alone) << alone.error().message;
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_LT(alone->rim_share, 0.75);
  EXPECT_GT(both->rim_share, 0.95);
  EXPECT_LT(both->centre_deviation_px, alone->centre_deviation_px);
  EXPECT_LT((alone->centre_px - one.centre_px).norm(), 0.5);
  EXPECT_LT((both->centre_px - one.centre_px).norm(), 0.3);
}

TEST(MirrorRing, WithoutAMirrorIsAnError) {
  const auto code_of = [](const std::vector<Image>& pictures) {
    const auto ring = find_mirror_ring(pictures);
    EXPECT_FALSE(ring) << "radius " << (ring ? ring->radius_max_px : 0.0) << ", share "
                       << (ring ? ring->rim_share : 0.0);
    return ring ? ErrorCode::kInternal : ring.error().code;
  };
  Drawn full;  // boxes everywhere: no rim in the picture
  full.radius_min_px = -5.0;
  full.radius_max_px = 5000.0;
  EXPECT_EQ(code_of({}), ErrorCode::kEmptyInput);
  EXPECT_EQ(code_of({Image(640, 480, 1)}), ErrorCode::kTooLittleSupport);
  EXPECT_EQ(code_of({draw(full)}), ErrorCode::kTooLittleSupport);
  EXPECT_EQ(code_of({Image(32, 480, 1)}), ErrorCode::kInvalidInput);
  EXPECT_EQ(code_of({Image(640, 480, 1), Image(640, 481, 1)}), ErrorCode::kWrongImageSize);
  Image noise(640, 480, 3);
  std::mt19937_64 random(1);
  for (std::uint8_t& value : noise.data) value = static_cast<std::uint8_t>(random());
  EXPECT_EQ(code_of({noise}), ErrorCode::kTooLittleSupport);
}

}  // namespace
}  // namespace homeward::camera::mirror_ring_test
