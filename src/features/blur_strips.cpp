// SPDX-License-Identifier: Apache-2.0
#include "features/blur_strips.hpp"

#include <algorithm>
#include <vector>

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/blur_strips.cpp"  // compiled once for each kind of processor
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::features {
namespace HWY_NAMESPACE {
namespace {

#if HWY_NATIVE_FMA

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
constexpr int kLanes = hn::MaxLanes(Lanes());
constexpr std::ptrdiff_t kSums = 8;  // made at once: as many as are on their way through the processor
constexpr int kBlock = 8 * kLanes;   // numbers of that many sums
constexpr int kStrip = 256;          // columns made from top to bottom: their rows stay in the first cache
constexpr int kLine = 16;            // numbers of one line of the cache
constexpr int kAhead = 2;            // rows
static_assert(kBlock == kSums * kLanes && kStrip % kBlock == 0);

using Kernel = std::span<const float>;
using Sum = hn::Vec<Lanes>;

/// The row or column on this side of the border that stands for one beyond it: mirrored, the border itself once.
int reflected(int i, int count) {
  if (i < 0) return -i;
  return i < count ? i : 2 * (count - 1) - i;
}

/// `count` sums (a multiple of kLanes) of neighbours in one row, weighted; `from` is the first one's leftmost
/// neighbour.
void along_row(const float* from, int count, Kernel kernel, float* to) {
  const Lanes f;
  const std::size_t taps = kernel.size();
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    Sum sums[kSums];
    for (std::ptrdiff_t b = 0; b < kSums; ++b) {
      sums[b] = hn::LoadU(f, from + i + b * kLanes) * hn::Set(f, kernel[0]);
    }
    for (std::size_t k = 1; k < taps; ++k) {
      const Sum weight = hn::Set(f, kernel[k]);
      const float* neighbour = from + i + k;
      for (std::ptrdiff_t b = 0; b < kSums; ++b) {
        sums[b] = hn::MulAdd(hn::LoadU(f, neighbour + b * kLanes), weight, sums[b]);
      }
    }
    for (std::ptrdiff_t b = 0; b < kSums; ++b) hn::StoreU(sums[b], f, to + i + b * kLanes);
  }
  for (; i < count; i += kLanes) {
    Sum sum = hn::LoadU(f, from + i) * hn::Set(f, kernel[0]);
    for (std::size_t k = 1; k < taps; ++k) {
      sum = hn::MulAdd(hn::LoadU(f, from + i + k), hn::Set(f, kernel[k]), sum);
    }
    hn::StoreU(sum, f, to + i);
  }
}

/// The same down columns: `rows` are the neighbours, as many as weights, from the uppermost on. The weights are the
/// same above and below.
void down_columns(const std::vector<const float*>& rows, int count, Kernel kernel, float* to) {
  const Lanes f;
  const std::size_t middle = kernel.size() / 2;
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    Sum sums[kSums];
    for (std::ptrdiff_t b = 0; b < kSums; ++b) {
      sums[b] = hn::LoadU(f, rows[middle] + i + b * kLanes) * hn::Set(f, kernel[middle]);
    }
    for (std::size_t k = 1; k <= middle; ++k) {
      const Sum weight = hn::Set(f, kernel[middle + k]);
      const float* above = rows[middle - k] + i;
      const float* below = rows[middle + k] + i;
      for (std::ptrdiff_t b = 0; b < kSums; ++b) {
        const Sum both = hn::LoadU(f, below + b * kLanes) + hn::LoadU(f, above + b * kLanes);
        sums[b] = hn::MulAdd(both, weight, sums[b]);
      }
    }
    for (std::ptrdiff_t b = 0; b < kSums; ++b) hn::StoreU(sums[b], f, to + i + b * kLanes);
  }
  for (; i < count; i += kLanes) {
    Sum sum = hn::LoadU(f, rows[middle] + i) * hn::Set(f, kernel[middle]);
    for (std::size_t k = 1; k <= middle; ++k) {
      const Sum both = hn::LoadU(f, rows[middle + k] + i) + hn::LoadU(f, rows[middle - k] + i);
      sum = hn::MulAdd(both, hn::Set(f, kernel[middle + k]), sum);
    }
    hn::StoreU(sum, f, to + i);
  }
}

/// One strip of columns. Rows are blurred along as they are needed and kept while they are neighbours.
void blur_strip(const FloatPicture<const float>& from, int first, int width, Kernel kernel,
                const FloatPicture<float>& to) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  const int whole = (width + kLanes - 1) / kLanes * kLanes;  // with room for whole registers
  const bool inside = first >= reach && first + whole + reach <= from.columns;
  const std::size_t taps = kernel.size();
  std::vector<float> ring(taps * static_cast<std::size_t>(kStrip));
  std::vector<float> padded(static_cast<std::size_t>(whole + 2 * reach), 0.0F);
  std::vector<float> out(static_cast<std::size_t>(whole));
  std::vector<const float*> neighbours(taps);
  std::vector<float*> kept;  // where each row's sums are while it is a neighbour
  kept.reserve(static_cast<std::size_t>(from.rows));
  for (int row = 0; row < from.rows; ++row) {
    kept.push_back(ring.data() + static_cast<std::size_t>(row) % taps * static_cast<std::size_t>(kStrip));
  }
  int next = 0;  // row to blur along
  for (int row = 0; row < from.rows; ++row) {
    for (; next <= std::min(row + reach, from.rows - 1); ++next) {
      const float* source = from.row(next);
      // The strip's next rows lie pages apart, where the processor does not look ahead by itself.
      if (next + kAhead < from.rows) {
        const float* ahead = from.row(next + kAhead) + first;
        for (int i = 0; i < width; i += kLine) hwy::Prefetch(ahead + i);
      }
      if (inside) {
        along_row(source + first - reach, whole, kernel, kept[static_cast<std::size_t>(next)]);
        continue;
      }
      const int before = std::max(0, reach - first);  // numbers beyond the border
      const int after = std::max(0, first + width + reach - from.columns);
      const int end = width + 2 * reach;
      std::copy_n(source + first - reach + before, end - before - after, padded.begin() + before);
      for (int i = 0; i < before; ++i) padded[static_cast<std::size_t>(i)] = source[before - i];
      for (int i = end - after; i < end; ++i) {
        padded[static_cast<std::size_t>(i)] = source[reflected(first - reach + i, from.columns)];
      }
      along_row(padded.data(), whole, kernel, kept[static_cast<std::size_t>(next)]);
    }
    for (std::size_t k = 0; k < taps; ++k) {
      const int neighbour = reflected(row + static_cast<int>(k) - reach, from.rows);
      neighbours[k] = kept[static_cast<std::size_t>(neighbour)];
    }
    if (whole == width) {
      down_columns(neighbours, width, kernel, to.row(row) + first);
    } else {
      down_columns(neighbours, whole, kernel, out.data());
      std::copy_n(out.begin(), width, to.row(row) + first);
    }
  }
}

bool blur_by_strips(const FloatPicture<const float>& from, Kernel kernel, const FloatPicture<float>& to) {
  for (int first = 0; first < from.columns; first += kStrip) {
    blur_strip(from, first, std::min(kStrip, from.columns - first), kernel, to);
  }
  return true;
}

#else

bool blur_by_strips(const FloatPicture<const float>&, std::span<const float>, const FloatPicture<float>&) {
  return false;
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::features
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::features {

HWY_EXPORT(blur_by_strips);

bool blur_by_strips(const FloatPicture<const float>& from, std::span<const float> kernel,
                    const FloatPicture<float>& to) {
  return HWY_DYNAMIC_DISPATCH(blur_by_strips)(from, kernel, to);
}

}  // namespace homeward::features
#endif
