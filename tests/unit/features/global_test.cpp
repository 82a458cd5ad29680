// SPDX-License-Identifier: Apache-2.0
#include "features/global.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/painted_room.hpp"

namespace homeward::features::global_test {
namespace {

using homeward::testing::painted_panorama;
using homeward::testing::PaintedRoom;

camera::PanoramaGeometry geometry() {
  camera::PanoramaGeometry geometry;
  geometry.width_px = 256;
  return geometry;
}

camera::Panorama view(std::uint64_t seed, double heading_rad) {
  PaintedRoom room;
  room.seed = seed;
  return painted_panorama(room, {0.4, 0.3, heading_rad}, geometry());
}

// The example of the thesis's table 3.1 (Ferdaus 2008).
constexpr std::array kReference = {6.0F, 26.0F, 37.0F, 26.0F, 3.0F, 2.0F};
constexpr std::array kLike = {3.0F, 25.0F, 38.0F, 25.0F, 8.0F, 1.0F};
constexpr std::array kUnlike = {34.0F, 36.0F, 4.0F, 14.0F, 10.0F, 2.0F};

TEST(GlobalMeasures, OfHistogramsAreTheThesis) {
  EXPECT_NEAR(jeffrey_divergence(kReference, kLike), 0.8187, 1e-4);
  EXPECT_NEAR(jeffrey_divergence(kReference, kUnlike), 13.3570, 1e-4);
  EXPECT_NEAR(chi_square(kReference, kLike), 1.8293, 1e-4);
  EXPECT_NEAR(chi_square(kReference, kUnlike), 27.5716, 1e-4);
  EXPECT_NEAR(sum_of_absolute_differences(kReference, kLike), 12.0, 1e-9);
  EXPECT_NEAR(sum_of_absolute_differences(kReference, kUnlike), 90.0, 1e-9);
}

TEST(GlobalMeasures, TakeEmptyBins) {
  constexpr std::array<float, 3> a = {0.0F, 1.0F, 0.0F};
  constexpr std::array<float, 3> b = {0.0F, 0.0F, 1.0F};
  EXPECT_NEAR(jeffrey_divergence(a, b), 2.0 * std::log10(2.0), 1e-9);
  EXPECT_NEAR(chi_square(a, b), 1.0, 1e-9);
}

class EveryMeasure : public ::testing::TestWithParam<GlobalMeasure> {};

TEST_P(EveryMeasure, IsZeroForTheSameAndSymmetric) {
  const auto a = describe(view(1, 0.0));
  const auto b = describe(view(2, 0.0));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(dissimilarity(GetParam(), *a, *a), 0.0);
  EXPECT_GT(dissimilarity(GetParam(), *a, *b), 0.0);
  EXPECT_DOUBLE_EQ(dissimilarity(GetParam(), *a, *b), dissimilarity(GetParam(), *b, *a));
}

/// The same view after a turn by whole columns of the panorama.
camera::Panorama turned(const camera::Panorama& panorama, int columns) {
  camera::Panorama result = panorama;
  const int width_px = panorama.rgb.width_px;
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const int from = (u + columns) % width_px;
      for (int band = 0; band < 3; ++band)
        result.rgb.at(u, v)[band] = panorama.rgb.data[static_cast<std::size_t>(3 * (v * width_px + from) + band)];
      result.valid[static_cast<std::size_t>(v * width_px + u)] =
          panorama.valid[static_cast<std::size_t>(v * width_px + from)];
    }
  }
  return result;
}

TEST_P(EveryMeasure, ATurnChangesNothing) {
  const auto here = describe(view(1, 0.0));
  const auto elsewhere = describe(view(2, 0.0));
  ASSERT_TRUE(here && elsewhere);
  const double apart = dissimilarity(GetParam(), *here, *elsewhere);
  for (const int columns : {1, 64, 131}) {
    const auto after = describe(turned(view(1, 0.0), columns));
    ASSERT_TRUE(after);
    EXPECT_LT(dissimilarity(GetParam(), *here, *after), 1e-4 * apart) << columns;
  }
}

TEST(GlobalMeasures, ColourHistogramsTellApartWhatIsEquallyGrey) {
  camera::Panorama red = view(1, 0.0);
  camera::Panorama blue = red;
  for (std::size_t i = 0; i + 2 < red.rgb.data.size(); i += 3) {
    const auto base = static_cast<std::uint8_t>(red.rgb.data[i] / 3);
    for (std::size_t band = 0; band < 3; ++band) red.rgb.data[i + band] = blue.rgb.data[i + band] = base;
    red.rgb.data[i] = static_cast<std::uint8_t>(base + 60);        // weighs 0.299 in grey,
    blue.rgb.data[i + 2] = static_cast<std::uint8_t>(base + 157);  // and this 0.114: 18 levels both
  }
  const auto a = describe(red);
  const auto b = describe(blue);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(dissimilarity(GlobalMeasure::kJeffrey, *a, *b), 0.0);
  EXPECT_GT(dissimilarity(GlobalMeasure::kColourJeffrey, *a, *b), 0.5);
  double sum = 0.0;
  for (const float share : a->colour_histogram) sum += static_cast<double>(share);
  EXPECT_NEAR(sum, 1.0, 1e-5);
}

