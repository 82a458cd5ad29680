// SPDX-License-Identifier: Apache-2.0
#include "features/blur_strips.hpp"

#include <algorithm>
#include <vector>

#include "core/sanitized.hpp"
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
constexpr std::ptrdiff_t kPair = 2;  // sums made at once of each of two rows
constexpr int kStep = 2 * kLanes;    // numbers of that many sums
constexpr int kStrip = 256;          // columns made from top to bottom: their rows stay in the first cache
constexpr int kLine = 16;            // numbers of one line of the cache
constexpr int kAhead = 2;            // rows
static_assert(kBlock == kSums * kLanes && kStep == kPair * kLanes);

using Kernel = std::span<const float>;
using Sum = hn::Vec<Lanes>;

/// The row or column on this side of the border that stands for one beyond it: mirrored, the border itself once.
int reflected(int i, int count) {
  if (i < 0) return -i;
  return i < count ? i : 2 * (count - 1) - i;
}

/// `count` sums (a multiple of kLanes) of neighbours in one row, weighted; `from` is the first one's leftmost
/// neighbour.
HOMEWARD_LOOKED_AT_BEFORE void along_row(const float* from, int count, Kernel kernel, float* to) {
  const Lanes f;
  const std::size_t taps = kernel.size();
  const float* weights = kernel.data();
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    Sum sums[kSums];
    for (std::ptrdiff_t b = 0; b < kSums; ++b) {
      sums[b] = hn::LoadU(f, from + i + b * kLanes) * hn::Set(f, weights[0]);
    }
    for (std::size_t k = 1; k < taps; ++k) {
      const Sum weight = hn::Set(f, weights[k]);
      const float* neighbour = from + i + k;
      for (std::ptrdiff_t b = 0; b < kSums; ++b) {
        sums[b] = hn::MulAdd(hn::LoadU(f, neighbour + b * kLanes), weight, sums[b]);
      }
    }
    for (std::ptrdiff_t b = 0; b < kSums; ++b) hn::Store(sums[b], f, to + i + b * kLanes);
  }
  for (; i < count; i += kLanes) {
    Sum sum = hn::LoadU(f, from + i) * hn::Set(f, weights[0]);
    for (std::size_t k = 1; k < taps; ++k) {
      sum = hn::MulAdd(hn::LoadU(f, from + i + k), hn::Set(f, weights[k]), sum);
    }
    hn::StoreU(sum, f, to + i);
  }
}

/// kStep sums down columns for each of two rows, which share what they read: `rows` are the neighbours of both, one
/// more than weights, from the uppermost on. The weights are the same above and below.
HOMEWARD_LOOKED_AT_BEFORE inline void down_block(const float* const* rows, std::ptrdiff_t from, Kernel kernel,
                                                 float* upper, float* lower) {
  const Lanes f;
  const std::size_t middle = kernel.size() / 2;
  const float* weights = kernel.data();
  Sum upper_sums[kPair];
  Sum lower_sums[kPair];
  Sum below[kPair];  // the upper row's next neighbours below
  Sum above[kPair];  // the lower row's next neighbours above
  const Sum first_weight = hn::Set(f, weights[middle]);
  for (std::ptrdiff_t b = 0; b < kPair; ++b) {
    above[b] = hn::Load(f, rows[middle] + from + b * kLanes);
    below[b] = hn::Load(f, rows[middle + 1] + from + b * kLanes);
    upper_sums[b] = above[b] * first_weight;
    lower_sums[b] = below[b] * first_weight;
  }
  for (std::size_t k = 1; k <= middle; ++k) {
    const Sum weight = hn::Set(f, weights[middle + k]);
    for (std::ptrdiff_t b = 0; b < kPair; ++b) {
      const Sum farther_above = hn::Load(f, rows[middle - k] + from + b * kLanes);
      const Sum farther_below = hn::Load(f, rows[middle + 1 + k] + from + b * kLanes);
      upper_sums[b] = hn::MulAdd(below[b] + farther_above, weight, upper_sums[b]);
      lower_sums[b] = hn::MulAdd(farther_below + above[b], weight, lower_sums[b]);
      above[b] = farther_above;
      below[b] = farther_below;
    }
  }
  for (std::ptrdiff_t b = 0; b < kPair; ++b) {
    hn::StoreU(upper_sums[b], f, upper + b * kLanes);
    hn::StoreU(lower_sums[b], f, lower + b * kLanes);
  }
}

