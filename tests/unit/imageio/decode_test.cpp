// SPDX-License-Identifier: Apache-2.0
#include "imageio/decode.hpp"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

namespace homeward::imageio::decode_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Smooth colours and one hard edge.
Image sample_picture(int width_px, int height_px, int channels = 3) {
  Image image(width_px, height_px, channels);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      for (int band = 0; band < channels; ++band) {
        const double wave = 110.0 + 50.0 * std::sin(0.11 * u + 2.0 * band) + 40.0 * std::cos(0.07 * v + band);
        image.at(u, v)[band] = static_cast<std::uint8_t>(u > width_px / 2 ? wave : 255.0 - wave);
      }
    }
  }
  return image;
}

Bytes text(const std::string& characters) { return {characters.begin(), characters.end()}; }

ErrorCode code_of(const Bytes& bytes, const DecodeLimits& limits = {}) {
  const auto image = decode(bytes, "tour/a.jpg", limits);
  EXPECT_FALSE(image);
  if (image) return ErrorCode::kInternal;
  EXPECT_EQ(image.error().where, "tour/a.jpg");
  EXPECT_FALSE(image.error().message.empty());
  return image.error().code;
}

int largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  int largest = 0;
  for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i) {
    largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
  }
  return largest;
}

TEST(Decode, JpegComesBackInItsSizeAndColours) {
  const Image picture = sample_picture(97, 61);
  const Bytes bytes = encode_jpeg(picture, 95);
  const auto header = read_header(bytes);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format, ImageFormat::kJpeg);
  EXPECT_EQ(header->width_px, 97);
  EXPECT_EQ(header->height_px, 61);
  const auto image = decode(bytes, "a");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width_px, 97);
  EXPECT_EQ(image->height_px, 61);
  EXPECT_EQ(image->channels, 3);
  EXPECT_LT(largest_difference(*image, picture), 40);  // at the hard edge; red and blue swapped would differ by 200
}

TEST(Decode, PngComesBackExactly) {
  const Image picture = sample_picture(33, 70);
  const Bytes bytes = encode_png(picture);
  const auto header = read_header(bytes);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format, ImageFormat::kPng);
  const auto image = decode(bytes, "a");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width_px, 33);
  EXPECT_EQ(image->height_px, 70);
  EXPECT_EQ(image->data, picture.data);
}

TEST(Decode, GreyBecomesThreeEqualBands) {
  const Image grey = sample_picture(40, 30, 1);
  for (const Bytes& bytes : {encode_jpeg(grey, 95), encode_png(grey)}) {
    const auto image = decode(bytes, "a");
    ASSERT_TRUE(image);
    ASSERT_EQ(image->channels, 3);
    for (int v = 0; v < 30; ++v) {
      for (int u = 0; u < 40; ++u) {
        ASSERT_EQ(image->at(u, v)[0], image->at(u, v)[1]);
        ASSERT_EQ(image->at(u, v)[0], image->at(u, v)[2]);
        ASSERT_NEAR(image->at(u, v)[0], grey.at(u, v)[0], 40);
      }
    }
  }
}

TEST(Decode, PngWithTransparencyAndSixteenBitsIsRead) {
  for (const int type : {CV_8UC4, CV_16UC3, CV_16UC1}) {
    const cv::Mat stored(20, 25, type, cv::Scalar::all(type == CV_8UC4 ? 200.0 : 200.0 * 257.0));
    Bytes bytes;
    cv::imencode(".png", stored, bytes);
    const auto image = decode(bytes, "a");
    ASSERT_TRUE(image) << type;
    EXPECT_EQ(image->data.size(), 25U * 20U * 3U);
    EXPECT_EQ(static_cast<int>(image->data[100]), 200);
  }
}

TEST(Decode, WhatIsNoPictureIsUnsupported) {
  EXPECT_EQ(code_of({}), ErrorCode::kUnsupportedImage);
  EXPECT_EQ(code_of(text("This is a letter, whatever its name says.")), ErrorCode::kUnsupportedImage);
  EXPECT_EQ(code_of(text("GIF89a\x01\x01")), ErrorCode::kUnsupportedImage);
  EXPECT_EQ(code_of({0xFF}), ErrorCode::kUnsupportedImage);
  EXPECT_EQ(code_of(Bytes(5000, 0)), ErrorCode::kUnsupportedImage);
}

TEST(Decode, PrintersColoursAreUnsupported) {
  const Bytes cmyk(40UL * 30UL * 4UL, 90);
  const std::unique_ptr<void, decltype(&tjDestroy)> compressor(tjInitCompress(), &tjDestroy);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  ASSERT_EQ(tjCompress2(compressor.get(), cmyk.data(), 40, 0, 30, TJPF_CMYK, &buffer, &size, TJSAMP_444, 90, 0), 0);
  const Bytes bytes(buffer, buffer + size);
  tjFree(buffer);
  EXPECT_EQ(code_of(bytes), ErrorCode::kUnsupportedImage);
  EXPECT_NE(decode(bytes, "a").error().message.find("CMYK"), std::string::npos);
}

TEST(Decode, AJpegCutAnywhereIsTruncated) {
  const Bytes whole = encode_jpeg(sample_picture(200, 150), 90);
  ASSERT_TRUE(decode(whole, "a"));
  for (const double share : {0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const auto length = std::max<std::size_t>(4, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
    EXPECT_EQ(code_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), ErrorCode::kTruncatedImage)
        << length << " of " << whole.size();
  }
}

TEST(Decode, APngCutAnywhereIsTruncated) {
  const Bytes whole = encode_png(sample_picture(80, 60));
  for (std::size_t length = 8; length < whole.size(); length += length < 64 ? 1 : 97) {
    EXPECT_EQ(code_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}), ErrorCode::kTruncatedImage)
        << length << " of " << whole.size();
  }
}

