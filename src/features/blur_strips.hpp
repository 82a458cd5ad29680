// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace homeward::features {

/// A picture of 32-bit floating point numbers in memory; `stride` is the number of floats from one row to the next.
template <class Number>
struct FloatPicture {
  Number* first;
  std::ptrdiff_t stride;
  int rows;
  int columns;

  [[nodiscard]] Number* row(int r) const { return first + r * stride; }
};

/// Convolves `from` along its rows and down its columns with a symmetric kernel of an odd number of weights, the
/// picture mirrored at its border, the border itself once. The picture is more than half a kernel high and wide; `to`
/// is as large and does not overlap it. By fused multiply-adds in one fixed order, so that the numbers are the same on
/// every processor that has them; false, with nothing done, on one that does not.
[[nodiscard]] bool blur_by_strips(const FloatPicture<const float>& from, std::span<const float> kernel,
                                  const FloatPicture<float>& to);

}  // namespace homeward::features
