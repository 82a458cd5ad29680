// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest.hpp"

#include <algorithm>
#include <array>

#include "core/processor.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace homeward::matching {
namespace {

constexpr std::int32_t kFar = NearestNeighbours::kNone;

NearestNeighbours nothing_yet(Eigen::Index current, Eigen::Index target) {
  NearestNeighbours nearest;
  nearest.of_current.assign(static_cast<std::size_t>(current), 0);
  nearest.distance.assign(static_cast<std::size_t>(current), kFar);
  nearest.second_distance.assign(static_cast<std::size_t>(current), kFar);
  nearest.of_target.assign(static_cast<std::size_t>(target), 0);
  return nearest;
}

#if defined(__x86_64__)

constexpr std::size_t kLanes = 8;  // 32-bit numbers of one AVX2 register

/// Target descriptors laid out for `compare_avx2`: blocks of eight, within a block pairs of dimensions, for each the
/// eight descriptors' two numbers (16 bits, about zero). Blocks are filled up with a descriptor that is never near.
struct Blocks {
  std::size_t pairs = 0;
  std::vector<std::int16_t> numbers;
  std::vector<std::int32_t> squared_norms;

  explicit Blocks(const ByteDescriptors& descriptors) {
    const auto count = static_cast<std::size_t>(descriptors.rows());
    const auto length = static_cast<std::size_t>(descriptors.cols());
    pairs = (length + 1) / 2;
    const std::size_t blocks = (count + kLanes - 1) / kLanes;
    numbers.assign(blocks * pairs * 2 * kLanes, 0);
    constexpr std::int32_t kNeverNear = 1 << 29;
    squared_norms.assign(blocks * kLanes, kNeverNear);
    for (std::size_t i = 0; i < count; ++i) {
      std::int32_t squares = 0;
      for (std::size_t d = 0; d < length; ++d) {
        const auto number =
            static_cast<std::int16_t>(descriptors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(d)) - 128);
        numbers[((i / kLanes * pairs + d / 2) * kLanes + i % kLanes) * 2 + d % 2] = number;
        squares += number * number;
      }
      squared_norms[i] = squares;
    }
  }
};

