// SPDX-License-Identifier: Apache-2.0
#include "cli/residual_picture.hpp"

#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace homeward::cli {
namespace {

constexpr double kArrow_px = 14.0;  // length of a typical arrow
constexpr double kDarkened = 0.4;

/// The nearest of 1, 2, 5, 10, 20 and so on below.
double rounded(double factor) {
  const double power = std::pow(10.0, std::floor(std::log10(factor)));
  for (const double step : {5.0, 2.0}) {
    if (factor >= step * power) return step * power;
  }
  return power;
}

/// Colours far apart: the hue goes on by the golden angle.
cv::Scalar colour_of(std::size_t number) {
  constexpr double kGoldenAngle_deg = 137.508;
  cv::Mat3f hue(
      1, 1,
      cv::Vec3f(static_cast<float>(std::fmod(kGoldenAngle_deg * static_cast<double>(number), 360.0)), 0.75F, 1.0F));
  cv::Mat3f rgb;
  cv::cvtColor(hue, rgb, cv::COLOR_HSV2RGB);
  const cv::Vec3f colour = 255.0F * rgb(0, 0);
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

/// For OpenCV's drawing with 4 binary places.
cv::Point fine(const Eigen::Vector2d& at_px) {
  constexpr double kPlaces = 16.0;
  return {static_cast<int>(std::lround(kPlaces * at_px.x())), static_cast<int>(std::lround(kPlaces * at_px.y()))};
}

}  // namespace

Image residual_picture(const Image& picture, const std::vector<camera::BoardView>& views,
                       const camera::CalibrationResult& result) {
  constexpr int kShift = 4;
  Image drawn(picture.width_px, picture.height_px, 3);
  cv::Mat canvas(drawn.height_px, drawn.width_px, CV_8UC3, drawn.data.data());
  const cv::Mat view(picture.height_px, picture.width_px, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                     const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat grey = view;
  if (picture.channels == 3) cv::cvtColor(view, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_8U, kDarkened);
  cv::cvtColor(grey, canvas, cv::COLOR_GRAY2RGB);
  const double enlargement = rounded(kArrow_px / std::max(result.rms_px, 1e-3));
  for (std::size_t number = 0; number < result.used.size(); ++number) {
    const camera::UsedView& used = result.used[number];
    const cv::Scalar colour = colour_of(number);
    for (std::size_t i = 0; i < used.predicted_px.size(); ++i) {
      const Eigen::Vector2d& seen_px = views[used.view].corners_px[i];
      const Eigen::Vector2d tip_px = seen_px + enlargement * (used.predicted_px[i] - seen_px);
      cv::circle(canvas, fine(seen_px), 2 << kShift, colour, cv::FILLED, cv::LINE_AA, kShift);
      cv::line(canvas, fine(seen_px), fine(tip_px), colour, 1, cv::LINE_AA, kShift);
    }
  }
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%zu views, RMS %.2f px, arrows x %.0f", result.used.size(), result.rms_px,
                enlargement);
  cv::putText(canvas, text.data(), cv::Point(8, canvas.rows - 10), cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(255),
              1, cv::LINE_AA);
  return drawn;
}

}  // namespace homeward::cli
