// SPDX-License-Identifier: Apache-2.0
#include "mapping/dempster_shafer.hpp"

#include <gtest/gtest.h>

#include <random>

namespace homeward::mapping::dempster_shafer_test {
namespace {

map::Masses random_masses(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double a = uniform(random);
  const double b = uniform(random);
  return {std::min(a, b), std::abs(a - b), 1.0 - std::max(a, b)};
}

void expect_equal(const map::Masses& a, const map::Masses& b, double tolerance) {
  EXPECT_NEAR(a.is_true, b.is_true, tolerance);
  EXPECT_NEAR(a.is_false, b.is_false, tolerance);
  EXPECT_NEAR(a.unknown, b.unknown, tolerance);
}

TEST(DempsterShafer, CombinesAsByHand) {
  // Conflict 0.6 * 0.2 + 0.1 * 0.5 = 0.17; true (0.30 + 0.18 + 0.15) / 0.83; false (0.02 + 0.03 + 0.06) / 0.83;
  // unknown 0.09 / 0.83.
  const map::Masses combined = combine({0.6, 0.1, 0.3}, {0.5, 0.2, 0.3});
  expect_equal(combined, {0.63 / 0.83, 0.11 / 0.83, 0.09 / 0.83}, 1e-12);
  // Two witnesses of 0.75 * 1 leave a sixteenth of doubt.
  expect_equal(combine({0.75, 0.0, 0.25}, {0.75, 0.0, 0.25}), {0.9375, 0.0, 0.0625}, 1e-12);
}

TEST(DempsterShafer, IsCommutativeAndAssociativeAndSumsToOne) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 500; ++round) {
    const map::Masses a = random_masses(random);
    const map::Masses b = random_masses(random);
    const map::Masses c = random_masses(random);
    const map::Masses ab = combine(a, b);
    expect_equal(ab, combine(b, a), 1e-12);
    expect_equal(combine(ab, c), combine(a, combine(b, c)), 1e-9);
    EXPECT_NEAR(ab.is_true + ab.is_false + ab.unknown, 1.0, 1e-12);
    EXPECT_GE(ab.is_true, 0.0);
    EXPECT_GE(ab.is_false, 0.0);
    EXPECT_LE(ab.unknown,
              std::min(a.unknown, b.unknown) / (1.0 - a.is_true * b.is_false - a.is_false * b.is_true) + 1e-12);
    EXPECT_LE(support(ab), plausibility(ab));
  }
}

TEST(DempsterShafer, IgnoranceChangesNothing) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 50; ++round) {
    const map::Masses a = random_masses(random);
    expect_equal(combine(a, {0.0, 0.0, 1.0}), a, 1e-12);
  }
}

TEST(DempsterShafer, TotalConflictLeavesIgnorance) {
  expect_equal(combine({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0}, 0.0);
}

TEST(DempsterShafer, SupportAndPlausibilityBoundTheProbability) {
  const map::Masses masses{0.5, 0.2, 0.3};
  EXPECT_DOUBLE_EQ(support(masses), 0.5);
  EXPECT_DOUBLE_EQ(plausibility(masses), 0.8);
}

TEST(NeighbourWeight, FallsFromOneToZeroAsASine) {
  EXPECT_DOUBLE_EQ(neighbour_weight(0.0, 24.0), 1.0);
  EXPECT_NEAR(neighbour_weight(8.0, 24.0), 0.5, 1e-12);  // sin 30 degrees
  EXPECT_NEAR(neighbour_weight(12.0, 24.0), 1.0 - std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(neighbour_weight(24.0, 24.0), 0.0, 1e-12);
  EXPECT_EQ(neighbour_weight(24.1, 24.0), 0.0);
  EXPECT_EQ(neighbour_weight(1e6, 24.0), 0.0);
}

TEST(Evidence, SharesItsWeightBySimilarity) {
  expect_equal(evidence(0.8, 0.75), {0.6, 0.15, 0.25}, 1e-12);
  expect_equal(evidence(1.0, 0.0), {0.0, 0.0, 1.0}, 1e-12);
  expect_equal(evidence(0.0, 1.0), {0.0, 1.0, 0.0}, 1e-12);
}

}  // namespace
}  // namespace homeward::mapping::dempster_shafer_test