/// Eight targets at a time: |a - b|^2 = |a|^2 + |b|^2 - 2 a.b, the products by multiply-add of pairs.
__attribute__((target("avx2"))) NearestNeighbours compare_avx2(const ByteDescriptors& current,
                                                               const ByteDescriptors& target) {
  NearestNeighbours nearest = nothing_yet(current.rows(), target.rows());
  const Blocks blocks(target);
  const std::size_t block_count = blocks.squared_norms.size() / kLanes;
  const auto length = static_cast<std::size_t>(current.cols());
  std::vector<std::int32_t> target_distance(blocks.squared_norms.size(), kFar);
  std::vector<std::int32_t> target_index(blocks.squared_norms.size(), 0);
  std::vector<std::int32_t> row(blocks.pairs);  // a pair of 16-bit numbers each
  for (Eigen::Index i = 0; i < current.rows(); ++i) {
    std::int32_t squares = 0;
    std::fill(row.begin(), row.end(), 0);
    for (std::size_t d = 0; d < length; ++d) {
      const std::int32_t number = current(i, static_cast<Eigen::Index>(d)) - 128;
      squares += number * number;
      row[d / 2] |= d % 2 == 0 ? number & 0xFFFF : static_cast<std::int32_t>(static_cast<std::uint32_t>(number) << 16U);
    }
    __m256i best = _mm256_set1_epi32(kFar);
    __m256i second = best;
    __m256i best_index = _mm256_setzero_si256();
    __m256i index = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i this_row = _mm256_set1_epi32(static_cast<std::int32_t>(i));
    for (std::size_t b = 0; b < block_count; ++b) {
      const auto* numbers = reinterpret_cast<const __m256i*>(blocks.numbers.data() + b * blocks.pairs * 2 * kLanes);
      __m256i even = _mm256_setzero_si256();
      __m256i odd = _mm256_setzero_si256();
      std::size_t p = 0;
      for (; p + 1 < blocks.pairs; p += 2) {
        even = _mm256_add_epi32(even, _mm256_madd_epi16(_mm256_set1_epi32(row[p]), _mm256_loadu_si256(numbers + p)));
        odd = _mm256_add_epi32(odd,
                               _mm256_madd_epi16(_mm256_set1_epi32(row[p + 1]), _mm256_loadu_si256(numbers + p + 1)));
      }
      if (p < blocks.pairs) {
        even = _mm256_add_epi32(even, _mm256_madd_epi16(_mm256_set1_epi32(row[p]), _mm256_loadu_si256(numbers + p)));
      }
      const __m256i twice = _mm256_slli_epi32(_mm256_add_epi32(even, odd), 1);
      auto* const norms = reinterpret_cast<const __m256i*>(blocks.squared_norms.data() + b * kLanes);
      const __m256i distance =
          _mm256_sub_epi32(_mm256_add_epi32(_mm256_set1_epi32(squares), _mm256_loadu_si256(norms)), twice);
      const __m256i nearer = _mm256_cmpgt_epi32(best, distance);
      second = _mm256_min_epi32(second, _mm256_max_epi32(best, distance));
      best = _mm256_min_epi32(best, distance);
      best_index = _mm256_blendv_epi8(best_index, index, nearer);
      index = _mm256_add_epi32(index, _mm256_set1_epi32(kLanes));

      auto* const known = reinterpret_cast<__m256i*>(target_distance.data() + b * kLanes);
      auto* const known_index = reinterpret_cast<__m256i*>(target_index.data() + b * kLanes);
      const __m256i before = _mm256_loadu_si256(known);
      const __m256i closer = _mm256_cmpgt_epi32(before, distance);
      _mm256_storeu_si256(known, _mm256_min_epi32(before, distance));
      _mm256_storeu_si256(known_index, _mm256_blendv_epi8(_mm256_loadu_si256(known_index), this_row, closer));
    }
    std::array<std::int32_t, kLanes> bests{};
    std::array<std::int32_t, kLanes> seconds{};
    std::array<std::int32_t, kLanes> indices{};
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(bests.data()), best);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(seconds.data()), second);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(indices.data()), best_index);
    std::size_t lane = 0;
    for (std::size_t l = 1; l < kLanes; ++l) {
      if (bests[l] < bests[lane] || (bests[l] == bests[lane] && indices[l] < indices[lane])) lane = l;
    }
    std::int32_t runner_up = kFar;
    for (std::size_t l = 0; l < kLanes; ++l) runner_up = std::min(runner_up, l == lane ? seconds[l] : bests[l]);
    const auto at = static_cast<std::size_t>(i);
    nearest.of_current[at] = indices[lane];
    nearest.distance[at] = bests[lane];
    nearest.second_distance[at] = target.rows() > 1 ? runner_up : kFar;
  }
  std::copy_n(target_index.begin(), nearest.of_target.size(), nearest.of_target.begin());
  return nearest;
}

/// Target descriptors laid out for `compare_vnni`: blocks of sixteen, within a block fours of dimensions, for each the
/// sixteen descriptors' four bytes. Blocks are filled up with descriptors that are never near.
struct WideBlocks {
  static constexpr std::size_t kWide = 16;  // 32-bit numbers of one AVX-512 register
  std::size_t fours = 0;
  std::vector<std::uint8_t> numbers;
  std::vector<std::int32_t> squared_norms;  // of the descriptors about 128

  explicit WideBlocks(const ByteDescriptors& descriptors) {
    const auto count = static_cast<std::size_t>(descriptors.rows());
    const auto length = static_cast<std::size_t>(descriptors.cols());
    fours = (length + 3) / 4;
    const std::size_t blocks = (count + kWide - 1) / kWide;
    numbers.assign(blocks * fours * 4 * kWide, 0);
    constexpr std::int32_t kNeverNear = 1 << 29;
    squared_norms.assign(blocks * kWide, kNeverNear);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t* from = descriptors.data() + i * length;
      std::uint8_t* to = numbers.data() + (i / kWide * fours * kWide + i % kWide) * 4;
      std::int32_t squares = 0;
      for (std::size_t d = 0; d < length; ++d) {
        const std::int32_t number = from[d] - 128;
        to[d / 4 * 4 * kWide + d % 4] = from[d];
        squares += number * number;
      }
      squared_norms[i] = squares;
    }
  }
};

