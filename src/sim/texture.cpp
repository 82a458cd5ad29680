// SPDX-License-Identifier: Apache-2.0
#include "sim/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/lighting.hpp"

namespace homeward::sim {
namespace {

/// std::floor calls a function where the processor is not known to round by itself; coordinates of textures are small.
float floor_of(float value) {
  const auto whole = static_cast<float>(static_cast<int>(value));
  return whole > value ? whole - 1.0F : whole;
}

}  // namespace

MipTexture::MipTexture(const Image& texture) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(static_cast<std::uint8_t>(i));
  Level first{texture.width_px, texture.height_px, std::vector<float>(texture.data.size())};
  std::transform(texture.data.begin(), texture.data.end(), first.rgb.begin(),
                 [&](std::uint8_t value) { return linear[value]; });
  levels_.push_back(std::move(first));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& above = levels_.back();
    Level below{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
    below.rgb.resize(static_cast<std::size_t>(below.width) * static_cast<std::size_t>(below.height) * 3);
    for (int y = 0; y < below.height; ++y) {
      for (int x = 0; x < below.width; ++x) {
        for (int band = 0; band < 3; ++band) {
          float sum = 0.0F;
          for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
            const int xx = std::min(above.width - 1, 2 * x + dx);
            const int yy = std::min(above.height - 1, 2 * y + dy);
            const int at = (yy * above.width + xx) * 3 + band;
            sum += above.rgb[static_cast<std::size_t>(at)];
          }
          const int at = (y * below.width + x) * 3 + band;
          below.rgb[static_cast<std::size_t>(at)] = 0.25F * sum;
        }
      }
    }
    levels_.push_back(std::move(below));
  }
}

Eigen::Array3f MipTexture::bilinear(const Level& level, float u, float v) {
  const float x = (u - floor_of(u)) * static_cast<float>(level.width) - 0.5F;
  const float y = (v - floor_of(v)) * static_cast<float>(level.height) - 0.5F;
  const float left = floor_of(x);
  const float top = floor_of(y);
  const float right_share = x - left;
  const float bottom_share = y - top;
  const int x0 = left < 0.0F ? level.width - 1 : std::min(static_cast<int>(left), level.width - 1);
  const int y0 = top < 0.0F ? level.height - 1 : std::min(static_cast<int>(top), level.height - 1);
  const int x1 = x0 + 1 == level.width ? 0 : x0 + 1;
  const int y1 = y0 + 1 == level.height ? 0 : y0 + 1;
  const auto at = [&](int column, int row) {
    return Eigen::Map<const Eigen::Array3f>(level.rgb.data() +
                                            static_cast<std::size_t>((row * level.width + column) * 3));
  };
  return (1.0F - bottom_share) * ((1.0F - right_share) * at(x0, y0) + right_share * at(x1, y0)) +
         bottom_share * ((1.0F - right_share) * at(x0, y1) + right_share * at(x1, y1));
}

Eigen::Array3f MipTexture::sample(float u, float v, float texels) const {
  // The nearest copy: the logarithm to base 2, rounded, is the exponent of sqrt(2) times as much.
  int exponent = 0;
  std::frexp(1.41421356F * std::max(1.0F, texels), &exponent);
  return bilinear(levels_[std::min(levels_.size() - 1, static_cast<std::size_t>(exponent - 1))], u, v);
}

}  // namespace homeward::sim
