// SPDX-License-Identifier: Apache-2.0
#include "features/global.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "features/colour.hpp"

namespace homeward::features {
namespace {

constexpr int kRowBands = 32;
constexpr int kFrequencies = 30;
constexpr int kColourLevels = 8;  // of each band

cv::Mat grey_of(const camera::Panorama& panorama) {
  const cv::Mat colour(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC3,
                       const_cast<std::uint8_t*>(panorama.rgb.data.data()));
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

/// Shares of the 256 levels among the pixels that the camera sees; all zero when it sees none.
std::array<float, 256> grey_histogram_of(const cv::Mat& grey, const std::vector<std::uint8_t>& valid) {
  std::array<std::size_t, 256> counts{};
  std::size_t total = 0;
  for (int v = 0; v < grey.rows; ++v) {
    const auto* row = grey.ptr<std::uint8_t>(v);
    const std::size_t first = static_cast<std::size_t>(v) * static_cast<std::size_t>(grey.cols);
    for (int u = 0; u < grey.cols; ++u) {
      if (valid[first + static_cast<std::size_t>(u)] == 0) continue;
      ++counts[row[u]];
      ++total;
    }
  }
  std::array<float, 256> shares{};
  if (total == 0) return shares;
  std::ranges::transform(counts, shares.begin(), [&](std::size_t count) {
    return static_cast<float>(static_cast<double>(count) / static_cast<double>(total));
  });
  return shares;
}

/// Shares of the colours among the pixels that the camera sees; all zero when it sees none.
std::vector<float> colour_histogram_of(const camera::Panorama& panorama) {
  std::vector<std::size_t> counts(std::size_t{kColourLevels} * kColourLevels * kColourLevels, 0);
  std::size_t total = 0;
  const std::uint8_t* pixel = panorama.rgb.data.data();
  for (std::size_t i = 0; i < panorama.valid.size(); ++i, pixel += 3) {
    if (panorama.valid[i] == 0) continue;
    const auto level = [&](int band) { return static_cast<std::size_t>(pixel[band] * kColourLevels / 256); };
    ++counts[(level(0) * kColourLevels + level(1)) * kColourLevels + level(2)];
    ++total;
  }
  std::vector<float> shares(counts.size(), 0.0F);
  if (total == 0) return shares;
  std::ranges::transform(counts, shares.begin(), [&](std::size_t count) {
    return static_cast<float>(static_cast<double>(count) / static_cast<double>(total));
  });
  return shares;
}

/// Magnitudes of the lowest frequencies of each of `bands` bands of rows; pixels that the camera does not see count as
/// the band's mean, so that the shape of what it sees is no texture.
std::vector<float> fourier_of(const cv::Mat& grey, const std::vector<std::uint8_t>& valid, int bands) {
  const cv::Mat mask(grey.rows, grey.cols, CV_8UC1, const_cast<std::uint8_t*>(valid.data()));
  std::vector<float> magnitudes;
  magnitudes.reserve(static_cast<std::size_t>(bands) * kFrequencies);
  for (int band = 0; band < bands; ++band) {
    const int top = band * grey.rows / bands;
    const int bottom = std::max(top + 1, (band + 1) * grey.rows / bands);
    const cv::Mat seen = mask.rowRange(top, bottom);
    cv::Mat filled = grey.rowRange(top, bottom).clone();
    const double mean = cv::countNonZero(seen) > 0 ? cv::mean(filled, seen)[0] : 0.0;
    filled.setTo(cv::Scalar(mean), seen == 0);
    cv::Mat profile;
    cv::reduce(filled, profile, 0, cv::REDUCE_AVG, CV_32F);
    cv::Mat spectrum;
    cv::dft(profile, spectrum, cv::DFT_COMPLEX_OUTPUT | cv::DFT_ROWS);
    const auto* frequency = spectrum.ptr<cv::Vec2f>(0);
    for (int k = 0; k < kFrequencies; ++k) {
      const float magnitude = k < spectrum.cols ? std::hypot(frequency[k][0], frequency[k][1]) : 0.0F;
      magnitudes.push_back(magnitude / (255.0F * static_cast<float>(grey.cols)));
    }
  }
  return magnitudes;
}

/// What is wrong with a picture whose grey levels say nothing, or null.
const char* why_nothing_is_shown(const std::array<float, 256>& shares) {
  constexpr int kDark = 5;
  constexpr int kBright = 250;
  constexpr double kNearlyAll = 0.95;
  constexpr double kEnds = 0.005;     // left out at either end: a few hot pixels are no picture
  constexpr int kLevelsOfNoise = 16;  // what a sensor's noise spreads one brightness over
  double below = 0.0;
  double dark = 0.0;
  double bright = 0.0;
  int first = -1;
  int last = -1;
  for (int level = 0; level < 256; ++level) {
    const double share = static_cast<double>(shares[static_cast<std::size_t>(level)]);
    if (level <= kDark) dark += share;
    if (level >= kBright) bright += share;
    below += share;
    if (first < 0 && below > kEnds) first = level;
    if (last < 0 && below >= 1.0 - kEnds) last = level;
  }
  if (first < 0) return "The camera sees no part of this panorama.";
  if (bright > kNearlyAll) return "The picture is over-exposed; there is nothing to compare.";
  if (dark > kNearlyAll) return "The picture is black; there is nothing to compare.";
  if (last - first < kLevelsOfNoise) return "The picture is all of one brightness; there is nothing to compare.";
  return nullptr;
}

}  // namespace

std::string_view global_measure_name(GlobalMeasure measure) {
  switch (measure) {
    case GlobalMeasure::kMoments:
      return "moments";
    case GlobalMeasure::kJeffrey:
      return "jeffrey";
    case GlobalMeasure::kChiSquare:
      return "chi2";
    case GlobalMeasure::kAbsoluteDifference:
      return "sad";
    case GlobalMeasure::kFourier:
      return "fourier";
    case GlobalMeasure::kInvariants:
      return "invariants";
    case GlobalMeasure::kColourJeffrey:
      return "rgb_jeffrey";
    case GlobalMeasure::kRowFourier:
      return "row_fourier";
  }
  return "";
}

Result<GlobalDescriptor> describe(const camera::Panorama& panorama) {
  const Image& rgb = panorama.rgb;
  if (rgb.empty()) return fail(ErrorCode::kEmptyInput, "The panorama has no pixels.", "picture");
  const auto pixels = static_cast<std::size_t>(rgb.width_px) * static_cast<std::size_t>(rgb.height_px);
  if (rgb.channels != 3 || rgb.data.size() != 3 * pixels || panorama.valid.size() != pixels) {
    return fail(ErrorCode::kInvalidInput, "The panorama's pixels do not fit its size.", "picture");
  }
  constexpr int kLeast_px = 16;
  if (rgb.width_px < kLeast_px || rgb.height_px < kLeast_px) {
    return fail(ErrorCode::kTooFewFeatures, "The panorama is too small to be compared.", "picture");
  }
  const cv::Mat grey = grey_of(panorama);
  GlobalDescriptor descriptor;
  descriptor.grey_histogram = grey_histogram_of(grey, panorama.valid);
  if (const char* reason = why_nothing_is_shown(descriptor.grey_histogram)) {
    return fail(ErrorCode::kTooFewFeatures, reason, "picture");
  }
  descriptor.moments = colour_moments(panorama);
  descriptor.fourier = fourier_of(grey, panorama.valid, kRowBands);
  descriptor.invariants = colour_correlations(panorama);
  descriptor.colour_histogram = colour_histogram_of(panorama);
  descriptor.row_fourier = fourier_of(grey, panorama.valid, grey.rows);
  return descriptor;
}

double dissimilarity(GlobalMeasure measure, const GlobalDescriptor& a, const GlobalDescriptor& b) {
  switch (measure) {
    case GlobalMeasure::kMoments:
      return colour_moment_distance(a.moments, b.moments);
    case GlobalMeasure::kJeffrey:
      return jeffrey_divergence(a.grey_histogram, b.grey_histogram);
    case GlobalMeasure::kChiSquare:
      return chi_square(a.grey_histogram, b.grey_histogram);
    case GlobalMeasure::kAbsoluteDifference:
      return sum_of_absolute_differences(a.grey_histogram, b.grey_histogram);
    case GlobalMeasure::kFourier:
      return sum_of_absolute_differences(a.fourier, b.fourier);
    case GlobalMeasure::kInvariants:
      return std::hypot(a.invariants[0] - b.invariants[0], a.invariants[1] - b.invariants[1],
                        a.invariants[2] - b.invariants[2]);
    case GlobalMeasure::kColourJeffrey:
      return jeffrey_divergence(a.colour_histogram, b.colour_histogram);
    case GlobalMeasure::kRowFourier:
      return sum_of_absolute_differences(a.row_fourier, b.row_fourier);
  }
  return 0.0;
}

double jeffrey_divergence(std::span<const float> a, std::span<const float> b) {
  const auto term = [](double share, double mean) { return share > 0.0 ? share * std::log10(share / mean) : 0.0; };
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double mean = 0.5 * (static_cast<double>(a[k]) + static_cast<double>(b[k]));
    sum += term(static_cast<double>(a[k]), mean) + term(static_cast<double>(b[k]), mean);
  }
  return std::max(0.0, sum);
}

double chi_square(std::span<const float> a, std::span<const float> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double mean = 0.5 * (static_cast<double>(a[k]) + static_cast<double>(b[k]));
    const double off = static_cast<double>(a[k]) - mean;
    if (mean > 0.0) sum += off * off / mean;
  }
  return sum;
}

double sum_of_absolute_differences(std::span<const float> a, std::span<const float> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k]));
  return sum;
}

}  // namespace homeward::features