/// Three grey waves round the picture, their height in each row; 4 rows to each band.
camera::Panorama waves(double even_rows, double odd_rows) {
  constexpr int kSide_px = 128;
  camera::Panorama panorama;
  panorama.rgb = Image(kSide_px, kSide_px, 3);
  panorama.valid.assign(std::size_t{kSide_px} * kSide_px, 1);
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) {
      const double wave = (v % 2 == 0 ? even_rows : odd_rows) * std::cos(2.0 * kPi * 3.0 * u / kSide_px);
      const auto value = static_cast<std::uint8_t>(std::lround(128.0 + wave));
      for (int band = 0; band < 3; ++band) panorama.rgb.at(u, v)[band] = value;
    }
  }
  return panorama;
}

TEST(GlobalMeasures, EveryRowTellsApartWhatBandsOfRowsDoNot) {
  const auto a = describe(waves(60.0, 60.0));
  const auto b = describe(waves(0.0, 120.0));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->row_fourier.size(), 128U * 30U);
  // A cosine's magnitude is half its height.
  EXPECT_NEAR(dissimilarity(GlobalMeasure::kRowFourier, *a, *b) / 128.0, 0.5 * 60.0 / 255.0, 0.01);
  EXPECT_LT(dissimilarity(GlobalMeasure::kFourier, *a, *b) / 32.0, 0.01);
}

std::string name_of(const ::testing::TestParamInfo<GlobalMeasure>& measure) {
  return std::string(global_measure_name(measure.param));
}
INSTANTIATE_TEST_SUITE_P(Measures, EveryMeasure, ::testing::ValuesIn(kGlobalMeasures), name_of);

TEST(GlobalDescriptor, WhatTheCameraDoesNotSeeDoesNotCount) {
  camera::Panorama whole = view(1, 0.0);
  camera::Panorama masked = whole;
  const auto pixels = static_cast<std::size_t>(whole.rgb.width_px) * static_cast<std::size_t>(whole.rgb.height_px);
  for (std::size_t i = 0; i < pixels; i += 2) {  // every second pixel is hidden behind white
    masked.valid[i] = 0;
    for (std::size_t band = 0; band < 3; ++band) masked.rgb.data[3 * i + band] = 255;
  }
  const auto a = describe(whole);
  const auto b = describe(masked);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(b->grey_histogram[255], 0.0F);
  EXPECT_LT(dissimilarity(GlobalMeasure::kAbsoluteDifference, *a, *b), 0.3);
  double sum = 0.0;
  for (const float share : b->grey_histogram) sum += static_cast<double>(share);
  EXPECT_NEAR(sum, 1.0, 1e-5);
}

/// A panorama whose pixels are drawn from a range of grey levels.
camera::Panorama noise(int least, int most) {
  camera::Panorama panorama = view(1, 0.0);
  std::uint32_t state = 1;
  for (std::uint8_t& value : panorama.rgb.data) {
    state = state * 1664525U + 1013904223U;
    value =
        static_cast<std::uint8_t>(least + static_cast<int>((state >> 16U) % static_cast<unsigned>(most - least + 1)));
  }
  return panorama;
}

void expect_refused(const camera::Panorama& panorama, ErrorCode code, const std::string& word) {
  const auto described = describe(panorama);
  ASSERT_FALSE(described) << word;
  EXPECT_EQ(described.error().code, code) << word;
  EXPECT_NE(described.error().message.find(word), std::string::npos) << described.error().message;
}

TEST(GlobalDescriptor, PicturesThatShowNothingAreRefused) {
  expect_refused(noise(0, 0), ErrorCode::kTooFewFeatures, "black");
  expect_refused(noise(0, 5), ErrorCode::kTooFewFeatures, "black");  // a covered lens and its noise
  expect_refused(noise(128, 128), ErrorCode::kTooFewFeatures, "one brightness");
  expect_refused(noise(124, 132), ErrorCode::kTooFewFeatures, "one brightness");
  expect_refused(noise(255, 255), ErrorCode::kTooFewFeatures, "over-exposed");
  expect_refused(noise(250, 255), ErrorCode::kTooFewFeatures, "over-exposed");
  camera::Panorama blown = view(1, 0.0);  // a few dark corners are left
  for (std::size_t i = blown.rgb.data.size() / 30; i < blown.rgb.data.size(); ++i) blown.rgb.data[i] = 255;
  expect_refused(blown, ErrorCode::kTooFewFeatures, "over-exposed");
  camera::Panorama unseen = view(1, 0.0);
  std::ranges::fill(unseen.valid, std::uint8_t{0});
  expect_refused(unseen, ErrorCode::kTooFewFeatures, "sees no part");
}

TEST(GlobalDescriptor, EmptyTinyAndBrokenPicturesAreRefused) {
  expect_refused({}, ErrorCode::kEmptyInput, "no pixels");
  camera::Panorama tiny;
  tiny.rgb = Image(8, 4, 3);
  tiny.valid.assign(32, 1);
  for (std::size_t i = 0; i < tiny.rgb.data.size(); ++i) tiny.rgb.data[i] = static_cast<std::uint8_t>(7 * i);
  expect_refused(tiny, ErrorCode::kTooFewFeatures, "too small");
  camera::Panorama broken = view(1, 0.0);
  broken.rgb.data.resize(broken.rgb.data.size() - 3);
  expect_refused(broken, ErrorCode::kInvalidInput, "fit");
  camera::Panorama unmasked = view(1, 0.0);
  unmasked.valid.clear();
  expect_refused(unmasked, ErrorCode::kInvalidInput, "fit");
}

TEST(GlobalDescriptor, ADarkPictureThatShowsSomethingIsDescribed) {
  camera::Panorama dark = view(1, 0.0);
  for (std::uint8_t& value : dark.rgb.data) value = static_cast<std::uint8_t>(value / 6);
  EXPECT_TRUE(describe(dark));
}

}  // namespace
}  // namespace homeward::features::global_test
