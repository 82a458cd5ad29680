// SPDX-License-Identifier: Apache-2.0
#include "sim/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/vector_targets.hpp"

namespace homeward::sim::sensor_test {
namespace {

TEST(SensorTest, ManyAtOnceAreExposedAsOneByOne) {
  const DisplayCurve curve;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> exponent(-12.0F, 5.0F);
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<float> light(count);
    for (float& one : light) one = std::exp(exponent(random));
    if (count > 3) light[count / 2] = 0.0F;
    const std::uint64_t first_key = random();
    const float noise_levels = count % 2 == 0 ? 3.0F : 0.0F;
    std::vector<std::uint8_t> levels(count);
    testing::for_each_vector_target([&] {
      expose(curve, light.data(), count, first_key, noise_levels, levels.data());
      for (std::size_t i = 0; i < count; ++i) {
        const float level = curve.level(light[i]) + noise_levels * sensor_noise(first_key + i);
        ASSERT_EQ(levels[i], static_cast<std::uint8_t>(std::clamp(level + 0.5F, 0.0F, 255.0F))) << count << " " << i;
      }
    });
  }
}

TEST(SensorTest, MoreLightIsBrighterFromBlackToWhite) {
  const DisplayCurve curve;
  EXPECT_FLOAT_EQ(curve.level(0.0F), 0.0F);
  float last = -1.0F;
  for (float light = 0.0F; light < 6.0F; light += 0.03F) {
    EXPECT_GT(curve.level(light), last);
    last = curve.level(light);
  }
  EXPECT_NEAR(curve.level(1000.0F), 255.0F, 0.01F);
}

TEST(SensorTest, NoiseHasNoMeanAndUnitVariance) {
  double sum = 0.0;
  double sum2 = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double noise = static_cast<double>(sensor_noise(static_cast<std::uint64_t>(i)));
    sum += noise;
    sum2 += noise * noise;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(sum2 / kCount, 1.0, 0.02);
}

}  // namespace
}  // namespace homeward::sim::sensor_test
