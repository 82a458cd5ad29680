// SPDX-License-Identifier: Apache-2.0
#include "features/column_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace homeward::features::column_gradient_test {
namespace {

TEST(NthSmallest, IsWhatSortingPutsThere) {
  std::mt19937 random(4);
  for (const int count : {1, 2, 7, 100, 3000}) {
    std::vector<float> values;
    for (int i = 0; i < count; ++i) {
      // Of all sizes, many of them equal, and some 0.
      const auto fraction = static_cast<float>(random() % 64) / 64.0F;
      values.push_back(random() % 9 == 0 ? 0.0F : std::ldexp(fraction, static_cast<int>(random() % 300) - 150));
    }
    std::vector<float> sorted = values;
    std::ranges::sort(sorted);
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      const auto n = static_cast<std::size_t>(share * (count - 1));
      EXPECT_EQ(nth_smallest(values, n), sorted[n]) << count << " values, " << n;
    }
  }
}

constexpr int kColumns = 40;
constexpr int kRows = 60;

/// Plain, but brighter from row 20 to below row 40.
cv::Mat bar() {
  cv::Mat grey(kColumns, kRows, CV_16U, cv::Scalar(50.0 * kGreyLevel));
  grey.colRange(20, 40).setTo(150.0 * kGreyLevel);
  return grey;
}

TEST(SegmentsBetweenMaxima, LieBetweenTheEdgesOfEachColumn) {
  const auto segments = segments_between_maxima(bar(), cv::Mat(kColumns, kRows, CV_8U, cv::Scalar(1)), 4.0);
  ASSERT_EQ(segments.size(), static_cast<std::size_t>(kColumns));
  for (int u = 0; u < kColumns; ++u) {
    const ColumnSegment& segment = segments[static_cast<std::size_t>(u)];
    EXPECT_EQ(segment.u_px, u);
    EXPECT_NEAR(segment.top_px, 19.5, 0.51);
    EXPECT_NEAR(segment.bottom_px, 39.5, 0.51);
  }
}

TEST(SegmentsBetweenMaxima, NeitherEndNorLieOnWhatIsNotTrusted) {
  cv::Mat trusted(kColumns, kRows, CV_8U, cv::Scalar(1));
  trusted.at<std::uint8_t>(7, 30) = 0;                   // between the edges
  trusted.row(9).colRange(17, 23).setTo(cv::Scalar(0));  // an edge
  const auto segments = segments_between_maxima(bar(), trusted, 4.0);
  EXPECT_EQ(segments.size(), static_cast<std::size_t>(kColumns) - 2);
  for (const ColumnSegment& segment : segments) EXPECT_TRUE(segment.u_px != 7 && segment.u_px != 9);
}

TEST(SegmentsBetweenMaxima, ShorterOnesAndPlainPicturesHaveNone) {
  const cv::Mat trusted(kColumns, kRows, CV_8U, cv::Scalar(1));
  EXPECT_TRUE(segments_between_maxima(bar(), trusted, 25.0).empty());
  EXPECT_TRUE(segments_between_maxima(cv::Mat(kColumns, kRows, CV_16U, cv::Scalar(9000)), trusted, 4.0).empty());
}

}  // namespace
}  // namespace homeward::features::column_gradient_test
