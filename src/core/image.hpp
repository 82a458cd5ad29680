// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace homeward {

/// A picture in memory: height x width x channels, uint8, rows from the top, no padding.
/// Three channels are red, green, blue in this order; one channel is grey.
struct Image {
  int width_px = 0;
  int height_px = 0;
  int channels = 3;
  std::vector<std::uint8_t> data;

  Image() = default;
  Image(int width, int height, int channel_count)
      : width_px(width),
        height_px(height),
        channels(channel_count),
        data(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
             static_cast<std::size_t>(channel_count)) {}

  [[nodiscard]] bool empty() const { return data.empty(); }
  [[nodiscard]] std::uint8_t* at(int u, int v) {
    return data.data() +
           (static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(u)) *
               static_cast<std::size_t>(channels);
  }
  [[nodiscard]] const std::uint8_t* at(int u, int v) const { return const_cast<Image*>(this)->at(u, v); }
};

}  // namespace homeward
