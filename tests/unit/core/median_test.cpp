// SPDX-License-Identifier: Apache-2.0
#include "core/median.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace homeward::median_test {
namespace {

TEST(Median, IsTheMiddleOfOddAndTheUpperMiddleOfEvenNumbers) {
  EXPECT_EQ(median(std::vector<double>{3.0}), 3.0);
  EXPECT_EQ(median(std::vector<double>{5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median(std::vector<int>{4, 1, 3, 2}), 3);
}

TEST(Median, HoldsInfinities) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(median(std::vector<float>{kInfinity, 1.0F, kInfinity}), kInfinity);
  EXPECT_EQ(median(std::vector<float>{kInfinity, 1.0F, 2.0F}), 2.0F);
}

}  // namespace
}  // namespace homeward::median_test
