// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest.hpp"

#include <algorithm>

#define HOMEWARD_WITH_AVX512
#include "core/vector_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "matching/nearest.cpp"  // compiled once for each kind of processor
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace homeward::matching {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target) {
  return find_nearest_portable(current, target);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::int32_t kFar = NearestNeighbours::kNone;

using Lanes = hn::ScalableTag<std::int32_t>;
using Numbers = hn::Vec<Lanes>;
constexpr std::size_t kLanes = hn::MaxLanes(Lanes());

#if HWY_TARGET == HWY_AVX3

HWY_PUSH_ATTRIBUTES("avx512vnni")

/// How numbers are multiplied: in fours of 8 bits, by an instruction for neural networks that Highway does not name.
/// With a about 128 and b as it is, |a - b|^2 = |a|^2 + |b|^2 - 2 (a.b - 128 sum(a)), the norm of b being that about
/// 128.
struct Products {
  static constexpr std::size_t kNumbers = 4;
  using Number = std::uint8_t;
  static Number of_target(std::uint8_t byte) { return byte; }
  static std::int32_t offset(std::int32_t squares, std::int32_t sum) { return squares + 256 * sum; }

  Numbers sum;

  HWY_INLINE Products() : sum(hn::Zero(Lanes())) {}
  HWY_INLINE void add(const Number* target, std::int32_t current) {
    const hn::Repartition<Number, Lanes> d8;
    sum.raw = _mm512_dpbusd_epi32(sum.raw, hn::LoadU(d8, target).raw, hn::Set(Lanes(), current).raw);
  }
  [[nodiscard]] HWY_INLINE Numbers products() const { return sum; }
};

#else

/// How numbers are multiplied: in pairs of 16 bits. With a and b about 128, |a - b|^2 = |a|^2 + |b|^2 - 2 a.b.
struct Products {
  static constexpr std::size_t kNumbers = 2;  // in each lane of 32 bits
  using Number = std::int16_t;
  static Number of_target(std::uint8_t byte) { return static_cast<Number>(byte - 128); }
  static std::int32_t offset(std::int32_t squares, std::int32_t /*sum*/) { return squares; }

  Numbers sum;
  Numbers rest;  // where an instruction sums fewer products at once

  HWY_INLINE Products() : sum(hn::Zero(Lanes())), rest(hn::Zero(Lanes())) {}
  HWY_INLINE void add(const Number* target, std::int32_t current) {
    const hn::Repartition<Number, Lanes> d16;
    sum = hn::ReorderWidenMulAccumulate(Lanes(), hn::LoadU(d16, target), hn::BitCast(d16, hn::Set(Lanes(), current)),
                                        sum, rest);
  }
  [[nodiscard]] HWY_INLINE Numbers products() const { return hn::RearrangeToOddPlusEven(sum, rest); }
};

#endif

/// Target descriptors in blocks of as many as there are lanes, within a block groups of dimensions, for each the
/// descriptors' numbers. Blocks are filled up with descriptors that are never near.
struct Blocks {
  static constexpr std::size_t kGroup = Products::kNumbers;
  std::size_t groups = 0;
  std::vector<Products::Number> numbers;
  std::vector<std::int32_t> squared_norms;  // of the descriptors about 128

  explicit Blocks(const ByteDescriptors& descriptors) {
    const auto count = static_cast<std::size_t>(descriptors.rows());
    const auto length = static_cast<std::size_t>(descriptors.cols());
    groups = (length + kGroup - 1) / kGroup;
    const std::size_t blocks = (count + kLanes - 1) / kLanes;
    numbers.assign(blocks * groups * kGroup * kLanes, 0);
    constexpr std::int32_t kNeverNear = 1 << 29;
    squared_norms.assign(blocks * kLanes, kNeverNear);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* from = descriptors.data() + i * length;
      auto* to = numbers.data() + (i / kLanes * groups * kLanes + i % kLanes) * kGroup;
      std::int32_t squares = 0;
      for (std::size_t d = 0; d < length; ++d) {
        const std::int32_t number = from[d] - 128;
        to[d / kGroup * kGroup * kLanes + d % kGroup] = Products::of_target(from[d]);
        squares += number * number;
      }
      squared_norms[i] = squares;
    }
  }
};

/// What of one current descriptor goes into each comparison: groups of its numbers about 128, and an offset.
struct Row {
  std::vector<std::int32_t> groups;
  std::int32_t offset = 0;

  void set(const std::uint8_t* numbers, std::size_t length) {
    constexpr std::size_t kGroup = Products::kNumbers;
    constexpr std::size_t kBits = 32 / kGroup;
    constexpr std::uint32_t kMask = (1U << kBits) - 1U;
    std::ranges::fill(groups, 0);
    std::int32_t squares = 0;
    std::int32_t sum = 0;
    for (std::size_t d = 0; d < length; ++d) {
      const std::int32_t number = numbers[d] - 128;
      squares += number * number;
      sum += number;
      groups[d / kGroup] |=
          static_cast<std::int32_t>((static_cast<std::uint32_t>(number) & kMask) << (d % kGroup * kBits));
    }
    offset = Products::offset(squares, sum);
  }
};

/// Best and second best of one current descriptor, one in each lane.
struct Best {
  Numbers best;
  Numbers second;
  Numbers index;

