// SPDX-License-Identifier: Apache-2.0
#include "pipeline/thumbnail.hpp"

#include "imageio/decode.hpp"

namespace homeward::pipeline {

Result<std::vector<std::uint8_t>> make_thumbnail(const Eye& eye, const Image& picture, int width_px) {
  constexpr int kQuality = 75;
  const auto panorama = eye.unwrap(picture);
  if (!panorama) return pass_on(panorama);
  return imageio::encode_jpeg(imageio::shrink_to_fit(panorama->rgb, width_px, width_px), kQuality);
}

}  // namespace homeward::pipeline