/// Two rows of `count` sums down columns; `lower` is null below the last row.
void down_columns(const float* const* rows, int count, Kernel kernel, float* upper, float* lower) {
  int i = 0;
  const int whole = (count + kStep - 1) / kStep * kStep;
  for (std::size_t k = 0; k <= kernel.size(); ++k) expect_usable(std::span(rows[k], static_cast<std::size_t>(whole)));
  expect_usable(std::span(upper, static_cast<std::size_t>(count)));
  if (lower != nullptr) {
    expect_usable(std::span(lower, static_cast<std::size_t>(count)));
    for (; i + kStep <= count; i += kStep) down_block(rows, i, kernel, upper + i, lower + i);
  }
  for (; i < count; i += kStep) {
    float sums[2 * kStep];
    down_block(rows, i, kernel, sums, sums + kStep);
    const int rest = std::min(kStep, count - i);
    std::copy_n(sums, rest, upper + i);
    if (lower != nullptr) std::copy_n(sums + kStep, rest, lower + i);
  }
}

/// The columns of a picture from `first` to below `end`, from the top down. Rows are blurred along as they are needed
/// and kept while they are neighbours.
class Strip {
 public:
  Strip(const FloatPicture<const float>& from, Kernel kernel, int first, int end)
      : from_(from),
        kernel_(kernel),
        reach_(static_cast<int>(kernel.size()) / 2),
        span_(static_cast<int>(kernel.size()) + 1),
        first_(first),
        width_(end - first),
        whole_((width_ + kStep - 1) / kStep * kStep) {
    // An odd number of lines for each row: rows would else meet in the same places of the cache.
    const int lines = (whole_ + kLine - 1) / kLine | 1;
    ring_.resize(static_cast<std::size_t>(span_ * lines));
    for (int k = 0; k < 2 * span_; ++k) kept_.push_back(ring_[static_cast<std::size_t>(k % span_ * lines)].numbers);
    padded_.resize(static_cast<std::size_t>(whole_ + 2 * reach_));
    at_border_.resize(static_cast<std::size_t>(span_));
    expect_usable(kernel_);
    expect_usable(std::span(padded_));
  }

  void blur(const FloatPicture<float>& to) {
    int next = 0;  // row to blur along
    for (int row = 0; row < from_.rows; row += 2) {
      const bool is_last = row + 1 == from_.rows;
      for (; next <= std::min(row + 1 + reach_, from_.rows - 1); ++next) blur_along(next);
      down_columns(neighbours(row), width_, kernel_, to.row(row) + first_,
                   is_last ? nullptr : to.row(row + 1) + first_);
    }
  }

 private:
  struct alignas(sizeof(float) * kLine) Line {
    float numbers[kLine];
  };

  void blur_along(int row) {
    const float* source = from_.row(row) + first_ - reach_;
    // The strip's next rows lie pages apart, where the processor does not look ahead by itself.
    if (row + kAhead < from_.rows) {
      const float* ahead = from_.row(row + kAhead) + first_;
      for (int i = 0; i < width_; i += kLine) hwy::Prefetch(ahead + i);
    }
    float* kept = kept_[static_cast<std::size_t>(row % span_)];
    expect_usable(std::span(kept, static_cast<std::size_t>(whole_)));
    if (first_ >= reach_ && first_ + whole_ + reach_ <= from_.columns) {
      expect_usable(std::span(source, padded_.size()));
      along_row(source, whole_, kernel_, kept);
      return;
    }
    const int before = std::max(0, reach_ - first_);  // numbers beyond the border
    const int after = std::max(0, first_ + width_ + reach_ - from_.columns);
    const int count = width_ + 2 * reach_;
    std::copy_n(source + before, count - before - after, padded_.begin() + before);
    for (int i = 0; i < before; ++i) padded_[static_cast<std::size_t>(i)] = from_.row(row)[before - i];
    for (int i = count - after; i < count; ++i) {
      padded_[static_cast<std::size_t>(i)] = from_.row(row)[reflected(first_ - reach_ + i, from_.columns)];
    }
    along_row(padded_.data(), whole_, kernel_, kept);
  }

  /// Of a row and of the one below it, from the uppermost on.
  const float* const* neighbours(int row) {
    if (row >= reach_ && row + 1 + reach_ < from_.rows) return kept_.data() + (row - reach_) % span_;
    for (int k = 0; k < span_; ++k) {
      // Below the last row there is none whose neighbours count.
      const int neighbour = std::min(row + k - reach_, from_.rows - 1 + reach_);
      at_border_[static_cast<std::size_t>(k)] =
          kept_[static_cast<std::size_t>(reflected(neighbour, from_.rows) % span_)];
    }
    return at_border_.data();
  }

  FloatPicture<const float> from_;
  Kernel kernel_;
  int reach_;
  int span_;  // rows that are neighbours of one of two
  int first_;
  int width_;
  int whole_;                 // with room for whole registers
  std::vector<Line> ring_;    // the last rows blurred along
  std::vector<float*> kept_;  // where they are, twice over, so that neighbours always follow one another
  std::vector<float> padded_;
  std::vector<const float*> at_border_;
};

bool blur_by_strips(const FloatPicture<const float>& from, Kernel kernel, const FloatPicture<float>& to) {
  for (int first = 0; first < from.columns; first += kStrip) {
    Strip(from, kernel, first, std::min(first + kStrip, from.columns)).blur(to);
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
