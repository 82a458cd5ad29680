// SPDX-License-Identifier: Apache-2.0
#include "features/blur_strips.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/vector_targets.hpp"

namespace homeward::features::blur_strips_test {
namespace {

using testing::for_each_vector_target;

struct Grid {
  int rows;
  int columns;
  std::vector<float> numbers;

  Grid(int r, int c) : rows(r), columns(c), numbers(static_cast<std::size_t>(r) * static_cast<std::size_t>(c), 0.0F) {}
  float& at(int r, int c) { return numbers[static_cast<std::size_t>(r * columns + c)]; }
  [[nodiscard]] float mirrored(int r, int c) const {
    const auto inside = [](int i, int count) { return i < 0 ? -i : i < count ? i : 2 * (count - 1) - i; };
    return numbers[static_cast<std::size_t>(inside(r, rows) * columns + inside(c, columns))];
  }
};

Grid noise(int rows, int columns) {
  std::mt19937 random(7);
  Grid grid(rows, columns);
  for (float& number : grid.numbers) number = static_cast<float>(random() % 1000) / 1000.0F;
  return grid;
}

std::vector<float> symmetric_kernel(int taps) {
  std::vector<float> kernel(static_cast<std::size_t>(taps));
  const int middle = taps / 2;
  for (int k = 0; k < taps; ++k) {
    const auto off = static_cast<float>(k - middle) / static_cast<float>(middle + 1);
    kernel[static_cast<std::size_t>(k)] = (1.0F - off * off) / static_cast<float>(taps);
  }
  return kernel;
}

/// The order of operations that all processors share: along the rows from the left, down the columns from the middle.
Grid expected_blur(const Grid& from, const std::vector<float>& kernel) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  const auto weight = [&](int k) { return kernel[static_cast<std::size_t>(k)]; };
  Grid along(from.rows, from.columns);
  Grid to = along;
  for (int r = 0; r < from.rows; ++r) {
    for (int c = 0; c < from.columns; ++c) {
      float sum = from.mirrored(r, c - reach) * weight(0);
      for (int k = 1; k <= 2 * reach; ++k) sum = std::fma(from.mirrored(r, c - reach + k), weight(k), sum);
      along.at(r, c) = sum;
    }
  }
  for (int r = 0; r < from.rows; ++r) {
    for (int c = 0; c < from.columns; ++c) {
      float sum = along.mirrored(r, c) * weight(reach);
      for (int k = 1; k <= reach; ++k) {
        sum = std::fma(along.mirrored(r + k, c) + along.mirrored(r - k, c), weight(reach + k), sum);
      }
      to.at(r, c) = sum;
    }
  }
  return to;
}

TEST(BlurStrips, EveryProcessorGivesTheSameNumbers) {
  int able = 0;
  // Narrower and wider than a strip, whole and broken vectors, even and odd rows, kernels nearly as large as the
  // picture.
  for (const auto& [rows, columns] :
       {std::pair(16, 17), {40, 64}, {31, 255}, {30, 256}, {29, 257}, {15, 300}, {50, 700}}) {
    const Grid picture = noise(rows, columns);
    for (const int taps : {3, 11, 27}) {
      const std::vector<float> kernel = symmetric_kernel(taps);
      const Grid expected = expected_blur(picture, kernel);
      for_each_vector_target([&] {
        Grid blurred(rows, columns);
        if (!blur_by_strips({picture.numbers.data(), columns, rows, columns}, kernel,
                            {blurred.numbers.data(), columns, rows, columns})) {
          return;
        }
        ++able;
        EXPECT_EQ(blurred.numbers, expected.numbers) << columns << " x " << rows << ", " << taps << " weights";
      });
    }
  }
  if (able == 0) GTEST_SKIP() << "this processor has no fused multiply-add";
}

TEST(BlurStrips, RowsMayLieApart) {
  const Grid picture = noise(12, 40);
  const std::vector<float> kernel = symmetric_kernel(5);
  Grid wide(12, 50);
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 40; ++c) wide.at(r, c) = picture.mirrored(r, c);
  }
  Grid blurred(12, 50);
  if (!blur_by_strips({wide.numbers.data(), 50, 12, 40}, kernel, {blurred.numbers.data(), 50, 12, 40})) {
    GTEST_SKIP() << "this processor has no fused multiply-add";
  }
  const Grid expected = expected_blur(picture, kernel);
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 50; ++c) EXPECT_EQ(blurred.at(r, c), c < 40 ? expected.mirrored(r, c) : 0.0F);
  }
}

}  // namespace
}  // namespace homeward::features::blur_strips_test