/// Best and second best of one current descriptor, one in each lane.
struct WideBest {
  __m512i best;
  __m512i second;
  __m512i index;
};

/// What of one current descriptor goes into each comparison: fours of its numbers about 128, and |a|^2 + 256 sum(a).
struct WideRow {
  std::vector<std::int32_t> fours;
  std::int32_t offset = 0;

  void set(const std::uint8_t* numbers, std::size_t length) {
    std::ranges::fill(fours, 0);
    std::int32_t squares = 0;
    std::int32_t sum = 0;
    for (std::size_t d = 0; d < length; ++d) {
      const std::int32_t number = numbers[d] - 128;
      squares += number * number;
      sum += number;
      fours[d / 4] |= static_cast<std::int32_t>((static_cast<std::uint32_t>(number) & 0xFFU) << (d % 4 * 8));
    }
    offset = squares + 256 * sum;
  }
};

__attribute__((target("avx512f,avx512vnni"))) inline void take(WideBest& row, __m512i distance, __m512i index) {
  row.second = _mm512_min_epi32(row.second, _mm512_max_epi32(row.best, distance));
  row.index = _mm512_mask_mov_epi32(row.index, _mm512_cmpgt_epi32_mask(row.best, distance), index);
  row.best = _mm512_min_epi32(row.best, distance);
}

/// The nearest of all lanes' bests into `nearest`.
__attribute__((target("avx512f,avx512vnni"))) inline void finish(const WideBest& row, std::size_t at, bool has_second,
                                                                 NearestNeighbours& nearest) {
  const std::int32_t best = _mm512_reduce_min_epi32(row.best);
  const __mmask16 equal = _mm512_cmpeq_epi32_mask(row.best, _mm512_set1_epi32(best));
  const std::int32_t index = _mm512_mask_reduce_min_epi32(equal, row.index);
  const __mmask16 winner = _mm512_mask_cmpeq_epi32_mask(equal, row.index, _mm512_set1_epi32(index));
  nearest.of_current[at] = index;
  nearest.distance[at] = best;
  nearest.second_distance[at] =
      has_second ? _mm512_reduce_min_epi32(_mm512_mask_mov_epi32(row.best, winner, row.second)) : kFar;
}

