// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace homeward::features {

inline constexpr int kCells = 4;       // of a descriptor, in a row and in a column
inline constexpr int kDirections = 8;  // of the gradient, of each cell

/// Histograms of directions by row of cells, direction and column of cells, with a margin of one cell and one direction
/// before and behind, which takes what falls outside. Columns are filled up to one vector register.
struct CellHistograms {
  static constexpr int kColumns = 8;
  static constexpr int kRowSize = (kDirections + 2) * kColumns;
  alignas(32) std::array<std::array<float, kRowSize>, kCells + 2> rows{};

  /// Cells are counted from the margin's on.
  [[nodiscard]] float& at(int row, int column, int direction) {
    const int place = direction * kColumns + column;
    return rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(place)];
  }
};

/// Where the rows or the columns of a window lie among the cells, each between the middles of two neighbours.
struct CellPlaces {
  static constexpr std::size_t kMore = 7;  // places of any content, so that whole vector registers can be read

  std::size_t count = 0;
  std::vector<int> cell;      // the one before, counted from the margin's on
  std::vector<float> share;   // of the one behind
  std::vector<float> weight;  // of the window

  void resize(std::size_t places) {
    count = places;
    cell.resize(places + kMore);
    share.resize(places + kMore);
    weight.resize(places + kMore);
  }
};

/// A number for each pixel of a window, row by row, and CellPlaces::kMore of any content.
struct WindowGradients {
  const float* angles_deg;  // 0 to 360
  const float* magnitudes;
};

/// Memory that add_window needs, of any content.
struct WindowScratch {
  std::vector<int> offsets;
  std::vector<float> amounts;
};

/// Adds a window's gradients to `histograms`, each shared out among the nearest two rows of cells, columns of cells and
/// directions (Lowe 2004, §6.1). With the vector instructions that the processor has: the same numbers.
void add_window(const WindowGradients& gradients, const CellPlaces& columns, const CellPlaces& rows,
                WindowScratch& scratch, CellHistograms& histograms);

}  // namespace homeward::features
