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

  /// Colour at (u, v), repeating, v downwards; `texels` is the footprint's width in texels of the largest copy. Red,
  /// green, blue, and a fourth number that means nothing: four go at once.
  [[nodiscard]] Eigen::Array4f sample(float u, float v, float texels) const;
  [[nodiscard]] int width_px() const { return levels_.front().width; }
  [[nodiscard]] int height_px() const { return levels_.front().height; }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<Eigen::Array4f> texels;  // height x width; red, green, blue, 0
    [[nodiscard]] std::size_t index(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
  };
  [[nodiscard]] static Level half_of(const Level& above);
  [[nodiscard]] static Eigen::Array4f bilinear(const Level& level, float u, float v);
  std::vector<Level> levels_;
};

}  // namespace homeward::sim
