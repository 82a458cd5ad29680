// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <vector>

namespace homeward::features {

inline constexpr std::size_t kDifferences =
    5;  // of an octave's neighbouring pictures; all but the outer two are searched

/// Three rows of one difference of Gaussians, the middle one being searched.
struct RowBand {
  const float* above;
  const float* here;
  const float* below;
};

/// One row of each difference of neighbouring pictures. With the vector instructions that the processor has, as below:
/// the same numbers.
void subtract(std::span<const float* const, kDifferences + 1> blurred,
              std::span<float* const, kDifferences> differences, int columns);

/// Where a difference stands out.
struct Candidate {
  int layer;  // the difference, 1 to kDifferences - 2
  int column;

  auto operator<=>(const Candidate&) const = default;
};

/// The columns from `first` to below `end` at which the middle row's value is larger than `floor` in size and not
/// beaten by the four next to it nor by those at its place in the differences before and behind: few. In the order of
/// layers and then of columns.
/// The first part of the search for extrema of the scale space: Lowe 2004, §3.1.
void find_candidates(std::span<const RowBand, kDifferences> bands, int first, int end, float floor,
                     std::vector<Candidate>& found);

}  // namespace homeward::features