  HWY_INLINE Best() : best(hn::Set(Lanes(), kFar)), second(best), index(hn::Zero(Lanes())) {}
  HWY_INLINE void take(Numbers distance, Numbers target) {
    second = hn::Min(second, hn::Max(best, distance));
    index = hn::IfThenElse(best > distance, target, index);
    best = hn::Min(best, distance);
  }

  /// The nearest of all lanes' bests into `nearest`.
  HWY_INLINE void finish(std::size_t at, bool has_second, NearestNeighbours& nearest) const {
    const Lanes d;
    const Numbers distance = hn::MinOfLanes(d, best);
    const auto equal = best == distance;
    const Numbers first = hn::MinOfLanes(d, hn::IfThenElse(equal, index, hn::Set(d, kFar)));
    const auto winner = hn::And(equal, index == first);
    nearest.of_current[at] = hn::GetLane(first);
    nearest.distance[at] = hn::GetLane(distance);
    nearest.second_distance[at] =
        has_second ? hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(winner, second, best))) : kFar;
  }
};

/// Compares as many targets at a time as there are lanes with two current descriptors. `Groups` of dimensions; 0: as
/// many as there are.
template <std::size_t Groups>
NearestNeighbours compare(const ByteDescriptors& current, const ByteDescriptors& target) {
  const Lanes d;
  NearestNeighbours nearest(current.rows(), target.rows());
  const Blocks blocks(target);
  const std::size_t groups = Groups == 0 ? blocks.groups : Groups;
  const std::size_t block_count = blocks.squared_norms.size() / kLanes;
  const auto length = static_cast<std::size_t>(current.cols());
  const auto count = static_cast<std::size_t>(current.rows());
  std::vector<std::int32_t> target_distance(blocks.squared_norms.size(), kFar);
  std::vector<std::int32_t> target_index(blocks.squared_norms.size(), 0);
  Row even{std::vector<std::int32_t>(groups)};
  Row odd = even;
  for (std::size_t i = 0; i < count; i += 2) {
    const std::size_t second_row = std::min(i + 1, count - 1);  // the last one twice: equals change nothing
    even.set(current.data() + i * length, length);
    odd.set(current.data() + second_row * length, length);
    Best of_even;
    Best of_odd;
    Numbers index = hn::Iota(d, 0);
    const std::int32_t* const even_groups = even.groups.data();
    const std::int32_t* const odd_groups = odd.groups.data();
    for (std::size_t b = 0; b < block_count; ++b) {
      const auto* numbers = blocks.numbers.data() + b * groups * Products::kNumbers * kLanes;
      Products of_even_row;
      Products of_odd_row;
      for (std::size_t g = 0; g < groups; ++g) {
        of_even_row.add(numbers + g * Products::kNumbers * kLanes, even_groups[g]);
        of_odd_row.add(numbers + g * Products::kNumbers * kLanes, odd_groups[g]);
      }
      const Numbers norms = hn::LoadU(d, blocks.squared_norms.data() + b * kLanes);
      const Numbers even_distance = norms + hn::Set(d, even.offset) - hn::ShiftLeft<1>(of_even_row.products());
      const Numbers odd_distance = norms + hn::Set(d, odd.offset) - hn::ShiftLeft<1>(of_odd_row.products());
      of_even.take(even_distance, index);
      of_odd.take(odd_distance, index);
      index = index + hn::Set(d, static_cast<std::int32_t>(kLanes));

      Numbers known = hn::LoadU(d, target_distance.data() + b * kLanes);
      Numbers known_index = hn::LoadU(d, target_index.data() + b * kLanes);
      known_index = hn::IfThenElse(known > even_distance, hn::Set(d, static_cast<std::int32_t>(i)), known_index);
      known = hn::Min(known, even_distance);
      known_index =
          hn::IfThenElse(known > odd_distance, hn::Set(d, static_cast<std::int32_t>(second_row)), known_index);
      known = hn::Min(known, odd_distance);
      hn::StoreU(known, d, target_distance.data() + b * kLanes);
      hn::StoreU(known_index, d, target_index.data() + b * kLanes);
    }
    of_even.finish(i, target.rows() > 1, nearest);
    of_odd.finish(second_row, target.rows() > 1, nearest);
  }
  std::copy_n(target_index.begin(), nearest.of_target.size(), nearest.of_target.begin());
  return nearest;
}

constexpr std::size_t kUsualLength = 32;  // of a SIFT code

NearestNeighbours find_nearest_by_products(const ByteDescriptors& current, const ByteDescriptors& target) {
  return current.cols() == kUsualLength ? compare<kUsualLength / Products::kNumbers>(current, target)
                                        : compare<0>(current, target);
}

#if HWY_TARGET == HWY_AVX3

HWY_POP_ATTRIBUTES

NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target) {
  static const bool has_instruction = __builtin_cpu_supports("avx512vnni") != 0;
  return has_instruction ? find_nearest_by_products(current, target) : N_AVX2::find_nearest(current, target);
}

#else

NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target) {
  return find_nearest_by_products(current, target);
}

#endif

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace homeward::matching
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace homeward::matching {

HWY_EXPORT(find_nearest);

NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target) {
  return HWY_DYNAMIC_DISPATCH(find_nearest)(current, target);
}

}  // namespace homeward::matching
#endif
