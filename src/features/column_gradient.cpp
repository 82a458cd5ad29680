// SPDX-License-Identifier: Apache-2.0
#include "features/column_gradient.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/imgproc.hpp>

namespace homeward::features {
namespace {

constexpr double kGradientSigma_px = 1.8;
// A maximum counts above four standard deviations of the noise: a column of 211 rows then holds 0.01 of chance.
constexpr double kNoiseFactor = 4.0;
constexpr double kEdgeShare = 0.1;
constexpr double kMinGradient = 0.7;  // grey levels for each row: what rounding to whole levels and JPEG leave

/// Rows of kernel weights of a Gaussian and of its derivative.
std::array<cv::Mat, 2> gaussian_and_derivative() {
  constexpr int kSize = 2 * kGradientReach_px + 1;
  cv::Mat gaussian(1, kSize, CV_32F);
  cv::Mat derivative(1, kSize, CV_32F);
  double sum = 0.0;
  double moment = 0.0;
  for (int i = 0; i < kSize; ++i) {
    const double x = i - kGradientReach_px;
    const double weight = std::exp(-0.5 * x * x / (kGradientSigma_px * kGradientSigma_px));
    gaussian.at<float>(i) = static_cast<float>(weight);
    derivative.at<float>(i) = static_cast<float>(x * weight);
    sum += weight;
    moment += x * x * weight;
  }
  gaussian /= sum;
  derivative /= moment * kGreyLevel;  // a ramp of one grey level for each row gives 1
  return {gaussian, derivative};
}

/// Magnitude of the vertical gradient, grey levels for each row; columns of the panorama are rows here.
cv::Mat gradient_magnitude(const cv::Mat& grey) {
  static const std::array<cv::Mat, 2> kernels = gaussian_and_derivative();
  cv::Mat padded;
  cv::copyMakeBorder(grey, padded, kGradientReach_px, kGradientReach_px, 0, 0, cv::BORDER_WRAP);
  cv::Mat gradient;
  cv::sepFilter2D(padded, gradient, CV_32F, kernels[1], kernels[0], {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return cv::abs(gradient.rowRange(kGradientReach_px, padded.rows - kGradientReach_px));
}

/// Pixels all of whose neighbours that the gradient looked at are seen by the camera.
cv::Mat trusted_pixels(const camera::Panorama& panorama) {
  const cv::Mat valid(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC1,
                      const_cast<std::uint8_t*>(panorama.valid.data()));
  constexpr int kReach = kGradientReach_px;
  cv::Mat padded;
  cv::copyMakeBorder(valid, padded, 0, 0, kReach, kReach, cv::BORDER_WRAP);
  cv::copyMakeBorder(padded, padded, kReach, kReach, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::erode(padded, padded, cv::Mat::ones(2 * kReach + 1, 2 * kReach + 1, CV_8U));
  cv::Mat trusted;
  cv::transpose(padded(cv::Rect(kReach, kReach, valid.cols, valid.rows)), trusted);
  return trusted;
}

/// The level above which a gradient is no noise. Most of a picture is plain, so the median of its gradients is the
/// noise's own; it grows with the brightness as the edges do.
double gradient_threshold(const cv::Mat& magnitude, const cv::Mat& trusted) {
  constexpr int kEvery = 5;  // rows; of every column, so that turning the robot changes nothing
  std::vector<float> sample;
  sample.reserve(magnitude.total() / kEvery + 1);
  for (int u = 0; u < magnitude.rows; ++u) {
    const auto* m = magnitude.ptr<float>(u);
    const auto* seen = trusted.ptr<std::uint8_t>(u);
    for (int v = kEvery / 2; v < magnitude.cols; v += kEvery) {
      if (seen[v] != 0) sample.push_back(m[v]);
    }
  }
  if (sample.empty()) return kMinGradient;
  const auto quantile = [&](double share) {
    const auto n = static_cast<std::size_t>(share * static_cast<double>(sample.size() - 1));
    return static_cast<double>(nth_smallest(sample, n));
  };
  constexpr double kMedianOfAbsoluteNormal = 0.6745;
  const double noise = quantile(0.5) / kMedianOfAbsoluteNormal;
  // Where texture is everywhere the median is texture, too; a tenth of any picture may hold edges.
  return std::max(kMinGradient, std::min(kNoiseFactor * noise, quantile(1.0 - kEdgeShare)));
}

/// The rows of one column's maxima that count.
void find_maxima(const float* magnitude, const std::uint8_t* trusted, int height_px, float threshold,
                 std::vector<int>& found) {
  found.clear();
  for (int v = 1; v + 1 < height_px; ++v) {
    const float here = magnitude[v];
    if (here > threshold && here > magnitude[v - 1] && here >= magnitude[v + 1] && trusted[v] != 0) found.push_back(v);
  }
}

/// Row of a maximum to a fraction of a pixel: the vertex of the parabola through it and its neighbours.
double refined_row(const cv::Mat& magnitude, int u, int v) {
  const auto* m = magnitude.ptr<float>(u);
  const double bend = static_cast<double>(m[v - 1]) - 2.0 * static_cast<double>(m[v]) + static_cast<double>(m[v + 1]);
  if (bend >= 0.0) return v;
  return v + std::clamp(0.5 * static_cast<double>(m[v - 1] - m[v + 1]) / bend, -0.5, 0.5);
}

}  // namespace

float nth_smallest(const std::vector<float>& values, std::size_t n) {
  // Such numbers have the order of their bits: counted by the first of them, only those that begin as the one looked
  // for does are put in order.
  constexpr unsigned kLastBits = 20;
  const auto first_bits = [](float value) { return std::bit_cast<std::uint32_t>(value) >> kLastBits; };
  std::array<std::size_t, std::size_t{1} << (32 - kLastBits)> counts{};
  for (const float value : values) ++counts[first_bits(value)];
  std::uint32_t bits = 0;
  for (; n >= counts[bits]; ++bits) n -= counts[bits];
  std::vector<float> alike;
  alike.reserve(counts[bits]);
  std::ranges::copy_if(values, std::back_inserter(alike), [&](float value) { return first_bits(value) == bits; });
  const auto at = alike.begin() + static_cast<std::ptrdiff_t>(n);
  std::ranges::nth_element(alike, at);
  return *at;
}

const cv::Mat& known_trusted_pixels(const camera::Panorama& panorama) {
  thread_local std::vector<std::uint8_t> valid;
  thread_local cv::Mat trusted;
  if (trusted.rows != panorama.rgb.width_px || valid != panorama.valid) {
    trusted = trusted_pixels(panorama);
    valid = panorama.valid;
  }
  return trusted;
}

std::vector<ColumnSegment> segments_between_maxima(const cv::Mat& grey, const cv::Mat& trusted, double min_length_px) {
  const cv::Mat magnitude = gradient_magnitude(grey);
  const auto threshold = static_cast<float>(gradient_threshold(magnitude, trusted));
  std::vector<ColumnSegment> segments;
  std::vector<int> maxima;
  for (int u = 0; u < magnitude.rows; ++u) {
    const auto* seen = trusted.ptr<std::uint8_t>(u);
    find_maxima(magnitude.ptr<float>(u), seen, magnitude.cols, threshold, maxima);
    for (std::size_t i = 0; i + 1 < maxima.size(); ++i) {
      const int top = maxima[i];
      const int bottom = maxima[i + 1];
      if (std::find(seen + top, seen + bottom, std::uint8_t{0}) != seen + bottom) continue;
      const ColumnSegment segment{u, refined_row(magnitude, u, top), refined_row(magnitude, u, bottom)};
      if (segment.bottom_px - segment.top_px >= min_length_px) segments.push_back(segment);
    }
  }
  return segments;
}

}  // namespace homeward::features
