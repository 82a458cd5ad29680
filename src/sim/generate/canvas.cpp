// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace homeward::sim {
namespace {

constexpr int kShift = 4;  // sixteenths of a pixel

cv::Scalar scalar(Rgb colour) { return {double(colour[0]), double(colour[1]), double(colour[2])}; }

int fixed(double value) { return static_cast<int>(std::lround(value * (1 << kShift))); }

cv::Point fixed_point(double u, double v) { return {fixed(u), fixed(v)}; }

}  // namespace

Canvas::Canvas(int width_px, int height_px, Rgb ground) : pixels_(height_px, width_px, CV_8UC3, scalar(ground)) {}

void Canvas::rectangle(double u0, double v0, double u1, double v1, Rgb colour) {
  cv::rectangle(pixels_, fixed_point(u0, v0), fixed_point(u1, v1), scalar(colour), cv::FILLED, cv::LINE_8, kShift);
}

void Canvas::frame(double u0, double v0, double u1, double v1, Rgb colour, int thickness) {
  cv::rectangle(pixels_, fixed_point(u0, v0), fixed_point(u1, v1), scalar(colour), thickness, cv::LINE_AA, kShift);
}

void Canvas::line(double u0, double v0, double u1, double v1, Rgb colour, int thickness) {
  cv::line(pixels_, fixed_point(u0, v0), fixed_point(u1, v1), scalar(colour), thickness, cv::LINE_AA, kShift);
}

void Canvas::ellipse(double u, double v, double radius_u, double radius_v, double angle_rad, Rgb colour) {
  cv::ellipse(pixels_, fixed_point(u, v), cv::Size(fixed(radius_u), fixed(radius_v)),
              angle_rad * 180.0 / std::numbers::pi, 0.0, 360.0, scalar(colour), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::polygon(const std::vector<Eigen::Vector2d>& corners, Rgb colour) {
  std::vector<cv::Point> points;
  points.reserve(corners.size());
  for (const Eigen::Vector2d& corner : corners) points.push_back(fixed_point(corner.x(), corner.y()));
  cv::fillPoly(pixels_, points, scalar(colour), cv::LINE_AA, kShift);
}

void Canvas::fade(double v0, double v1, Rgb above, Rgb below) {
  const int first = std::max(0, static_cast<int>(v0));
  const int last = std::min(pixels_.rows, static_cast<int>(v1));
  for (int v = first; v < last; ++v) {
    const double share = (v - v0) / std::max(1.0, v1 - v0);
    Rgb colour{};
    for (std::size_t band = 0; band < 3; ++band) {
      colour[band] = static_cast<int>(std::lround((1.0 - share) * above[band] + share * below[band]));
    }
    pixels_.row(v).setTo(scalar(colour));
  }
}

void Canvas::grain(Random& random, double u0, double v0, double u1, double v1, Rgb base, int streaks) {
  for (int i = 0; i < streaks; ++i) {
    const double v = uniform(random, v0 + 1, v1 - 1);
    const double from = uniform(random, u0, u1);
    const double to = std::min(u1, from + uniform(random, 20, 160));
    line(from, v, to, v + uniform(random, -2, 2), scaled(base, uniform(random, 0.72, 1.15)), 1);
  }
}

void Canvas::clouds(Random& random, double levels) {
  cv::Mat coarse(9, 9, CV_32FC1);
  for (int v = 0; v < 9; ++v) {
    for (int u = 0; u < 9; ++u) coarse.at<float>(v, u) = static_cast<float>(uniform(random, -levels, levels));
  }
  cv::Mat smooth;
  cv::resize(coarse, smooth, pixels_.size(), 0, 0, cv::INTER_CUBIC);
  for (int v = 0; v < pixels_.rows; ++v) {
    for (int u = 0; u < pixels_.cols; ++u) {
      auto& pixel = pixels_.at<cv::Vec3b>(v, u);
      for (int band = 0; band < 3; ++band)
        pixel[band] = cv::saturate_cast<std::uint8_t>(float(pixel[band]) + smooth.at<float>(v, u));
    }
  }
}

Image Canvas::finished(Random& random, double levels) const {
  Image image(pixels_.cols, pixels_.rows, 3);
  for (int v = 0; v < pixels_.rows; ++v) {
    for (int u = 0; u < pixels_.cols; ++u) {
      const auto& pixel = pixels_.at<cv::Vec3b>(v, u);
      const double change = uniform(random, -levels, levels);
      std::uint8_t* target = image.at(u, v);
      for (int band = 0; band < 3; ++band) target[band] = cv::saturate_cast<std::uint8_t>(pixel[band] + change);
    }
  }
  return image;
}

}  // namespace homeward::sim