/// Sixteen targets at a time and two current descriptors: with a about 128 and b as it is,
/// |a - b|^2 = |a|^2 + |b|^2 - 2 (a.b - 128 sum(a)). `Fours` of dimensions; 0: as many as there are.
template <std::size_t Fours>
__attribute__((target("avx512f,avx512vnni"))) NearestNeighbours compare_vnni(const ByteDescriptors& current,
                                                                             const ByteDescriptors& target) {
  constexpr std::size_t kWide = WideBlocks::kWide;
  NearestNeighbours nearest = nothing_yet(current.rows(), target.rows());
  const WideBlocks blocks(target);
  const std::size_t fours = Fours == 0 ? blocks.fours : Fours;
  const std::size_t block_count = blocks.squared_norms.size() / kWide;
  const auto length = static_cast<std::size_t>(current.cols());
  const auto count = static_cast<std::size_t>(current.rows());
  std::vector<std::int32_t> target_distance(blocks.squared_norms.size(), kFar);
  std::vector<std::int32_t> target_index(blocks.squared_norms.size(), 0);
  WideRow even{std::vector<std::int32_t>(fours)};
  WideRow odd = even;
  for (std::size_t i = 0; i < count; i += 2) {
    const std::size_t second_row = std::min(i + 1, count - 1);  // the last one twice: equals change nothing
    even.set(current.data() + i * length, length);
    odd.set(current.data() + second_row * length, length);
    WideBest of_even{_mm512_set1_epi32(kFar), _mm512_set1_epi32(kFar), _mm512_setzero_si512()};
    WideBest of_odd = of_even;
    __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const std::int32_t* const even_fours = even.fours.data();
    const std::int32_t* const odd_fours = odd.fours.data();
    for (std::size_t b = 0; b < block_count; ++b) {
      const std::uint8_t* numbers = blocks.numbers.data() + b * fours * 4 * kWide;
      __m512i even_product = _mm512_setzero_si512();
      __m512i odd_product = _mm512_setzero_si512();
      for (std::size_t f = 0; f < fours; ++f) {
        const __m512i four = _mm512_loadu_si512(numbers + f * 4 * kWide);
        even_product = _mm512_dpbusd_epi32(even_product, four, _mm512_set1_epi32(even_fours[f]));
        odd_product = _mm512_dpbusd_epi32(odd_product, four, _mm512_set1_epi32(odd_fours[f]));
      }
      const __m512i norms = _mm512_loadu_si512(blocks.squared_norms.data() + b * kWide);
      const __m512i even_distance =
          _mm512_sub_epi32(_mm512_add_epi32(norms, _mm512_set1_epi32(even.offset)), _mm512_slli_epi32(even_product, 1));
      const __m512i odd_distance =
          _mm512_sub_epi32(_mm512_add_epi32(norms, _mm512_set1_epi32(odd.offset)), _mm512_slli_epi32(odd_product, 1));
      take(of_even, even_distance, index);
      take(of_odd, odd_distance, index);
      index = _mm512_add_epi32(index, _mm512_set1_epi32(kWide));

      __m512i known = _mm512_loadu_si512(target_distance.data() + b * kWide);
      __m512i known_index = _mm512_loadu_si512(target_index.data() + b * kWide);
      known_index = _mm512_mask_mov_epi32(known_index, _mm512_cmpgt_epi32_mask(known, even_distance),
                                          _mm512_set1_epi32(static_cast<std::int32_t>(i)));
      known = _mm512_min_epi32(known, even_distance);
      known_index = _mm512_mask_mov_epi32(known_index, _mm512_cmpgt_epi32_mask(known, odd_distance),
                                          _mm512_set1_epi32(static_cast<std::int32_t>(second_row)));
      known = _mm512_min_epi32(known, odd_distance);
      _mm512_storeu_si512(target_distance.data() + b * kWide, known);
      _mm512_storeu_si512(target_index.data() + b * kWide, known_index);
    }
    finish(of_even, i, target.rows() > 1, nearest);
    finish(of_odd, second_row, target.rows() > 1, nearest);
  }
  std::copy_n(target_index.begin(), nearest.of_target.size(), nearest.of_target.begin());
  return nearest;
}

#endif

}  // namespace

NearestNeighbours find_nearest_portable(const ByteDescriptors& current, const ByteDescriptors& target) {
  NearestNeighbours nearest = nothing_yet(current.rows(), target.rows());
  std::vector<std::int32_t> target_distance(static_cast<std::size_t>(target.rows()), kFar);
  for (Eigen::Index i = 0; i < current.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < target.rows(); ++j) {
      std::int32_t distance = 0;
      for (Eigen::Index d = 0; d < current.cols(); ++d) {
        const std::int32_t difference = current(i, d) - target(j, d);
        distance += difference * difference;
      }
      if (distance < nearest.distance[at]) {
        nearest.second_distance[at] = nearest.distance[at];
        nearest.distance[at] = distance;
        nearest.of_current[at] = static_cast<std::int32_t>(j);
      } else if (distance < nearest.second_distance[at]) {
        nearest.second_distance[at] = distance;
      }
      auto& closest = target_distance[static_cast<std::size_t>(j)];
      if (distance < closest) {
        closest = distance;
        nearest.of_target[static_cast<std::size_t>(j)] = static_cast<std::int32_t>(i);
      }
    }
  }
  return nearest;
}

NearestNeighbours find_nearest_avx2(const ByteDescriptors& current, const ByteDescriptors& target) {
#if defined(__x86_64__)
  if (has_avx2()) return compare_avx2(current, target);
#endif
  return find_nearest_portable(current, target);
}

NearestNeighbours find_nearest(const ByteDescriptors& current, const ByteDescriptors& target) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512vnni")) {
    constexpr Eigen::Index kUsualLength = 32;  // of a SIFT code
    return current.cols() == kUsualLength ? compare_vnni<kUsualLength / 4>(current, target)
                                          : compare_vnni<0>(current, target);
  }
  return find_nearest_avx2(current, target);
#else
  return find_nearest_portable(current, target);
#endif
}

}  // namespace homeward::matching
