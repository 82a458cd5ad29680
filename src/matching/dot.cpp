// SPDX-License-Identifier: Apache-2.0
#include "matching/dot.hpp"

#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "matching/dot.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::matching {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::int32_t dot(const std::int8_t* a, const std::int8_t* b, std::size_t length) {
  std::size_t i = 0;
  std::int32_t sum = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<std::int32_t> d32;
  const hn::Repartition<std::int16_t, decltype(d32)> d16;
  const hn::Rebind<std::int8_t, decltype(d16)> d8;
  const std::size_t lanes = hn::Lanes(d16);
  auto even = hn::Zero(d32);
  auto odd = hn::Zero(d32);
  auto even_rest = hn::Zero(d32);  // where an instruction sums fewer products at once
  auto odd_rest = hn::Zero(d32);
  for (; i + 2 * lanes <= length; i += 2 * lanes) {
    even = hn::ReorderWidenMulAccumulate(d32, hn::PromoteTo(d16, hn::LoadU(d8, a + i)),
                                         hn::PromoteTo(d16, hn::LoadU(d8, b + i)), even, even_rest);
    odd = hn::ReorderWidenMulAccumulate(d32, hn::PromoteTo(d16, hn::LoadU(d8, a + i + lanes)),
                                        hn::PromoteTo(d16, hn::LoadU(d8, b + i + lanes)), odd, odd_rest);
  }
  sum = hn::GetLane(hn::SumOfLanes(d32, (even + even_rest) + (odd + odd_rest)));
#endif
  for (; i < length; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::matching
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::matching {

HWY_EXPORT(dot);

std::int32_t dot(const std::int8_t* a, const std::int8_t* b, std::size_t length) {
  return HWY_DYNAMIC_DISPATCH(dot)(a, b, length);
}

}  // namespace homeward::matching
#endif
