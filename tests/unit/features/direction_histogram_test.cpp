// SPDX-License-Identifier: Apache-2.0
#include "features/direction_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/vector_targets.hpp"

namespace homeward::features::direction_histogram_test {
namespace {

using testing::for_each_vector_target;

/// Places of a window about the cells' middle.
CellPlaces places(int count) {
  CellPlaces made;
  made.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < made.count; ++i) {
    const float at = 4.99F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    made.cell[i] = static_cast<int>(at);
    made.share[i] = at - static_cast<float>(made.cell[i]);
    made.weight[i] = 1.0F / (1.0F + std::abs(at - 2.5F));
  }
  return made;
}

struct Gradients {
  std::vector<float> angles_deg;
  std::vector<float> magnitudes;
};

/// Of any direction, many of them in one, and the circle's both ends.
Gradients random_gradients(int pixels, unsigned seed) {
  std::mt19937 random(seed);
  Gradients made;
  for (int i = 0; i < pixels; ++i) {
    const float angle_deg = random() % 3 == 0 ? 100.0F : static_cast<float>(random() % 36001) / 100.0F;
    made.angles_deg.push_back(random() % 50 == 0 ? 360.0F : angle_deg);
    made.magnitudes.push_back(static_cast<float>(random() % 1000) / 4000.0F);
  }
  // Vector registers read on.
  made.angles_deg.resize(made.angles_deg.size() + CellPlaces::kMore, 0.0F);
  made.magnitudes.resize(made.magnitudes.size() + CellPlaces::kMore, 0.0F);
  return made;
}

/// Pixel by pixel and row by row, in the order that all processors share.
CellHistograms expected_histograms(const Gradients& gradients, const CellPlaces& columns, const CellPlaces& rows) {
  CellHistograms expected;
  for (std::size_t row = 0; row < rows.count; ++row) {
    CellHistograms of_row;  // in the first row of cells
    for (std::size_t i = 0; i < columns.count; ++i) {
      const float direction = gradients.angles_deg[row * columns.count + i] * (kDirections / 360.0F);
      const int d = static_cast<int>(direction);
      const float upper = direction - static_cast<float>(d);
      const float amount = gradients.magnitudes[row * columns.count + i] * columns.weight[i];
      const float right = amount * columns.share[i];
      const float left = amount - right;
      const int cell = columns.cell[i];
      of_row.at(0, cell, d) += left * (1.0F - upper);
      of_row.at(0, cell, d + 1) += left * upper;
      of_row.at(0, cell + 1, d) += right * (1.0F - upper);
      of_row.at(0, cell + 1, d + 1) += right * upper;
    }
    for (int c = 0; c < kCells + 2; ++c) {
      for (int d = 0; d < kDirections + 2; ++d) {
        const float amount = rows.weight[row] * of_row.at(0, c, d);
        expected.at(rows.cell[row], c, d) += (1.0F - rows.share[row]) * amount;
        expected.at(rows.cell[row] + 1, c, d) += rows.share[row] * amount;
      }
    }
  }
  return expected;
}

TEST(DirectionHistogram, EveryProcessorGivesTheSameNumbers) {
  // Whole and broken registers, and rows that are and are not a multiple of those made together.
  for (const auto& [row_count, column_count] :
       {std::pair(1, 1), {2, 7}, {3, 8}, {4, 9}, {31, 33}, {42, 48}, {45, 45}}) {
    SCOPED_TRACE(::testing::Message() << row_count << " x " << column_count);
    const CellPlaces columns = places(column_count);
    const CellPlaces rows = places(row_count);
    const Gradients gradients = random_gradients(row_count * column_count, 5);
    const CellHistograms expected = expected_histograms(gradients, columns, rows);
    for_each_vector_target([&] {
      CellHistograms histograms;
      WindowScratch scratch;
      add_window({gradients.angles_deg.data(), gradients.magnitudes.data()}, columns, rows, scratch, histograms);
      EXPECT_EQ(histograms.rows, expected.rows);
    });
  }
}

TEST(DirectionHistogram, NothingIsLost) {
  const CellPlaces columns = places(20);
  CellPlaces rows = places(30);
  const Gradients gradients = random_gradients(600, 9);
  CellHistograms histograms;
  WindowScratch scratch;
  add_window({gradients.angles_deg.data(), gradients.magnitudes.data()}, columns, rows, scratch, histograms);
  double sum = 0.0;
  for (const auto& row : histograms.rows) {
    for (const float amount : row) sum += static_cast<double>(amount);
  }
  double expected = 0.0;
  for (std::size_t r = 0; r < rows.count; ++r) {
    for (std::size_t c = 0; c < columns.count; ++c) {
      expected += static_cast<double>(gradients.magnitudes[r * columns.count + c] * rows.weight[r] * columns.weight[c]);
    }
  }
  EXPECT_NEAR(sum, expected, 1e-4);
}

TEST(DirectionHistogram, AddsToWhatIsThere) {
  const CellPlaces one = places(1);
  const Gradients gradients = random_gradients(1, 3);
  CellHistograms histograms;
  histograms.at(0, 0, 0) = 5.0F;
  WindowScratch scratch;
  add_window({gradients.angles_deg.data(), gradients.magnitudes.data()}, one, one, scratch, histograms);
  EXPECT_EQ(histograms.at(0, 0, 0), 5.0F);
}

}  // namespace
}  // namespace homeward::features::direction_histogram_test
