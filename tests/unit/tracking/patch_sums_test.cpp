// SPDX-License-Identifier: Apache-2.0
#include "tracking/patch_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/vector_targets.hpp"

namespace homeward::tracking::patch_sums_test {
namespace {

std::vector<float> noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(random() % 2560) / 10.0F;
  return values;
}

TEST(PatchSums, AreTheSumsOfBilinearSamplesTheSameOnEveryProcessor) {
  GreyLevel level(50, 40);
  level.grey = noise(level.grey.size(), 1);
  for (const int side : {7, 11, 15}) {
    const auto plane = static_cast<std::size_t>(side * kPatchStride);
    std::vector<float> planes = noise(3 * plane, 2);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (static_cast<int>(i % kPatchStride) >= side) planes[i] = 0.0F;
    }
    const PatchView patch{side, 100.0F, planes.data(), planes.data() + plane, planes.data() + 2 * plane};
    for (const PatchPlace& place : {PatchPlace{10.25, 8.5, 1.0}, PatchPlace{-6.7, -3.1, 1.43}, PatchPlace{20, 20, 0.5},
                                    PatchPlace{25.3, 22.9, 1.5}}) {
      if (!inside(level, side, place, kMostOutside_px)) continue;
      std::vector<float> seen(plane);
      sample_patch(level, side, place, seen.data(), kPatchStride);
      PatchSums wanted;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const auto at = static_cast<std::size_t>(y * kPatchStride + x);
          const double grey = static_cast<double>(seen[at]) - 100.0;
          wanted.one += grey;
          wanted.square += grey * grey;
          wanted.grey += grey * static_cast<double>(planes[at]);
          wanted.du += grey * static_cast<double>(planes[plane + at]);
          wanted.dv += grey * static_cast<double>(planes[2 * plane + at]);
          wanted.zoom += grey * (static_cast<double>(planes[plane + at]) * (x - side / 2) +
                                 static_cast<double>(planes[2 * plane + at]) * (y - side / 2));
        }
      }
      const PatchSums first = patch_sums(level, patch, place);
      testing::for_each_vector_target([&] {
        const PatchSums sums = patch_sums(level, patch, place);
        EXPECT_NEAR(sums.one, wanted.one, 0.1);
        EXPECT_NEAR(sums.square, wanted.square, 5.0);
        EXPECT_NEAR(sums.grey, wanted.grey, 10.0);
        EXPECT_NEAR(sums.du, wanted.du, 10.0);
        EXPECT_NEAR(sums.dv, wanted.dv, 10.0);
        EXPECT_NEAR(sums.zoom, wanted.zoom, 70.0);
        EXPECT_EQ(sums.one, first.one);
        EXPECT_EQ(sums.square, first.square);
        EXPECT_EQ(sums.zoom, first.zoom);
      });
    }
  }
}

TEST(PatchSums, APatchIsInsideUpToTheLastSampleThatHasNeighbours) {
  const GreyLevel level(40, 30);
  EXPECT_TRUE(inside(level, 7, {0.0, 0.0, 1.0}, 0.0));
  EXPECT_TRUE(inside(level, 7, {32.9, 22.9, 1.0}, 0.0));
  EXPECT_FALSE(inside(level, 7, {33.0, 10.0, 1.0}, 0.0));
  EXPECT_FALSE(inside(level, 7, {10.0, -0.1, 1.0}, 0.0));
  EXPECT_TRUE(inside(level, 7, {10.0, -0.1, 1.0}, 1.0));
  EXPECT_FALSE(inside(level, 7, {std::nan(""), 5.0, 1.0}, 1.0));
}

}  // namespace
}  // namespace homeward::tracking::patch_sums_test
