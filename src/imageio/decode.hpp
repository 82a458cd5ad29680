// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::imageio {

enum class ImageFormat { kJpeg, kPng };

struct ImageHeader {
  ImageFormat format = ImageFormat::kJpeg;
  int width_px = 0;
  int height_px = 0;
};

struct DecodeLimits {
  std::size_t max_bytes = 32UL * 1024 * 1024;
  std::int64_t max_pixels = 64LL * 1024 * 1024;
};

/// Type and size from the first bytes, without decoding.
/// Errors: kUnsupportedImage, kTruncatedImage, kImageTooLarge (by `limits`).
Result<ImageHeader> read_header(std::span<const std::uint8_t> bytes, const DecodeLimits& limits = {});

/// Decodes a whole picture to RGB. `where` names it in errors. Half a picture is an error, not a success.
/// Errors: those of read_header, kTruncatedImage.
Result<Image> decode(std::span<const std::uint8_t> bytes, const std::string& where, const DecodeLimits& limits = {});

/// JPEG bytes of an RGB or grey picture, 4:4:4 chroma when quality >= 90.
std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality);

/// PNG bytes of an RGB or grey picture.
std::vector<std::uint8_t> encode_png(const Image& image);

/// The picture made to fit into max_width x max_height, area averaged, never enlarged.
Image shrink_to_fit(const Image& image, int max_width_px, int max_height_px);

}  // namespace homeward::imageio
