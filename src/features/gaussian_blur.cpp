// SPDX-License-Identifier: Apache-2.0
#include "features/gaussian_blur.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>

#include "features/blur_strips.hpp"

namespace homeward::features {
namespace {

template <class Number, class Matrix>
FloatPicture<Number> numbers_of(Matrix& picture) {
  return {picture.template ptr<float>(), static_cast<std::ptrdiff_t>(picture.step1()), picture.rows, picture.cols};
}

}  // namespace

void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma_px) {
  constexpr double kReachOfSigma = 4.0;  // as cv::GaussianBlur has it
  const int taps = cvRound(2.0 * kReachOfSigma * sigma_px + 1.0) | 1;
  if (std::min(from.rows, from.cols) > taps / 2) {
    const cv::Mat weights = cv::getGaussianKernel(taps, sigma_px, CV_32F);
    const std::span<const float> kernel(weights.ptr<float>(), static_cast<std::size_t>(taps));
    to.create(from.rows, from.cols, CV_32F);
    if (blur_by_strips(numbers_of<const float>(from), kernel, numbers_of<float>(to))) return;
  }
  cv::GaussianBlur(from, to, {}, sigma_px, sigma_px);
}

}  // namespace homeward::features
