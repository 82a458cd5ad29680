// SPDX-License-Identifier: Apache-2.0
#include "features/extremum_rows.hpp"

#include <bit>
#include <cstddef>

#include "core/processor.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace homeward::features {
namespace {

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

using Sources = std::span<const float* const>;
using Differences = std::span<float* const>;

/// From column `first` on.
void subtract_plain(Sources blurred, Differences differences, int first, int columns) {
  for (std::size_t d = 0; d < differences.size(); ++d) {
    for (int c = first; c < columns; ++c) differences[d][c] = blurred[d + 1][c] - blurred[d][c];
  }
}

/// The columns of the middle row that stand out, from `first` on; few do.
void find_candidates_plain(const RowBand& band, int first, int end, float floor, std::vector<int>& found) {
  for (int c = first; c < end; ++c) {
    if (stands_out(band, c, floor)) found.push_back(c);
  }
}

#if defined(__x86_64__)

constexpr int kLanes = 8;  // numbers of one AVX2 register

__attribute__((target("avx2"))) void subtract_avx2(Sources blurred, Differences differences, int columns) {
  int c = 0;
  for (; c + kLanes <= columns; c += kLanes) {
    __m256 sharp = _mm256_loadu_ps(blurred[0] + c);
    for (std::size_t d = 0; d < differences.size(); ++d) {
      const __m256 soft = _mm256_loadu_ps(blurred[d + 1] + c);
      _mm256_storeu_ps(differences[d] + c, _mm256_sub_ps(soft, sharp));
      sharp = soft;
    }
  }
  subtract_plain(blurred, differences, c, columns);
}

__attribute__((target("avx2"))) void find_candidates_avx2(const RowBand& band, int first, int end, float floor,
                                                          std::vector<int>& found) {
  const __m256 above_floor = _mm256_set1_ps(floor);
  const __m256 below_floor = _mm256_set1_ps(-floor);
  int c = first;
  for (; c + kLanes <= end; c += kLanes) {
    const __m256 v = _mm256_loadu_ps(band.here + c);
    const __m256 high = _mm256_cmp_ps(v, above_floor, _CMP_GT_OQ);
    const __m256 low = _mm256_cmp_ps(v, below_floor, _CMP_LT_OQ);
    if (_mm256_movemask_ps(_mm256_or_ps(high, low)) == 0) continue;
    const __m256 left = _mm256_loadu_ps(band.here + c - 1);
    const __m256 right = _mm256_loadu_ps(band.here + c + 1);
    const __m256 up = _mm256_loadu_ps(band.above + c);
    const __m256 down = _mm256_loadu_ps(band.below + c);
    const __m256 largest = _mm256_max_ps(_mm256_max_ps(left, right), _mm256_max_ps(up, down));
    const __m256 smallest = _mm256_min_ps(_mm256_min_ps(left, right), _mm256_min_ps(up, down));
    const __m256 peak = _mm256_and_ps(high, _mm256_cmp_ps(v, largest, _CMP_GE_OQ));
    const __m256 pit = _mm256_and_ps(low, _mm256_cmp_ps(v, smallest, _CMP_LE_OQ));
    auto marks = static_cast<unsigned>(_mm256_movemask_ps(_mm256_or_ps(peak, pit)));
    for (; marks != 0; marks &= marks - 1) found.push_back(c + std::countr_zero(marks));
  }
  find_candidates_plain(band, c, end, floor, found);
}

#endif

}  // namespace

void subtract(Sources blurred, Differences differences, int columns) {
#if defined(__x86_64__)
  if (has_avx2()) return subtract_avx2(blurred, differences, columns);
#endif
  subtract_plain(blurred, differences, 0, columns);
}

void find_candidates(const RowBand& band, int first, int end, float floor, std::vector<int>& found) {
  found.clear();
#if defined(__x86_64__)
  if (has_avx2()) return find_candidates_avx2(band, first, end, floor, found);
#endif
  find_candidates_plain(band, first, end, floor, found);
}

}  // namespace homeward::features
