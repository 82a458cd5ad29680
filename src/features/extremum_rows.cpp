// SPDX-License-Identifier: Apache-2.0
#include "features/extremum_rows.hpp"

#include <array>
#include <bit>
#include <cstddef>

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/extremum_rows.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::features {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Sources = std::span<const float* const>;
using Differences = std::span<float* const>;

void subtract(Sources blurred, Differences differences, int columns) {
  const hn::ScalableTag<float> f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  int c = 0;
  for (; c + lanes <= columns; c += lanes) {
    auto sharp = hn::LoadU(f, blurred[0] + c);
    for (std::size_t d = 0; d < differences.size(); ++d) {
      const auto soft = hn::LoadU(f, blurred[d + 1] + c);
      hn::StoreU(soft - sharp, f, differences[d] + c);
      sharp = soft;
    }
  }
  for (std::size_t d = 0; d < differences.size(); ++d) {
    for (int rest = c; rest < columns; ++rest) differences[d][rest] = blurred[d + 1][rest] - blurred[d][rest];
  }
}

/// Whether the middle row's value at `c` stands out from the four next to it by more than `floor` in size.
bool stands_out(const RowBand& band, int c, float floor) {
  const float v = band.here[c];
  const float left = band.here[c - 1];
  const float right = band.here[c + 1];
  const float up = band.above[c];
  const float down = band.below[c];
  return (v > floor && v >= left && v >= right && v >= up && v >= down) ||
         (v < -floor && v <= left && v <= right && v <= up && v <= down);
}

void find_candidates(const RowBand& band, int first, int end, float floor, std::vector<int>& found) {
  const hn::ScalableTag<float> f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  static_assert(hn::MaxLanes(f) <= 8, "marks are the bits of one byte");
  const auto above_floor = hn::Set(f, floor);
  const auto below_floor = hn::Set(f, -floor);
  int c = first;
  for (; c + lanes <= end; c += lanes) {
    const auto v = hn::LoadU(f, band.here + c);
    const auto high = v > above_floor;
    const auto low = v < below_floor;
    const auto left = hn::LoadU(f, band.here + c - 1);
    const auto right = hn::LoadU(f, band.here + c + 1);
    const auto up = hn::LoadU(f, band.above + c);
    const auto down = hn::LoadU(f, band.below + c);
    const auto largest = hn::Max(hn::Max(left, right), hn::Max(up, down));
    const auto smallest = hn::Min(hn::Min(left, right), hn::Min(up, down));
    const auto peak = hn::And(high, v >= largest);
    const auto pit = hn::And(low, v <= smallest);
    const auto either = hn::Or(peak, pit);
    if (hn::AllFalse(f, either)) continue;  // nearly always; whether all are below the floor is a coin's toss
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(f, either, bits.data());
    for (unsigned marks = bits[0]; marks != 0; marks &= marks - 1) found.push_back(c + std::countr_zero(marks));
  }
  for (; c < end; ++c) {
    if (stands_out(band, c, floor)) found.push_back(c);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::features
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::features {

HWY_EXPORT(subtract);
HWY_EXPORT(find_candidates);

void subtract(std::span<const float* const> blurred, std::span<float* const> differences, int columns) {
  HWY_DYNAMIC_DISPATCH(subtract)(blurred, differences, columns);
}

void find_candidates(const RowBand& band, int first, int end, float floor, std::vector<int>& found) {
  found.clear();
  HWY_DYNAMIC_DISPATCH(find_candidates)(band, first, end, floor, found);
}

}  // namespace homeward::features
#endif
