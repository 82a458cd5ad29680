// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest_columns.hpp"

#include <algorithm>

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "matching/nearest_columns.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::matching {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

NearestColumn compare(const AskedColumn& asked, float slack2, const TargetColumns::Rows& rows) {
  const hn::ScalableTag<float> f;
  const hn::RebindToSigned<decltype(f)> d;
  constexpr int kLanes = hn::MaxLanes(f);
  const auto top = hn::Set(f, asked.top);
  const auto bottom = hn::Set(f, asked.bottom);
  const auto far = hn::Set(f, NearestColumn::kNone);
  auto lane_best = far;
  auto lane_second = far;
  auto lane_index = hn::Set(d, -1);
  auto place = hn::Iota(d, 0);
  for (std::ptrdiff_t j = 0; j < rows.count; j += kLanes) {
    auto sum = hn::Zero(f);
    for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
      const auto difference = hn::LoadU(f, rows.scaled + k * rows.room + j) - hn::Set(f, asked.scaled[k]);
      sum = sum + difference * difference;
    }
    const auto tops = hn::LoadU(f, rows.top + j);
    const auto bottoms = hn::LoadU(f, rows.bottom + j);
    const auto across = top * bottoms - bottom * tops;
    const auto along = top * tops + bottom * bottoms;
    const auto slack = hn::Set(f, slack2) * (hn::Set(f, asked.norm2) + hn::LoadU(f, rows.norm2 + j));
    const auto fits = hn::And(across * across <= slack, along >= hn::Zero(f));
    const auto distance = hn::IfThenElse(fits, sum, far);
    const auto nearer = distance < lane_best;
    lane_second = hn::Min(lane_second, hn::Max(lane_best, distance));
    lane_best = hn::Min(lane_best, distance);
    lane_index = hn::IfThenElse(hn::RebindMask(d, nearer), place, lane_index);
    place = place + hn::Set(d, kLanes);

    const auto best = hn::LoadU(f, rows.best + j);
    const auto second = hn::LoadU(f, rows.second + j);
    const auto index = hn::LoadU(d, rows.index + j);
    const auto closer = hn::RebindMask(d, distance < best);
    hn::StoreU(hn::IfThenElse(closer, hn::Set(d, asked.number), index), d, rows.index + j);
    hn::StoreU(hn::Min(second, hn::Max(best, distance)), f, rows.second + j);
    hn::StoreU(hn::Min(best, distance), f, rows.best + j);
  }
  float bests[kLanes];
  float seconds[kLanes];
  int indices[kLanes];
  hn::StoreU(lane_best, f, bests);
  hn::StoreU(lane_second, f, seconds);
  hn::StoreU(lane_index, d, indices);
  int lane = 0;
  for (int l = 1; l < kLanes; ++l) {
    if (bests[l] < bests[lane] || (bests[l] == bests[lane] && indices[l] < indices[lane])) lane = l;
  }
  NearestColumn mine{indices[lane], bests[lane]};
  for (int l = 0; l < kLanes; ++l) mine.second = std::min(mine.second, l == lane ? seconds[l] : bests[l]);
  return mine;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::matching
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::matching {

HWY_EXPORT(compare);

namespace {

constexpr std::ptrdiff_t kRoom = 8;  // the rows' lengths are multiples of it: as many numbers as one vector holds

std::vector<float> filled_up(const Eigen::ArrayXf& numbers, std::size_t room, float with) {
  std::vector<float> row(room, with);
  std::ranges::copy(numbers, row.begin());
  return row;
}

}  // namespace

TargetColumns::TargetColumns(const ScaledColumns& scaled, const ColumnHeights& heights)
    : count_(scaled.cols()), room_((count_ + kRoom - 1) / kRoom * kRoom) {
  const auto size = static_cast<std::size_t>(room_);
  scaled_.assign(features::kColumnInvariants * size, 0.0F);
  for (Eigen::Index k = 0; k < features::kColumnInvariants; ++k) {
    std::copy_n(scaled.data() + k * count_, count_, scaled_.begin() + k * room_);
  }
  top_ = filled_up(heights.top, size, 0.0F);
  bottom_ = filled_up(heights.bottom, size, 0.0F);
  // Every comparison with it is false, so that it fits nothing.
  norm2_ = filled_up(heights.norm2, size, std::numeric_limits<float>::quiet_NaN());
  best_.assign(size, NearestColumn::kNone);
  second_.assign(size, NearestColumn::kNone);
  index_.assign(size, -1);
}

NearestColumn TargetColumns::compare(const AskedColumn& asked, float slack2, float bound2) {
  const Rows rows{count_,        room_,        scaled_.data(), top_.data(),  bottom_.data(),
                  norm2_.data(), best_.data(), second_.data(), index_.data()};
  const NearestColumn mine = HWY_DYNAMIC_DISPATCH(compare)(asked, slack2, rows);
  return mine.best > bound2 ? NearestColumn{-1, mine.best} : mine;
}

}  // namespace homeward::matching
#endif
