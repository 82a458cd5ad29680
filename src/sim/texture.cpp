// SPDX-License-Identifier: Apache-2.0
#include "sim/texture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "sim/lighting.hpp"

namespace homeward::sim {
namespace {

/// std::floor calls a function where the processor is not known to round by itself; coordinates of textures are small.
float floor_of(float value) {
  const auto whole = static_cast<float>(static_cast<int>(value));
  return whole > value ? whole - 1.0F : whole;
}

/// The whole number nearest to the logarithm of a number from 1 on to base 2: the exponent of sqrt(2) times as much.
std::size_t nearest_log2(float number) {
  return static_cast<std::size_t>(std::bit_cast<std::uint32_t>(1.41421356F * number) >> 23U) - 127U;
}

}  // namespace

MipTexture::MipTexture(const Image& texture) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(static_cast<std::uint8_t>(i));
  Level first{texture.width_px, texture.height_px, {}};
  first.texels.reserve(texture.data.size() / 3);
  for (std::size_t i = 0; i + 2 < texture.data.size(); i += 3) {
    first.texels.emplace_back(linear[texture.data[i]], linear[texture.data[i + 1]], linear[texture.data[i + 2]], 0.0F);
  }
  levels_.push_back(std::move(first));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(half_of(levels_.back()));
}

MipTexture::Level MipTexture::half_of(const Level& above) {
  Level below{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
  below.texels.reserve(static_cast<std::size_t>(below.width) * static_cast<std::size_t>(below.height));
  for (int y = 0; y < below.height; ++y) {
    for (int x = 0; x < below.width; ++x) {
      const int right = std::min(above.width - 1, 2 * x + 1);
      const int bottom = std::min(above.height - 1, 2 * y + 1);
      below.texels.emplace_back(0.25F *
                                (above.texels[above.index(2 * x, 2 * y)] + above.texels[above.index(right, 2 * y)] +
                                 above.texels[above.index(2 * x, bottom)] + above.texels[above.index(right, bottom)]));
    }
  }
  return below;
}

Eigen::Array4f MipTexture::bilinear(const Level& level, float u, float v) {
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
  const Eigen::Array4f* upper = level.texels.data() + level.index(0, y0);
  const Eigen::Array4f* lower = level.texels.data() + level.index(0, y1);
  return (1.0F - bottom_share) * ((1.0F - right_share) * upper[x0] + right_share * upper[x1]) +
         bottom_share * ((1.0F - right_share) * lower[x0] + right_share * lower[x1]);
}

Eigen::Array4f MipTexture::sample(float u, float v, float texels) const {
  return bilinear(levels_[std::min(levels_.size() - 1, nearest_log2(std::max(1.0F, texels)))], u, v);
}

}  // namespace homeward::sim
