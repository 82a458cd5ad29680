// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace homeward::features {

/// Three rows of one difference of Gaussians, the middle one being searched.
struct RowBand {
  const float* above;
  const float* here;
  const float* below;
};

/// One row of each difference of neighbouring pictures: one fewer than pictures. With the vector instructions that
/// the processor has, as below: the same numbers.
void subtract(std::span<const float* const> blurred, std::span<float* const> differences, int columns);

/// The columns from `first` to below `end` at which the middle row's value is larger than `floor` in size and not
/// beaten by the four next to it: few.
/// The first part of the search for extrema of the scale space: Lowe 2004, §3.1.
void find_candidates(const RowBand& band, int first, int end, float floor, std::vector<int>& found);

}  // namespace homeward::features
