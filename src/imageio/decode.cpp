// SPDX-License-Identifier: Apache-2.0
#include "imageio/decode.hpp"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace homeward::imageio {
namespace {

using Decompressor = std::unique_ptr<void, decltype(&tjDestroy)>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

bool is_jpeg(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kPngSignature.size() && std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin());
}

std::uint32_t big_endian(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return (std::uint32_t{bytes[offset]} << 24U) | (std::uint32_t{bytes[offset + 1]} << 16U) |
         (std::uint32_t{bytes[offset + 2]} << 8U) | std::uint32_t{bytes[offset + 3]};
}

Result<ImageHeader> jpeg_header(std::span<const std::uint8_t> bytes) {
  const Decompressor decompressor(tjInitDecompress(), &tjDestroy);
  ImageHeader header{ImageFormat::kJpeg, 0, 0};
  int subsampling = 0;
  int colour_space = 0;
  const int failed = tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &header.width_px,
                                         &header.height_px, &subsampling, &colour_space);
  if (failed != 0) {
    return fail(ErrorCode::kTruncatedImage,
                std::string("The JPEG's header cannot be read: ") + tjGetErrorStr2(decompressor.get()) + ".");
  }
  // A file of tables alone counts as a success to the decoder.
  if (header.width_px < 1 || header.height_px < 1) {
    return fail(ErrorCode::kTruncatedImage, "The JPEG ends before its picture begins.");
  }
  if (colour_space == TJCS_CMYK || colour_space == TJCS_YCCK) {
    return fail(ErrorCode::kUnsupportedImage, "The JPEG is made for printing (CMYK); send RGB or grey.");
  }
  return header;
}

/// A PNG is signature, IHDR (13 bytes), other chunks, IEND; each chunk is length, type, data, checksum.
Result<ImageHeader> png_header(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHeaderEnd = 8 + 8 + 13 + 4;
  if (bytes.size() < kHeaderEnd || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0) {
    return fail(ErrorCode::kTruncatedImage, "The PNG ends within its header.");
  }
  const std::uint32_t width = big_endian(bytes, 16);
  const std::uint32_t height = big_endian(bytes, 20);
  constexpr std::uint32_t kMaxSide = 1U << 24U;
  if (width == 0 || height == 0) return fail(ErrorCode::kUnsupportedImage, "The PNG has no pixels.");
  if (width > kMaxSide || height > kMaxSide) {
    return fail(ErrorCode::kImageTooLarge, "The PNG claims a side of more than 16 million pixels.");
  }
  return ImageHeader{ImageFormat::kPng, static_cast<int>(width), static_cast<int>(height)};
}

/// Whether all chunks up to IEND lie within the bytes; libpng may paint what it has and only warn.
bool png_is_whole(std::span<const std::uint8_t> bytes) {
  std::size_t offset = kPngSignature.size();
  while (offset + 12 <= bytes.size()) {
    const std::size_t length = big_endian(bytes, offset);
    if (length > bytes.size() - offset - 12) return false;
    if (std::memcmp(bytes.data() + offset + 4, "IEND", 4) == 0) return true;
    offset += 12 + length;
  }
  return false;
}

Result<Image> decode_jpeg(std::span<const std::uint8_t> bytes, const ImageHeader& header, const std::string& where) {
  const Decompressor decompressor(tjInitDecompress(), &tjDestroy);
  Image image(header.width_px, header.height_px, 3);
  // A truncated JPEG is a warning to the decoder, which then paints the rest grey: any warning refuses the picture.
  const int failed = tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), image.data.data(), header.width_px,
                                   0, header.height_px, TJPF_RGB, 0);
  if (failed != 0) {
    return fail(ErrorCode::kTruncatedImage,
                std::string("The JPEG is damaged or incomplete: ") + tjGetErrorStr2(decompressor.get()) + ".", where);
  }
  return image;
}

Result<Image> decode_png(std::span<const std::uint8_t> bytes, const ImageHeader& header, const std::string& where) {
  const auto damaged = [&] { return fail(ErrorCode::kTruncatedImage, "The PNG is damaged or incomplete.", where); };
  if (!png_is_whole(bytes)) return damaged();
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<std::uint8_t*>(bytes.data()));
  cv::Mat bgr;
  try {
    bgr = cv::imdecode(encoded, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return damaged();
  }
  if (bgr.empty() || bgr.cols != header.width_px || bgr.rows != header.height_px) return damaged();
  Image image(header.width_px, header.height_px, 3);
  cv::Mat rgb(header.height_px, header.width_px, CV_8UC3, image.data.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return image;
}

cv::Mat view(const Image& image) {
  return {image.height_px, image.width_px, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.data.data())};
}

}  // namespace

Result<ImageHeader> read_header(std::span<const std::uint8_t> bytes, const DecodeLimits& limits) {
  if (bytes.empty()) return fail(ErrorCode::kUnsupportedImage, "The picture is empty.");
  if (bytes.size() > limits.max_bytes) {
    return fail(ErrorCode::kImageTooLarge, "The picture has " + std::to_string(bytes.size()) + " bytes; the limit is " +
                                               std::to_string(limits.max_bytes) + ".");
  }
  Result<ImageHeader> header = fail(ErrorCode::kUnsupportedImage, "This is neither a JPEG nor a PNG picture.");
  if (is_jpeg(bytes)) header = jpeg_header(bytes);
  if (is_png(bytes)) header = png_header(bytes);
  if (!header) return header;
  const std::int64_t pixels = std::int64_t{header->width_px} * header->height_px;
  if (pixels > limits.max_pixels) {
    return fail(ErrorCode::kImageTooLarge, "The picture has " + std::to_string(header->width_px) + " x " +
                                               std::to_string(header->height_px) + " pixels; the limit is " +
                                               std::to_string(limits.max_pixels) + " in all.");
  }
  return header;
}

Result<Image> decode(std::span<const std::uint8_t> bytes, const std::string& where, const DecodeLimits& limits) {
  const Result<ImageHeader> header = read_header(bytes, limits);
  if (!header) return fail(header.error().code, header.error().message, where);
  return header->format == ImageFormat::kJpeg ? decode_jpeg(bytes, *header, where) : decode_png(bytes, *header, where);
}

std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality) {
  const std::unique_ptr<void, decltype(&tjDestroy)> compressor(tjInitCompress(), &tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  constexpr int kFullChromaQuality = 90;
  const int colour_sampling = quality >= kFullChromaQuality ? TJSAMP_444 : TJSAMP_420;
  tjCompress2(compressor.get(), image.data.data(), image.width_px, 0, image.height_px,
              image.channels == 1 ? TJPF_GRAY : TJPF_RGB, &bytes, &size,
              image.channels == 1 ? TJSAMP_GRAY : colour_sampling, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owner(bytes, &tjFree);
  return {bytes, bytes + size};
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  cv::Mat stored = view(image);
  if (image.channels == 3) cv::cvtColor(view(image), stored = cv::Mat(), cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", stored, bytes);
  return bytes;
}

Image shrink_to_fit(const Image& image, int max_width_px, int max_height_px) {
  const double scale = std::min(
      {1.0, static_cast<double>(max_width_px) / image.width_px, static_cast<double>(max_height_px) / image.height_px});
  if (scale == 1.0) return image;
  Image small(std::max(1, static_cast<int>(image.width_px * scale)),
              std::max(1, static_cast<int>(image.height_px * scale)), image.channels);
  cv::Mat target(small.height_px, small.width_px, CV_8UC(small.channels), small.data.data());
  cv::resize(view(image), target, target.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace homeward::imageio
