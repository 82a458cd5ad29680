// SPDX-License-Identifier: Apache-2.0
#include "tracking/intensity.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace homeward::tracking::intensity_test {
namespace {

TEST(Intensity, SharesSumToOne) {
  std::vector<std::uint8_t> all(256);
  std::iota(all.begin(), all.end(), std::uint8_t{0});
  const IntensityHistogram histogram = intensity_histogram(all);
  EXPECT_NEAR(std::accumulate(histogram.begin(), histogram.end(), 0.0), 1.0, 1e-5);
  for (const float share : histogram) EXPECT_GT(share, 0.0F);
}

TEST(Intensity, APatchHasEverythingInCommonWithItself) {
  const std::vector<std::uint8_t> patch = {10, 20, 30, 200, 210, 255, 0, 128};
  const IntensityHistogram histogram = intensity_histogram(patch);
  EXPECT_NEAR(in_common(histogram, histogram), 1.0, 1e-5);
}

TEST(Intensity, DarkAndBrightHaveNothingInCommon) {
  const std::vector<std::uint8_t> dark(50, 20);
  const std::vector<std::uint8_t> bright(50, 220);
  EXPECT_EQ(in_common(intensity_histogram(dark), intensity_histogram(bright)), 0.0);
}

TEST(Intensity, AGreyLevelMoreChangesLittle) {
  // Also where a hard border between bins would lie.
  for (int value = 1; value < 254; ++value) {
    const std::vector<std::uint8_t> before(50, static_cast<std::uint8_t>(value));
    const std::vector<std::uint8_t> after(50, static_cast<std::uint8_t>(value + 1));
    EXPECT_GT(in_common(intensity_histogram(before), intensity_histogram(after)), 0.9) << value;
  }
}

TEST(Intensity, AnEmptyPatchHasNothingInCommonWithAnything) {
  const IntensityHistogram nothing = intensity_histogram({});
  EXPECT_EQ(in_common(nothing, nothing), 0.0);
}

}  // namespace
}  // namespace homeward::tracking::intensity_test