/// The checksum of a PNG chunk: CRC-32 of its type and data (ISO/IEC 15948, annex D).
std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xEDB88320U : crc >> 1U;
  }
  return ~crc;
}

TEST(Decode, APngWithDataCutOutIsTruncated) {
  // The chunks hold together, but the compressed data stop early: length and checksum are made right for what is left.
  Bytes bytes = encode_png(sample_picture(80, 60));
  const std::array<std::uint8_t, 4> type = {'I', 'D', 'A', 'T'};
  const auto found = std::search(bytes.begin(), bytes.end(), type.begin(), type.end());
  ASSERT_NE(found, bytes.end());
  const auto length_at = static_cast<std::size_t>(found - bytes.begin()) - 4;
  const std::size_t length = (std::size_t{bytes[length_at + 2]} << 8U) | bytes[length_at + 3];
  ASSERT_GT(length, 200U);
  const std::size_t left = length / 2;
  bytes[length_at + 2] = static_cast<std::uint8_t>(left >> 8U);
  bytes[length_at + 3] = static_cast<std::uint8_t>(left & 0xFFU);
  const auto data_at = static_cast<std::ptrdiff_t>(length_at + 8);
  bytes.erase(bytes.begin() + data_at + static_cast<std::ptrdiff_t>(left),
              bytes.begin() + data_at + static_cast<std::ptrdiff_t>(length));
  const std::uint32_t checksum = crc32(std::span(bytes).subspan(length_at + 4, left + 4));
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[length_at + 8 + left + i] = static_cast<std::uint8_t>(checksum >> (24U - 8U * i));
  }
  EXPECT_EQ(code_of(bytes), ErrorCode::kTruncatedImage);
}

TEST(Decode, HugeSizesAreRefusedFromTheHeader) {
  Bytes png = encode_png(sample_picture(16, 16));
  for (const std::size_t offset : {16U, 20U}) {  // width and height: 65536 x 65536
    png[offset] = 0;
    png[offset + 1] = 1;
    png[offset + 2] = 0;
    png[offset + 3] = 0;
  }
  EXPECT_EQ(code_of(png), ErrorCode::kImageTooLarge);
  png[16] = 0xFF;  // a negative number to a careless reader
  EXPECT_EQ(code_of(png), ErrorCode::kImageTooLarge);
  png[16] = png[17] = png[18] = png[19] = 0;
  EXPECT_EQ(code_of(png), ErrorCode::kUnsupportedImage);

  Bytes jpeg = encode_jpeg(sample_picture(16, 16), 80);
  const std::array<std::uint8_t, 2> frame = {0xFF, 0xC0};
  const auto found = std::search(jpeg.begin(), jpeg.end(), frame.begin(), frame.end());
  ASSERT_NE(found, jpeg.end());
  std::fill(found + 5, found + 9, std::uint8_t{0xFE});  // height and width: 65278
  EXPECT_EQ(code_of(jpeg), ErrorCode::kImageTooLarge);
}

TEST(Decode, LimitsHold) {
  const Bytes bytes = encode_jpeg(sample_picture(64, 48), 90);
  DecodeLimits limits;
  limits.max_pixels = 64 * 48;
  EXPECT_TRUE(decode(bytes, "a", limits));
  limits.max_pixels = 64 * 48 - 1;
  EXPECT_EQ(code_of(bytes, limits), ErrorCode::kImageTooLarge);
  limits = {};
  limits.max_bytes = bytes.size();
  EXPECT_TRUE(decode(bytes, "a", limits));
  limits.max_bytes = bytes.size() - 1;
  EXPECT_EQ(code_of(bytes, limits), ErrorCode::kImageTooLarge);
}

TEST(Decode, ChangedBytesNeverCrash) {
  std::mt19937_64 random(4711);
  DecodeLimits limits;
  limits.max_pixels = 1 << 20;
  const std::array<Bytes, 2> valid = {encode_jpeg(sample_picture(48, 32), 85), encode_png(sample_picture(48, 32))};
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = valid[static_cast<std::size_t>(round % 2)];
    const int changes = 1 + static_cast<int>(random() % 8);
    for (int change = 0; change < changes; ++change) {
      const std::size_t where = random() % bytes.size();
      switch (random() % 3) {
        case 0:
          bytes[where] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(where));
          break;
        default:
          bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(where), static_cast<std::uint8_t>(random()));
      }
    }
    const auto image = decode(bytes, "a", limits);
    if (!image) {
      ++refused;
      const ErrorCode code = image.error().code;
      EXPECT_TRUE(code == ErrorCode::kTruncatedImage || code == ErrorCode::kUnsupportedImage ||
                  code == ErrorCode::kImageTooLarge);
    } else {
      EXPECT_EQ(image->data.size(), static_cast<std::size_t>(image->width_px * image->height_px) * 3U);
    }
  }
  EXPECT_GT(refused, 700);
}

TEST(ShrinkToFit, KeepsProportionsAndNeverEnlarges) {
  const Image small = shrink_to_fit(sample_picture(640, 480), 320, 100);
  EXPECT_EQ(small.width_px, 133);
  EXPECT_EQ(small.height_px, 100);
  EXPECT_EQ(shrink_to_fit(sample_picture(64, 48), 320, 240).width_px, 64);
  EXPECT_EQ(shrink_to_fit(sample_picture(1000, 2), 10, 10).height_px, 1);
  Image halves(2, 1, 1);
  halves.data = {0, 200};
  EXPECT_EQ(static_cast<int>(shrink_to_fit(halves, 1, 1).data[0]), 100);  // the mean of the area
}

}  // namespace
}  // namespace homeward::imageio::decode_test
