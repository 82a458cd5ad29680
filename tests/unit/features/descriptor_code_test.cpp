// SPDX-License-Identifier: Apache-2.0
#include "features/descriptor_code.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace homeward::features::descriptor_code_test {
namespace {

using Descriptor = std::array<float, 128>;
using Code = std::array<std::uint8_t, kMaxSiftCodeLength>;

/// Square roots of shares, like those of a picture: cells differ little from their neighbours.
Descriptor random_descriptor(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
  const float main_direction = 8.0F * uniform(random);
  Descriptor descriptor{};
  float squares = 0.0F;
  for (std::size_t i = 0; i < descriptor.size(); ++i) {
    const float angle = (static_cast<float>(i % 8) - main_direction) * 0.7854F;
    descriptor[i] = 0.3F * uniform(random) + 0.5F * (1.0F + std::cos(angle));
    squares += descriptor[i] * descriptor[i];
  }
  for (float& value : descriptor) value /= std::sqrt(squares);
  return descriptor;
}

double distance(const Descriptor& a, const Descriptor& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
  return std::sqrt(sum);
}

double code_distance(const Descriptor& a, const Descriptor& b, std::size_t length) {
  Code code_a{};
  Code code_b{};
  encode_sift(a, std::span(code_a).first(length));
  encode_sift(b, std::span(code_b).first(length));
  double sum = 0.0;
  for (std::size_t i = 0; i < length; ++i) sum += std::pow(static_cast<double>(code_a[i]) - code_b[i], 2);
  return std::sqrt(sum) / 204.8;  // steps per unit
}

TEST(DescriptorCode, DistancesOfCodesNeverExceedThoseOfDescriptorsButByRounding) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Descriptor a = random_descriptor(2 * seed);
    const Descriptor b = random_descriptor(2 * seed + 1);
    double shorter = 0.0;
    for (const std::size_t length : {16U, 32U, 48U, 64U}) {
      const double coded = code_distance(a, b, length);
      EXPECT_LT(coded, distance(a, b) + 0.02) << seed << " at length " << length;
      EXPECT_GE(coded, shorter) << "a longer code tells more";
      shorter = coded;
    }
  }
}

TEST(DescriptorCode, ThirtyTwoBytesHoldMostOfTheDistance) {
  double kept = 0.0;
  constexpr std::uint64_t kPairs = 200;
  for (std::uint64_t seed = 0; seed < kPairs; ++seed) {
    const Descriptor a = random_descriptor(2 * seed);
    const Descriptor b = random_descriptor(2 * seed + 1);
    kept += code_distance(a, b, 32) / distance(a, b);
  }
  EXPECT_GT(kept / kPairs, 0.85);
}

TEST(DescriptorCode, TheMeanOfACellRowMovesOnlyItsOwnCoefficients) {
  // Every direction of every cell alike: only the coefficient of lowest frequencies is left, near the range's middle.
  Descriptor flat{};
  flat.fill(std::sqrt(1.0F / 128.0F));
  Code code{};
  encode_sift(flat, code);
  int off_zero = 0;
  for (const std::uint8_t value : code) off_zero += value != 128 ? 1 : 0;
  EXPECT_EQ(off_zero, 1);
}

TEST(DescriptorCode, ExtremesAreHeldNotWrapped) {
  Descriptor one{};
  one[0] = 1.0F;
  Descriptor other{};
  other[4] = 1.0F;
  EXPECT_GT(code_distance(one, other, kMaxSiftCodeLength), 0.6 * distance(one, other));
}

TEST(DescriptorCode, BytesAreTheCoefficientsRounded) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Descriptor descriptor = random_descriptor(seed);
    std::array<float, kMaxSiftCodeLength> coefficients{};
    Code code{};
    sift_coefficients(descriptor, coefficients);
    encode_sift(descriptor, code);
    for (std::size_t i = 0; i < code.size(); ++i) {
      const double step = std::clamp(128.0 + 204.8 * static_cast<double>(coefficients[i]), 0.0, 255.0);
      EXPECT_NEAR(code[i], step, 0.501);
    }
  }
}

}  // namespace
}  // namespace homeward::features::descriptor_code_test
