// SPDX-License-Identifier: Apache-2.0
#include "features/gaussian_blur.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "support/vector_targets.hpp"

namespace homeward::features::gaussian_blur_test {
namespace {

cv::Mat noise(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat picture(rows, columns, CV_32F);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) picture.at<float>(r, c) = static_cast<float>(random() % 1000) / 1000.0F;
  }
  return picture;
}

TEST(GaussianBlur, GivesWhatOpenCvGives) {
  // Narrower and wider than a strip, whole and broken registers, kernels nearly as large as the picture.
  for (const auto& [rows, columns] : {std::pair(16, 17), {40, 64}, {31, 255}, {30, 256}, {29, 257}, {50, 700}}) {
    for (const double sigma_px : {0.6, 1.2, 1.9, 3.1}) {
      SCOPED_TRACE(::testing::Message() << columns << " x " << rows << ", " << sigma_px);
      const cv::Mat picture = noise(rows, columns, 7);
      cv::Mat theirs;
      cv::GaussianBlur(picture, theirs, {}, sigma_px, sigma_px);
      testing::for_each_vector_target([&] {
        cv::Mat ours;
        gaussian_blur(picture, ours, sigma_px);
        ASSERT_EQ(ours.size(), theirs.size());
        EXPECT_LE(cv::norm(ours, theirs, cv::NORM_INF), 1e-6);
      });
    }
  }
}

TEST(GaussianBlur, OfAPictureSmallerThanItsKernelIsOpenCvs) {
  const cv::Mat picture = noise(5, 9, 3);
  cv::Mat theirs;
  cv::GaussianBlur(picture, theirs, {}, 3.0, 3.0);
  cv::Mat ours;
  gaussian_blur(picture, ours, 3.0);
  EXPECT_EQ(cv::norm(ours, theirs, cv::NORM_INF), 0.0);
}

TEST(GaussianBlur, KeepsTheMemoryThatFits) {
  cv::Mat to(30, 300, CV_32F);
  const auto* memory = to.data;
  gaussian_blur(noise(30, 300, 1), to, 1.5);
  EXPECT_EQ(to.data, memory);
}

}  // namespace
}  // namespace homeward::features::gaussian_blur_test
