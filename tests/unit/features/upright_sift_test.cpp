// SPDX-License-Identifier: Apache-2.0
#include "features/upright_sift.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace homeward::features::upright_sift_test {
namespace {

/// Grey with Gaussian blobs on it.
struct Blob {
  double u_px;
  double v_px;
  double sigma_px;
  double height_levels;
};

cv::Mat picture_of(const std::vector<Blob>& blobs, int width_px = 200, int height_px = 120, double gain = 1.0,
                   double offset = 0.0) {
  cv::Mat grey(height_px, width_px, CV_8U);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      double level = 100.0;
      for (const Blob& blob : blobs) {
        const double away2 = std::pow(u - blob.u_px, 2) + std::pow(v - blob.v_px, 2);
        level += blob.height_levels * std::exp(-0.5 * away2 / (blob.sigma_px * blob.sigma_px));
      }
      grey.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(gain * level + offset);
    }
  }
  return grey;
}

TEST(UprightSift, FindsABlobWhereItIsAndAsLargeAsItIs) {
  for (const double sigma_px : {1.5, 3.0, 6.0}) {
    const Blob blob{97.3, 61.6, sigma_px, 80.0};
    const auto points = UprightSift(picture_of({blob})).detect(0.02);
    ASSERT_FALSE(points.empty()) << sigma_px;
    const auto strongest = std::max_element(points.begin(), points.end(),
                                            [](const auto& a, const auto& b) { return a.response < b.response; });
    EXPECT_NEAR(strongest->u_px, blob.u_px, 0.15) << sigma_px;
    EXPECT_NEAR(strongest->v_px, blob.v_px, 0.15) << sigma_px;
    EXPECT_NEAR(strongest->sigma_px / sigma_px, 1.0, 0.25) << sigma_px;
  }
}

TEST(UprightSift, DarkBlobsCountAsBrightOnes) {
  EXPECT_FALSE(UprightSift(picture_of({{100, 60, 3, -80}})).detect(0.02).empty());
}

TEST(UprightSift, APlainOrATinyPictureHasNone) {
  EXPECT_TRUE(UprightSift(cv::Mat(120, 200, CV_8U, cv::Scalar(255))).detect(0.001).empty());
  EXPECT_TRUE(UprightSift(cv::Mat(1, 1, CV_8U, cv::Scalar(7))).detect(0.001).empty());
  EXPECT_TRUE(UprightSift(cv::Mat(3, 400, CV_8U, cv::Scalar(7))).detect(0.001).empty());
}

TEST(UprightSift, AnEdgeIsNoPoint) {
  cv::Mat step(120, 200, CV_8U, cv::Scalar(60));
  step.colRange(100, 200).setTo(180);
  cv::GaussianBlur(step, step, {}, 1.0);
  EXPECT_TRUE(UprightSift(step).detect(0.02).empty());
}

using Descriptor = std::array<float, UprightSift::kDescriptorLength>;

Descriptor describe_strongest(const cv::Mat& grey) {
  const UprightSift sift(grey);
  const auto points = sift.detect(0.01);
  Descriptor descriptor{};
  if (points.empty()) return descriptor;
  sift.describe(*std::max_element(points.begin(), points.end(),
                                  [](const auto& a, const auto& b) { return a.response < b.response; }),
                descriptor.data());
  return descriptor;
}

double distance(const Descriptor& a, const Descriptor& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i] - b[i]), 2);
  return std::sqrt(sum);
}

const std::vector<Blob> kGroup = {{100, 60, 3, 90}, {108, 52, 2, -40}, {90, 66, 2.5, 50}};

TEST(UprightSift, ADescriptorHasLengthOneAndLightDoesNotChangeIt) {
  const Descriptor as_is = describe_strongest(picture_of(kGroup));
  double squares = 0.0;
  for (const float value : as_is) squares += static_cast<double>(value) * static_cast<double>(value);
  EXPECT_NEAR(squares, 1.0, 1e-4);
  // Rounding to 8 bits is what is left.
  EXPECT_LT(distance(as_is, describe_strongest(picture_of(kGroup, 200, 120, 0.7, 20.0))), 0.08);
}

TEST(UprightSift, ATurnedPatchIsAnotherOne) {
  const cv::Mat grey = picture_of(kGroup);
  cv::Mat turned;
  cv::rotate(grey, turned, cv::ROTATE_180);
  EXPECT_GT(distance(describe_strongest(grey), describe_strongest(turned)), 0.4);
}

TEST(UprightSift, AShiftedPictureHasTheSameDescriptor) {
  std::vector<Blob> shifted = kGroup;
  for (Blob& blob : shifted) blob.u_px += 13.4;
  EXPECT_LT(distance(describe_strongest(picture_of(kGroup)), describe_strongest(picture_of(shifted))), 0.12);
}

TEST(UprightSift, PointsAtThePicturesRimCanBeDescribed) {
  const UprightSift sift(picture_of({{100, 60, 3, 90}}));
  for (const SiftPoint& rim :
       {SiftPoint{0, 0, 8, 1, 0, 1}, SiftPoint{199, 119, 20, 1, 2, 3}, SiftPoint{-40, -40, 2, 1, 0, 1}}) {
    Descriptor descriptor{};
    sift.describe(rim, descriptor.data());
    for (const float value : descriptor) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace homeward::features::upright_sift_test
