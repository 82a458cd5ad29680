// SPDX-License-Identifier: Apache-2.0
#include "matching/dot.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/vector_targets.hpp"

namespace homeward::matching::dot_test {
namespace {

using testing::for_each_vector_target;

TEST(Dot, IsExactOnEveryProcessor) {
  std::mt19937 random(1);
  for (const std::size_t length : {0U, 1U, 15U, 16U, 31U, 32U, 33U, 64U, 100U, 512U, 1024U, 1030U}) {
    std::vector<std::int8_t> a(length);
    std::vector<std::int8_t> b(length);
    std::int32_t expected = 0;
    for (std::size_t i = 0; i < length; ++i) {
      a[i] = static_cast<std::int8_t>(static_cast<int>(random() % 256) - 128);
      b[i] = static_cast<std::int8_t>(static_cast<int>(random() % 256) - 128);
      expected += a[i] * b[i];
    }
    for_each_vector_target([&] { EXPECT_EQ(dot(a.data(), b.data(), length), expected) << length; });
  }
}

TEST(Dot, HoldsTheLargestSums) {
  constexpr std::size_t kLength = std::size_t{1} << 16U;
  const std::vector<std::int8_t> lowest(kLength, -128);
  for_each_vector_target([&] { EXPECT_EQ(dot(lowest.data(), lowest.data(), kLength), 1 << 30); });
}

}  // namespace
}  // namespace homeward::matching::dot_test
