// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.hpp"

namespace homeward::sim {

/// A texture in linear light with its smaller copies, so that far surfaces do not sparkle (Williams 1983).
class MipTexture {
 public:
  explicit MipTexture(const Image& texture);

  /// Colour at (u, v), repeating, v downwards; `texels` is the footprint's width in texels of the largest copy.
  [[nodiscard]] Eigen::Array3f sample(float u, float v, float texels) const;
  [[nodiscard]] int width_px() const { return levels_.front().width; }
  [[nodiscard]] int height_px() const { return levels_.front().height; }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  // height x width x 3
  };
  [[nodiscard]] static Eigen::Array3f bilinear(const Level& level, float u, float v);
  std::vector<Level> levels_;
};

}  // namespace homeward::sim
