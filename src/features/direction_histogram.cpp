// SPDX-License-Identifier: Apache-2.0
#include "features/direction_histogram.hpp"

#include <algorithm>
#include <cstddef>

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/direction_histogram.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::features {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
constexpr int kLanes = hn::MaxLanes(Lanes());
constexpr std::ptrdiff_t kQuad = 4;  // a pixel's amounts: left and right cell of the lower direction, then of the upper
constexpr int kTogether = 4;         // rows
static_assert(kLanes <= static_cast<int>(CellPlaces::kMore) + 1);

/// Shares one row's magnitudes out: for each pixel where its lower direction's left cell is in a row of cells, and
/// its four amounts.
void share_out(const float* angles_deg, const float* magnitudes, const CellPlaces& columns, int count, int* offsets,
               float* amounts) {
  const Lanes f;
  const hn::RebindToSigned<Lanes> whole;
  const auto per_degree = hn::Set(f, kDirections / 360.0F);
  const auto one = hn::Set(f, 1.0F);
  const auto row_of_columns = hn::Set(whole, CellHistograms::kColumns);
  for (int i = 0; i < count; i += kLanes) {
    const auto direction = hn::LoadU(f, angles_deg + i) * per_degree;
    const auto lower = hn::ConvertTo(whole, direction);
    const auto upper_share = direction - hn::ConvertTo(f, lower);
    const auto lower_share = one - upper_share;
    const auto amount = hn::LoadU(f, magnitudes + i) * hn::LoadU(f, columns.weight.data() + i);
    const auto right = amount * hn::LoadU(f, columns.share.data() + i);
    const auto left = amount - right;
    hn::StoreU(lower * row_of_columns + hn::LoadU(whole, columns.cell.data() + i), whole, offsets + i);
    hn::StoreInterleaved4(left * lower_share, right * lower_share, left * upper_share, right * upper_share, f,
                          amounts + kQuad * i);
  }
}

/// Adds two neighbours at once, which the processor hands from one store to the next load of them.
inline void add_pair(const float* amounts, float* to) {
  const hn::CappedTag<float, 2> pair;
  for (std::size_t lane = 0; lane < 2; lane += hn::MaxLanes(pair)) {
    hn::StoreU(hn::LoadU(pair, to + lane) + hn::LoadU(pair, amounts + lane), pair, to + lane);
  }
}

using RowOfCells = std::array<float, CellHistograms::kRowSize>;

/// Adds each of kRows rows to its own histograms, in turn: what follows a sum into the same place waits for it.
template <int kRows>
void fill(const int* offsets, const float* amounts, std::ptrdiff_t stride, int count,
          std::array<RowOfCells, kTogether>& of_rows) {
  for (int i = 0; i < count; ++i) {
    for (int r = 0; r < kRows; ++r) {
      const std::ptrdiff_t at = r * stride + i;
      float* to = of_rows[static_cast<std::size_t>(r)].data() + offsets[at];
      add_pair(amounts + kQuad * at, to);
      add_pair(amounts + kQuad * at + 2, to + CellHistograms::kColumns);
    }
  }
}

/// Shares a row's histograms out between the cells above and below it; `share`: what those below get.
void add_row(const RowOfCells& of_row, float weight, float share, RowOfCells& above, RowOfCells& below) {
  const Lanes f;
  const auto weights = hn::Set(f, weight);
  const auto shares_below = hn::Set(f, share);
  const auto shares_above = hn::Set(f, 1.0F - share);
  for (int i = 0; i < CellHistograms::kRowSize; i += kLanes) {
    const auto amount = weights * hn::LoadU(f, of_row.data() + i);
    hn::StoreU(hn::LoadU(f, above.data() + i) + shares_above * amount, f, above.data() + i);
    hn::StoreU(hn::LoadU(f, below.data() + i) + shares_below * amount, f, below.data() + i);
  }
}

void add_window(const WindowGradients& gradients, const CellPlaces& columns, const CellPlaces& rows,
                WindowScratch& scratch, CellHistograms& histograms) {
  const int count = static_cast<int>(columns.count);
  const int row_count = static_cast<int>(rows.count);
  const std::size_t room = columns.count + CellPlaces::kMore;  // of a row
  const auto stride = static_cast<std::ptrdiff_t>(room);
  scratch.offsets.resize(kTogether * room);
  scratch.amounts.resize(kQuad * kTogether * room);
  for (int first = 0; first < row_count; first += kTogether) {
    const int together = std::min(kTogether, row_count - first);
    for (int r = 0; r < together; ++r) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(first + r) * count;
      share_out(gradients.angles_deg + from, gradients.magnitudes + from, columns, count,
                scratch.offsets.data() + r * stride, scratch.amounts.data() + kQuad * r * stride);
    }
    alignas(32) std::array<RowOfCells, kTogether> of_rows{};
    const auto fill_rows = together == kTogether ? fill<kTogether>
                           : together == 3       ? fill<3>
                           : together == 2       ? fill<2>
                                                 : fill<1>;
    fill_rows(scratch.offsets.data(), scratch.amounts.data(), stride, count, of_rows);
    for (int r = 0; r < together; ++r) {
      const int place = first + r;
      const auto row = static_cast<std::size_t>(place);
      const auto cell = static_cast<std::size_t>(rows.cell[row]);
      add_row(of_rows[static_cast<std::size_t>(r)], rows.weight[row], rows.share[row], histograms.rows[cell],
              histograms.rows[cell + 1]);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::features
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::features {

HWY_EXPORT(add_window);

void add_window(const WindowGradients& gradients, const CellPlaces& columns, const CellPlaces& rows,
                WindowScratch& scratch, CellHistograms& histograms) {
  HWY_DYNAMIC_DISPATCH(add_window)(gradients, columns, rows, scratch, histograms);
}

}  // namespace homeward::features
#endif
