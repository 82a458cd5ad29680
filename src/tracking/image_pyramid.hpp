// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::tracking {

struct PyramidConfig {
  int levels = 3;             // each half as wide and high as the one before (Segvic et al. 2007, §4)
  double smoothing_px = 0.8;  // standard deviation of the blur, on every level in its own pixels; 0: none on the finest
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const PyramidConfig& config);

/// Grey levels, 0 to 255, smoothed: rows from the top, with a border of kBorder_px on every side that repeats the
/// picture's own outermost pixels, so that patches may reach out of it.
struct GreyLevel {
  static constexpr int kBorder_px = 12;
  static constexpr std::size_t kSpare = 64;  // numbers behind the last row: whole registers may be read

  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride = 0;  // numbers from one row to the next
  std::vector<float> grey;

  GreyLevel() = default;
  GreyLevel(int width, int height)
      : width_px(width),
        height_px(height),
        stride(width + 2 * kBorder_px),
        grey(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2 * kBorder_px) + kSpare) {}
  /// Pixel 0 of a row, -kBorder_px to height_px + kBorder_px - 1.
  [[nodiscard]] const float* row(int v) const { return grey.data() + (v + kBorder_px) * stride + kBorder_px; }
  [[nodiscard]] float* row(int v) { return grey.data() + (v + kBorder_px) * stride + kBorder_px; }
};

/// A raw perspective picture made ready for tracking. A pixel of the picture lies at pixel / 2^level of a level: every
/// level is each second pixel of the one before, blurred so that all are equally smooth. There are no gradients in it:
/// the tracker needs those of reference patches alone, and makes them from the patches.
class ImagePyramid {
 public:
  static constexpr int kMostLevels = 5;
  static constexpr int kSmallestSide_px = 16;

  /// `picture`: grey or RGB. Levels that would be smaller than kSmallestSide_px are left out.
  /// Errors: kEmptyInput (no pixels), kInvalidInput (a bad configuration, channels other than 1 or 3, data of another
  /// size than its width and height say, less than kSmallestSide_px wide or high).
  static Result<ImagePyramid> build(const Image& picture, const PyramidConfig& config = {});

  /// Finest first; at least one.
  [[nodiscard]] const std::vector<GreyLevel>& levels() const { return levels_; }
  [[nodiscard]] int width_px() const { return levels_.front().width_px; }
  [[nodiscard]] int height_px() const { return levels_.front().height_px; }

 private:
  std::vector<GreyLevel> levels_;
};

}  // namespace homeward::tracking
