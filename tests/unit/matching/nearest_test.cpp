// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/vector_targets.hpp"

namespace homeward::matching::nearest_test {
namespace {

ByteDescriptors random_descriptors(int count, int length, int levels, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  ByteDescriptors descriptors(count, length);
  for (Eigen::Index i = 0; i < descriptors.size(); ++i) {
    descriptors.data()[i] = static_cast<std::uint8_t>(random() % static_cast<std::uint64_t>(levels));
  }
  return descriptors;
}

void agree(const ByteDescriptors& current, const ByteDescriptors& target) {
  const auto plain = find_nearest_portable(current, target);
  testing::for_each_vector_target([&] {
    const auto fast = find_nearest(current, target);
    EXPECT_EQ(fast.of_current, plain.of_current);
    EXPECT_EQ(fast.distance, plain.distance);
    EXPECT_EQ(fast.second_distance, plain.second_distance);
    EXPECT_EQ(fast.of_target, plain.of_target);
  });
}

TEST(Nearest, VectorInstructionsChangeNothing) {
  std::uint64_t seed = 1;
  for (const int current : {1, 2, 7, 8, 9, 34}) {
    for (const int target : {1, 2, 7, 8, 9, 16, 17, 40}) {
      for (const int length : {1, 2, 3, 7, 32, 33, 48, 128}) {
        SCOPED_TRACE(::testing::Message() << current << " x " << target << " of length " << length);
        agree(random_descriptors(current, length, 256, seed), random_descriptors(target, length, 256, seed + 1));
        seed += 2;
      }
    }
  }
}

TEST(Nearest, AmongEqualsTheFirstWins) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    agree(random_descriptors(37, 3, 3, seed), random_descriptors(29, 3, 3, seed + 100));
  }
}

TEST(Nearest, HoldsTheLargestDistances) {
  const ByteDescriptors black = ByteDescriptors::Zero(5, 1024);
  const ByteDescriptors white = ByteDescriptors::Constant(9, 1024, 255);
  agree(black, white);
  EXPECT_EQ(find_nearest(black, white).distance.front(), 1024 * 255 * 255);
}

TEST(Nearest, OneTargetHasNoSecond) {
  const auto nearest = find_nearest(random_descriptors(4, 32, 256, 1), random_descriptors(1, 32, 256, 2));
  for (const std::int32_t second : nearest.second_distance) EXPECT_EQ(second, NearestNeighbours::kNone);
}

}  // namespace
}  // namespace homeward::matching::nearest_test
