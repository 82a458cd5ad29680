// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/image.hpp"

namespace homeward::testing {

/// A texture without end that is known between the pixels: waves of many directions and lengths from 12 px on.
class WavyTexture {
 public:
  explicit WavyTexture(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (auto& wave : waves_) {
      const double direction = 6.28318 * any(random);
      const double length_px = 12.0 + 40.0 * any(random);
      wave = {6.28318 * std::cos(direction) / length_px, 6.28318 * std::sin(direction) / length_px,
              6.28318 * any(random)};
    }
  }
  /// 128 and about 30 grey levels more or less.
  [[nodiscard]] double at(const Eigen::Vector2d& where) const {
    double sum = 128.0;
    for (const auto& wave : waves_) sum += 9.0 * std::sin(wave[0] * where.x() + wave[1] * where.y() + wave[2]);
    return sum;
  }

 private:
  std::array<std::array<double, 3>, 24> waves_{};
};

struct Seen {
  Eigen::Vector2d moved_px = Eigen::Vector2d::Zero();  // of the texture's point at the picture's pixel (160, 120)
  double scale = 1.0;
  double gain = 1.0;
  double offset = 0.0;

  /// Where a point of the texture appears.
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector2d& of_texture) const {
    const Eigen::Vector2d middle(160.0, 120.0);
    return middle + moved_px + scale * (of_texture - middle);
  }
};

/// A grey picture of 320 x 240.
inline Image picture_of(const WavyTexture& texture, const Seen& seen) {
  Image picture(320, 240, 1);
  const Eigen::Vector2d middle(160.0, 120.0);
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      const Eigen::Vector2d where = (Eigen::Vector2d(u, v) - middle - seen.moved_px) / seen.scale + middle;
      const double grey = std::clamp(seen.gain * texture.at(where) + seen.offset, 0.0, 255.0);
      *picture.at(u, v) = static_cast<std::uint8_t>(std::lround(grey));
    }
  }
  return picture;
}

}  // namespace homeward::testing
