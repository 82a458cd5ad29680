// SPDX-License-Identifier: Apache-2.0
#include "linemodel/resample.hpp"

#include <gtest/gtest.h>

namespace homeward::linemodel {
namespace {

std::vector<Particle> weighted(const std::vector<double>& weights) {
  std::vector<Particle> particles;
  for (std::size_t i = 0; i < weights.size(); ++i)
    particles.push_back({{static_cast<double>(i), 0.0, 0.0}, weights[i]});
  return particles;
}

TEST(LowVarianceResample, DrawsEachAsOftenAsItsWeightSaysRoundedUpOrDown) {
  const std::vector<double> weights = {0.05, 0.31, 0.0, 0.44, 0.2};
  for (const double draw : {0.0, 0.3, 0.77, 0.999}) {
    std::array<int, 5> drawn{};
    for (const Particle& one : low_variance_resample(weighted(weights), 100, draw)) {
      ++drawn[static_cast<std::size_t>(one.pose.x_m)];
      EXPECT_DOUBLE_EQ(one.weight, 0.01);
    }
    for (std::size_t i = 0; i < weights.size(); ++i) EXPECT_NEAR(drawn[i], 100.0 * weights[i], 1.0) << i;
  }
}

TEST(EffectiveCount, IsAllOfEqualWeightsAndOneOfASingle) {
  EXPECT_NEAR(effective_count(weighted({0.25, 0.25, 0.25, 0.25})), 4.0, 1e-12);
  EXPECT_NEAR(effective_count(weighted({0.0, 1.0, 0.0})), 1.0, 1e-12);
}

TEST(EnoughParticles, GrowWithTheBinsThatTheBeliefFills) {
  KldConfig config;
  config.least = 10;
  std::vector<Particle> wide;
  for (int i = 0; i < 400; ++i) wide.push_back({{0.3 * (i % 20), 0.3 * (i / 20), 0.0}, 1.0});
  const std::vector<Particle> narrow(400, Particle{{1.0, 1.0, 0.0}, 1.0});
  EXPECT_EQ(enough_particles(narrow, config), 10U);
  // Fox 2003, eq. 7 by hand: 400 bins, z = 2.33, epsilon 0.05.
  const double part = 2.0 / (9.0 * 399.0);
  const double by_hand = 399.0 / 0.1 * std::pow(1.0 - part + std::sqrt(part) * 2.33, 3.0);
  EXPECT_NEAR(static_cast<double>(enough_particles(wide, config)), by_hand, 1.0);
  config.most = 100;
  EXPECT_EQ(enough_particles(wide, config), 100U);
}

}  // namespace
}  // namespace homeward::linemodel
