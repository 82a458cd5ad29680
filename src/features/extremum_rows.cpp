// SPDX-License-Identifier: Apache-2.0
#include "features/extremum_rows.hpp"

#include <algorithm>
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

using Lanes = hn::ScalableTag<float>;
using Numbers = hn::Vec<Lanes>;
using Marks = hn::Mask<Lanes>;
using Sources = std::span<const float* const, kDifferences + 1>;
using Differences = std::span<float* const, kDifferences>;
using Bands = std::span<const RowBand, kDifferences>;
constexpr std::size_t kSearched = kDifferences - 2;

void subtract(Sources blurred, Differences differences, int columns) {
  const Lanes f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  // Copies, which cannot be what is written to: they are read once.
  std::array<const float*, kDifferences + 1> from{};
  std::array<float*, kDifferences> to{};
  std::ranges::copy(blurred, from.begin());
  std::ranges::copy(differences, to.begin());
  int c = 0;
  for (; c + lanes <= columns; c += lanes) {
    Numbers sharp = hn::LoadU(f, from[0] + c);
    for (std::size_t d = 0; d < kDifferences; ++d) {
      const Numbers soft = hn::LoadU(f, from[d + 1] + c);
      hn::StoreU(soft - sharp, f, to[d] + c);
      sharp = soft;
    }
  }
  for (std::size_t d = 0; d < kDifferences; ++d) {
    for (int rest = c; rest < columns; ++rest) to[d][rest] = from[d + 1][rest] - from[d][rest];
  }
}

/// Whether the middle row's value at `c` stands out from the six next to it by more than `floor` in size.
bool stands_out(Bands bands, std::size_t layer, int c, float floor) {
  const RowBand& band = bands[layer];
  const float v = band.here[c];
  const auto [smallest, largest] = std::minmax({band.here[c - 1], band.here[c + 1], band.above[c], band.below[c],
                                                bands[layer - 1].here[c], bands[layer + 1].here[c]});
  return (v > floor && v >= largest) || (v < -floor && v <= smallest);
}

/// The same of a register of values, `here`, between those of the differences before and behind.
Marks standing_out(const RowBand& band, int c, Numbers before, Numbers here, Numbers behind, float floor) {
  const Lanes f;
  const Numbers left = hn::LoadU(f, band.here + c - 1);
  const Numbers right = hn::LoadU(f, band.here + c + 1);
  const Numbers up = hn::LoadU(f, band.above + c);
  const Numbers down = hn::LoadU(f, band.below + c);
  const Numbers largest = hn::Max(hn::Max(hn::Max(left, right), hn::Max(up, down)), hn::Max(before, behind));
  const Numbers smallest = hn::Min(hn::Min(hn::Min(left, right), hn::Min(up, down)), hn::Min(before, behind));
  const Marks peak = hn::And(here > hn::Set(f, floor), here >= largest);
  const Marks pit = hn::And(here < hn::Set(f, -floor), here <= smallest);
  return hn::Or(peak, pit);
}

void find_candidates(Bands bands, int first, int end, float floor, std::vector<Candidate>& found) {
  const Lanes f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  static_assert(hn::MaxLanes(f) <= 8, "marks are the bits of one byte");
  int c = first;
  for (; c + lanes <= end; c += lanes) {
    Numbers here[kDifferences];
    for (std::size_t d = 0; d < kDifferences; ++d) here[d] = hn::LoadU(f, bands[d].here + c);
    Marks of_layers[kSearched];
    Marks any = hn::FirstN(f, 0);
    for (std::size_t k = 0; k < kSearched; ++k) {
      of_layers[k] = standing_out(bands[k + 1], c, here[k], here[k + 1], here[k + 2], floor);
      any = hn::Or(any, of_layers[k]);
    }
    if (hn::AllFalse(f, any)) continue;  // nearly always; whether all are below the floor is a coin's toss
    for (std::size_t k = 0; k < kSearched; ++k) {
      std::array<std::uint8_t, 8> bits{};
      hn::StoreMaskBits(f, of_layers[k], bits.data());
      for (unsigned marks = bits[0]; marks != 0; marks &= marks - 1) {
        found.push_back({static_cast<int>(k) + 1, c + std::countr_zero(marks)});
      }
    }
  }
  for (; c < end; ++c) {
    for (std::size_t layer = 1; layer <= kSearched; ++layer) {
      if (stands_out(bands, layer, c, floor)) found.push_back({static_cast<int>(layer), c});
    }
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

void subtract(std::span<const float* const, kDifferences + 1> blurred,
              std::span<float* const, kDifferences> differences, int columns) {
  HWY_DYNAMIC_DISPATCH(subtract)(blurred, differences, columns);
}

void find_candidates(std::span<const RowBand, kDifferences> bands, int first, int end, float floor,
                     std::vector<Candidate>& found) {
  found.clear();
  HWY_DYNAMIC_DISPATCH(find_candidates)(bands, first, end, floor, found);
  std::ranges::sort(found);
}

}  // namespace homeward::features
#endif
