// SPDX-License-Identifier: Apache-2.0
#include "tracking/patch_sums.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracking/patch_sums.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::tracking {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
using Indices = hn::Rebind<std::int32_t, Lanes>;
constexpr int kLanes = hn::MaxLanes(Lanes());
constexpr int kRegisters = kPatchStride / kLanes;
constexpr int kWidest = 24;  // columns of the level under a patch of the largest side and step
static_assert(kPatchStride % kLanes == 0 && kWidest % kLanes == 0);
static_assert(kWidest >= static_cast<int>((kLargestPatchSide_px - 1) * kLargestStep_px) + 3);

/// Sums of each column for itself.
struct ColumnSums {
  HWY_ALIGN float one[kPatchStride];
  HWY_ALIGN float square[kPatchStride];
  HWY_ALIGN float grey[kPatchStride];
  HWY_ALIGN float du[kPatchStride];
  HWY_ALIGN float dv[kPatchStride];
  HWY_ALIGN float zoom[kPatchStride];
};

double total(const float* columns) {
  double sum = 0.0;
  for (int i = 0; i < kPatchStride; ++i) sum += static_cast<double>(columns[i]);
  return sum;
}

/// Where the columns of a patch lie in the level: they are the same in every row, as nothing is turned.
struct Columns {
  int first = 0;
  HWY_ALIGN std::int32_t left[kPatchStride];
  HWY_ALIGN float share[kPatchStride];  // of the right neighbour
  HWY_ALIGN float counts[kPatchStride];
  HWY_ALIGN float x[kPatchStride];

  Columns(int side, const PatchPlace& place) : first(static_cast<int>(std::floor(place.first_u_px))) {
    const int middle = side / 2;
    for (int i = 0; i < kPatchStride; ++i) {
      const double at = place.first_u_px + place.step_px * std::min(i, side - 1) - first;
      left[i] = static_cast<std::int32_t>(at);
      share[i] = static_cast<float>(at - left[i]);
      counts[i] = i < side ? 1.0F : 0.0F;
      x[i] = static_cast<float>(i - middle);
    }
  }
};

PatchSums patch_sums(const GreyLevel& level, const PatchView& patch, const PatchPlace& place) {
  const Lanes f;
  const Indices n;
  const Columns columns(patch.side, place);
  HWY_ALIGN float between[kWidest];
  hn::Vec<Lanes> one[kRegisters];
  hn::Vec<Lanes> square[kRegisters];
  hn::Vec<Lanes> grey[kRegisters];
  hn::Vec<Lanes> du[kRegisters];
  hn::Vec<Lanes> dv[kRegisters];
  hn::Vec<Lanes> zoom[kRegisters];
  for (int r = 0; r < kRegisters; ++r) {
    one[r] = square[r] = grey[r] = du[r] = dv[r] = zoom[r] = hn::Zero(f);
  }
  const auto mean = hn::Set(f, patch.mean);
  const int middle = patch.side / 2;
  for (int row = 0; row < patch.side; ++row) {
    const double at = place.first_v_px + place.step_px * row;
    const int above = static_cast<int>(std::floor(at));
    const auto share = hn::Set(f, static_cast<float>(at - above));
    const float* upper = level.row(above) + columns.first;
    const float* lower = upper + level.stride;
    for (int i = 0; i < kWidest; i += kLanes) {
      const auto high = hn::LoadU(f, upper + i);
      hn::Store(high + share * (hn::LoadU(f, lower + i) - high), f, between + i);
    }
    const auto y = hn::Set(f, static_cast<float>(row - middle));
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * kPatchStride;
    const float* const own = patch.grey + first;
    const float* const own_du = patch.du + first;
    const float* const own_dv = patch.dv + first;
    for (int r = 0; r < kRegisters; ++r) {
      const int i = r * kLanes;
      const auto where = hn::Load(n, columns.left + i);
      const auto left = hn::GatherIndex(f, between, where);
      const auto right = hn::GatherIndex(f, between + 1, where);
      const auto seen =
          (left + hn::Load(f, columns.share + i) * (right - left) - mean) * hn::Load(f, columns.counts + i);
      const auto tu = hn::LoadU(f, own_du + i);
      const auto tv = hn::LoadU(f, own_dv + i);
      one[r] = one[r] + seen;
      square[r] = square[r] + seen * seen;
      grey[r] = grey[r] + seen * hn::LoadU(f, own + i);
      du[r] = du[r] + seen * tu;
      dv[r] = dv[r] + seen * tv;
      zoom[r] = zoom[r] + seen * (hn::Load(f, columns.x + i) * tu + y * tv);
    }
  }
  ColumnSums sums;
  for (int r = 0; r < kRegisters; ++r) {
    const int i = r * kLanes;
    hn::Store(one[r], f, sums.one + i);
    hn::Store(square[r], f, sums.square + i);
    hn::Store(grey[r], f, sums.grey + i);
    hn::Store(du[r], f, sums.du + i);
    hn::Store(dv[r], f, sums.dv + i);
    hn::Store(zoom[r], f, sums.zoom + i);
  }
  return {total(sums.one), total(sums.square), total(sums.grey), total(sums.du), total(sums.dv), total(sums.zoom)};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::tracking
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::tracking {

HWY_EXPORT(patch_sums);

PatchSums patch_sums(const GreyLevel& level, const PatchView& patch, const PatchPlace& place) {
  return HWY_DYNAMIC_DISPATCH(patch_sums)(level, patch, place);
}

bool inside(const GreyLevel& level, int side, const PatchPlace& place, double outside_px) {
  const double reach_px = (side - 1) * place.step_px;
  // Written so that what is not a number is not inside. A sample needs a neighbour to the right and below.
  return place.first_u_px >= -outside_px && place.first_v_px >= -outside_px &&
         place.first_u_px + reach_px < level.width_px - 1 + outside_px &&
         place.first_v_px + reach_px < level.height_px - 1 + outside_px;
}

void sample_patch(const GreyLevel& level, int side, const PatchPlace& place, float* to, int stride) {
  for (int row = 0; row < side; ++row) {
    const double v = place.first_v_px + place.step_px * row;
    const int above = static_cast<int>(std::floor(v));
    const auto down = static_cast<float>(v - above);
    const float* upper = level.row(above);
    const float* lower = upper + level.stride;
    for (int column = 0; column < side; ++column) {
      const double u = place.first_u_px + place.step_px * column;
      const int left = static_cast<int>(std::floor(u));
      const auto along = static_cast<float>(u - left);
      const float top = upper[left] + along * (upper[left + 1] - upper[left]);
      const float bottom = lower[left] + along * (lower[left + 1] - lower[left]);
      to[row * stride + column] = top + down * (bottom - top);
    }
  }
}

}  // namespace homeward::tracking
#endif
