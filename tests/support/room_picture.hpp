// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <string>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "imageio/decode.hpp"

namespace homeward::testing {

inline constexpr int kRoomWidth_px = 384;
inline constexpr int kRoomHeight_px = kRoomWidth_px / 2;

inline camera::CameraConfig small_panorama_camera() {
  camera::CameraConfig camera;
  camera.width_px = kRoomWidth_px;
  camera.height_px = kRoomHeight_px;
  camera.model = camera::Equirectangular{};
  camera.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  camera.robot_from_camera_rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  return camera;
}

/// A picture of a "room": rectangles of random colours, the same for the same seed, with a little noise.
inline std::string room_picture(unsigned room, unsigned noise_seed) {
  std::mt19937 random(room);
  Image image(kRoomWidth_px, kRoomHeight_px, 3);
  for (auto& value : image.data) value = static_cast<std::uint8_t>(60 + room * 13 % 80);
  for (int i = 0; i < 180; ++i) {
    const int left = static_cast<int>(random() % (kRoomWidth_px - 12));
    const int top = static_cast<int>(random() % (kRoomHeight_px - 10));
    const int width = 4 + static_cast<int>(random() % 30);
    const int height = 4 + static_cast<int>(random() % 30);
    const unsigned colour = static_cast<unsigned>(random());
    for (int v = top; v < std::min(kRoomHeight_px, top + height); ++v) {
      for (int u = left; u < std::min(kRoomWidth_px, left + width); ++u) {
        for (int c = 0; c < 3; ++c) image.at(u, v)[c] = static_cast<std::uint8_t>(colour >> (8 * c));
      }
    }
  }
  std::mt19937 noise(noise_seed);
  for (auto& value : image.data) {
    value = static_cast<std::uint8_t>(std::clamp(static_cast<int>(value) + static_cast<int>(noise() % 7) - 3, 0, 255));
  }
  const auto bytes = imageio::encode_jpeg(image, 92);
  return {bytes.begin(), bytes.end()};
}

}  // namespace homeward::testing
