// SPDX-License-Identifier: Apache-2.0
#include "sim/texture.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sim/lighting.hpp"

namespace homeward::sim::texture_test {
namespace {

Image noise_texture(int width_px, int height_px) {
  Image image(width_px, height_px, 3);
  std::mt19937_64 random(3);
  for (std::uint8_t& value : image.data) value = static_cast<std::uint8_t>(random());
  return image;
}

float linear(const Image& image, int x, int y, int band) {
  const int column = ((x % image.width_px) + image.width_px) % image.width_px;
  const int row = ((y % image.height_px) + image.height_px) % image.height_px;
  return linear_from_srgb(image.at(column, row)[band]);
}

TEST(TextureTest, IsBilinearBetweenTexelsAndRepeats) {
  const Image image = noise_texture(12, 7);
  const MipTexture texture(image);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<float> anywhere(-2.0F, 3.0F);
  for (int i = 0; i < 500; ++i) {
    const float u = anywhere(random);
    const float v = anywhere(random);
    const float x = (u - std::floor(u)) * 12.0F - 0.5F;
    const float y = (v - std::floor(v)) * 7.0F - 0.5F;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const float right = x - std::floor(x);
    const float below = y - std::floor(y);
    const Eigen::Array4f colour = texture.sample(u, v, 1.0F);
    for (int band = 0; band < 3; ++band) {
      const float expected =
          (1.0F - below) * ((1.0F - right) * linear(image, x0, y0, band) + right * linear(image, x0 + 1, y0, band)) +
          below * ((1.0F - right) * linear(image, x0, y0 + 1, band) + right * linear(image, x0 + 1, y0 + 1, band));
      ASSERT_EQ(colour[band], expected) << u << " " << v;
    }
  }
}

TEST(TextureTest, FromAfarShowsTheMean) {
  const Image image = noise_texture(16, 16);
  const MipTexture texture(image);
  for (int band = 0; band < 3; ++band) {
    float sum = 0.0F;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) sum += linear(image, x, y, band);
    }
    EXPECT_NEAR(texture.sample(0.3F, 0.8F, 16.0F)[band], sum / 256.0F, 1e-5F);
    EXPECT_EQ(texture.sample(0.3F, 0.8F, 16.0F)[band], texture.sample(0.9F, 0.1F, 1e9F)[band]);
  }
}

}  // namespace
}  // namespace homeward::sim::texture_test
