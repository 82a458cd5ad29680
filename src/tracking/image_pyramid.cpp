// SPDX-License-Identifier: Apache-2.0
#include "tracking/image_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "features/gaussian_blur.hpp"

namespace homeward::tracking {
namespace {

constexpr double kOfLens_px = 0.5;  // how blurred a picture is as it comes (Lowe 2004, §3.3)
constexpr double kMostSmoothing_px = 4.0;

cv::Mat matrix_of(GreyLevel& level) {
  return {level.height_px, level.width_px, CV_32F, level.row(0),
          static_cast<std::size_t>(level.stride) * sizeof(float)};
}

Status check(const Image& picture) {
  const auto expected = static_cast<std::size_t>(std::max(0, picture.width_px)) *
                        static_cast<std::size_t>(std::max(0, picture.height_px)) *
                        static_cast<std::size_t>(std::max(0, picture.channels));
  if (picture.empty() || expected == 0) return fail(ErrorCode::kEmptyInput, "The picture has no pixels.");
  if (picture.channels != 1 && picture.channels != 3) {
    return fail(ErrorCode::kInvalidInput, "A picture to track in is grey or RGB, with 1 or 3 channels.");
  }
  if (picture.data.size() != expected) {
    return fail(ErrorCode::kInvalidInput, "The picture's data is not as long as its width and height say.");
  }
  if (std::min(picture.width_px, picture.height_px) < ImagePyramid::kSmallestSide_px) {
    return fail(ErrorCode::kInvalidInput, "A picture to track in is at least 16 pixels wide and high.");
  }
  return {};
}

void grey_of(const Image& picture, cv::Mat& grey) {
  const cv::Mat pixels(picture.height_px, picture.width_px, CV_8UC(picture.channels),
                       const_cast<std::uint8_t*>(picture.data.data()));  // cv::Mat has no read-only view
  if (picture.channels == 1) {
    pixels.convertTo(grey, CV_32F);
    return;
  }
  cv::Mat bytes;
  cv::cvtColor(pixels, bytes, cv::COLOR_RGB2GRAY);
  bytes.convertTo(grey, CV_32F);
}

void fill_border(GreyLevel& level) {
  constexpr int kBorder = GreyLevel::kBorder_px;
  for (int v = 0; v < level.height_px; ++v) {
    float* row = level.row(v);
    std::fill_n(row - kBorder, kBorder, row[0]);
    std::fill_n(row + level.width_px, kBorder, row[level.width_px - 1]);
  }
  for (int v = 1; v <= kBorder; ++v) {
    const int last = level.height_px - 1;
    std::copy_n(level.row(0) - kBorder, level.stride, level.row(-v) - kBorder);
    std::copy_n(level.row(last) - kBorder, level.stride, level.row(last + v) - kBorder);
  }
}

GreyLevel halved(const cv::Mat& blurred) {
  GreyLevel level((blurred.cols + 1) / 2, (blurred.rows + 1) / 2);
  for (int v = 0; v < level.height_px; ++v) {
    const float* from = blurred.ptr<float>(2 * v);
    float* to = level.row(v);
    for (int u = 0; u < level.width_px; ++u) to[u] = from[2 * static_cast<std::ptrdiff_t>(u)];
  }
  return level;
}

}  // namespace

std::vector<std::string> problems(const PyramidConfig& config) {
  std::vector<std::string> found;
  if (config.levels < 1 || config.levels > ImagePyramid::kMostLevels) found.emplace_back("levels is not 1 to 5");
  if (!(config.smoothing_px >= 0.0 && config.smoothing_px <= kMostSmoothing_px)) {
    found.emplace_back("smoothing_px is not 0 to 4");
  }
  return found;
}

Result<ImagePyramid> ImagePyramid::build(const Image& picture, const PyramidConfig& config) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  if (const Status fits = check(picture); !fits) return pass_on(fits);
  ImagePyramid pyramid;
  GreyLevel finest(picture.width_px, picture.height_px);
  cv::Mat to = matrix_of(finest);
  if (config.smoothing_px > 0.0) {
    cv::Mat grey;
    grey_of(picture, grey);
    features::gaussian_blur(grey, to, config.smoothing_px);
  } else {
    grey_of(picture, to);
  }
  pyramid.levels_.push_back(std::move(finest));
  // A level has this blur in its own pixels; the next one has it in pixels twice as large.
  const double has_px = std::hypot(kOfLens_px, config.smoothing_px);
  const double adds_px = std::sqrt(3.0) * has_px;
  cv::Mat blurred;
  while (static_cast<int>(pyramid.levels_.size()) < config.levels) {
    GreyLevel& last = pyramid.levels_.back();
    if (std::min(last.width_px, last.height_px) < 2 * kSmallestSide_px) break;
    features::gaussian_blur(matrix_of(last), blurred, adds_px);
    pyramid.levels_.push_back(halved(blurred));
  }
  for (GreyLevel& level : pyramid.levels_) fill_border(level);
  return pyramid;
}

}  // namespace homeward::tracking
