// SPDX-License-Identifier: Apache-2.0
#include "features/extremum_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "support/vector_targets.hpp"

namespace homeward::features::extremum_rows_test {
namespace {

using testing::for_each_vector_target;

/// A row of numbers within -0.5 and 0.5, many of them equal.
std::vector<float> noise(int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> row;
  for (int c = 0; c < columns; ++c) row.push_back(static_cast<float>(random() % 100) / 100.0F - 0.5F);
  return row;
}

std::vector<int> expected_candidates(const RowBand& band, int first, int end, float floor) {
  std::vector<int> expected;
  for (int c = first; c < end; ++c) {
    const float v = band.here[c];
    const auto beats = [&](float sign) {
      return sign * v > floor && sign * v >= sign * band.here[c - 1] && sign * v >= sign * band.here[c + 1] &&
             sign * v >= sign * band.above[c] && sign * v >= sign * band.below[c];
    };
    if (beats(1.0F) || beats(-1.0F)) expected.push_back(c);
  }
  return expected;
}

TEST(ExtremumRows, FindWhatStandsOutInEveryColumn) {
  constexpr int kFirst = 5;
  for (const int columns : {12, 17, 18, 25, 83, 300}) {
    const std::vector<float> above = noise(columns, 11);
    const std::vector<float> here = noise(columns, 12);
    const std::vector<float> below = noise(columns, 13);
    const RowBand band{above.data(), here.data(), below.data()};
    for (const float floor : {0.0F, 0.2F, 0.6F}) {
      const std::vector<int> expected = expected_candidates(band, kFirst, columns - kFirst, floor);
      for_each_vector_target([&] {
        std::vector<int> found{1, 2, 3};  // of the row before
        find_candidates(band, kFirst, columns - kFirst, floor, found);
        EXPECT_EQ(found, expected) << columns << " columns, floor " << floor;
      });
      EXPECT_EQ(expected.empty(), floor > 0.5F || columns == 12) << columns << " columns, floor " << floor;
    }
  }
}

TEST(ExtremumRows, DifferencesAreOfNeighbours) {
  for (const int columns : {1, 7, 8, 21, 64}) {
    std::array<std::vector<float>, 4> rows;
    for (unsigned k = 0; k < rows.size(); ++k) rows[k] = noise(columns, k);
    const std::array<const float*, 4> sources = {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()};
    for_each_vector_target([&] {
      std::array<std::vector<float>, 3> out;
      for (auto& row : out) row.assign(static_cast<std::size_t>(columns), 9.0F);
      const std::array<float*, 3> differences = {out[0].data(), out[1].data(), out[2].data()};
      subtract(sources, differences, columns);
      for (std::size_t k = 0; k < out.size(); ++k) {
        for (std::size_t c = 0; c < out[k].size(); ++c) EXPECT_EQ(out[k][c], rows[k + 1][c] - rows[k][c]);
      }
    });
  }
}

}  // namespace
}  // namespace homeward::features::extremum_rows_test
