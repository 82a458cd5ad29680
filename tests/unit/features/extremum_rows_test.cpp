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

using Bands = std::array<RowBand, kDifferences>;

std::vector<Candidate> expected_candidates(const Bands& bands, int first, int end, float floor) {
  std::vector<Candidate> expected;
  for (std::size_t layer = 1; layer + 1 < bands.size(); ++layer) {
    const RowBand& band = bands[layer];
    for (int c = first; c < end; ++c) {
      const float v = band.here[c];
      const auto beats = [&](float sign) {
        return sign * v > floor && sign * v >= sign * band.here[c - 1] && sign * v >= sign * band.here[c + 1] &&
               sign * v >= sign * band.above[c] && sign * v >= sign * band.below[c] &&
               sign * v >= sign * bands[layer - 1].here[c] && sign * v >= sign * bands[layer + 1].here[c];
      };
      if (beats(1.0F) || beats(-1.0F)) expected.push_back({static_cast<int>(layer), c});
    }
  }
  return expected;
}

TEST(ExtremumRows, FindWhatStandsOutInEveryColumn) {
  constexpr int kFirst = 5;
  constexpr unsigned kDraws = 40;  // in each, narrow rows have next to none that beats all its neighbours
  for (const int columns : {12, 17, 18, 25, 83, 300}) {
    for (const float floor : {0.0F, 0.2F, 0.6F}) {
      std::size_t expected_of_all = 0;
      for (unsigned draw = 0; draw < kDraws; ++draw) {
        std::vector<std::vector<float>> rows;
        for (unsigned k = 0; k < 3 * kDifferences; ++k) rows.push_back(noise(columns, 1000 * draw + k));
        Bands bands;
        for (std::size_t d = 0; d < bands.size(); ++d) {
          bands[d] = {rows[3 * d].data(), rows[3 * d + 1].data(), rows[3 * d + 2].data()};
        }
        const std::vector<Candidate> expected = expected_candidates(bands, kFirst, columns - kFirst, floor);
        expected_of_all += expected.size();
        for_each_vector_target([&] {
          std::vector<Candidate> found{{1, 2}, {3, 4}};  // of the row before
          find_candidates(bands, kFirst, columns - kFirst, floor, found);
          EXPECT_EQ(found, expected) << columns << " columns, floor " << floor << ", draw " << draw;
        });
      }
      EXPECT_EQ(expected_of_all == 0, floor > 0.5F) << columns << " columns, floor " << floor;
    }
  }
}

TEST(ExtremumRows, DifferencesAreOfNeighbours) {
  for (const int columns : {1, 7, 8, 21, 64}) {
    std::array<std::vector<float>, kDifferences + 1> rows;
    std::array<const float*, kDifferences + 1> sources{};
    for (unsigned k = 0; k < rows.size(); ++k) {
      rows[k] = noise(columns, k);
      sources[k] = rows[k].data();
    }
    for_each_vector_target([&] {
      std::array<std::vector<float>, kDifferences> out;
      std::array<float*, kDifferences> differences{};
      for (std::size_t k = 0; k < out.size(); ++k) {
        out[k].assign(static_cast<std::size_t>(columns), 9.0F);
        differences[k] = out[k].data();
      }
      subtract(sources, differences, columns);
      for (std::size_t k = 0; k < out.size(); ++k) {
        for (std::size_t c = 0; c < out[k].size(); ++c) EXPECT_EQ(out[k][c], rows[k + 1][c] - rows[k][c]);
      }
    });
  }
}

}  // namespace
}  // namespace homeward::features::extremum_rows_test
