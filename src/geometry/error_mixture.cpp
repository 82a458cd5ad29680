// SPDX-License-Identifier: Apache-2.0
#include "geometry/error_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.hpp"

namespace homeward::geometry {

namespace {

constexpr double kSpreadOfMedian = 1.4826;  // standard deviation of normal errors over the median of their sizes

/// How errors spread: densities of right and wrong ones, and how many coordinates an error has.
struct Line {
  static constexpr double kCoordinates = 1.0;
  static double right_peak(double spread_px) { return std::sqrt(2.0 / M_PI) / spread_px; }  // of sizes: both signs
  static double wrong(double reach_px) { return 1.0 / reach_px; }
};
struct Plane {
  static constexpr double kCoordinates = 2.0;
  static double right_peak(double spread_px) { return 1.0 / (2.0 * M_PI * spread_px * spread_px); }
  static double wrong(double reach_px) { return 1.0 / (4.0 * reach_px * reach_px); }
};

template <typename Space>
ErrorMixture mixture_in(std::span<const double> sizes_px, double least_spread_px, double reach_px) {
  constexpr int kMixtureSteps = 12;
  constexpr double kLeastShare = 0.05;
  const auto count = static_cast<double>(sizes_px.size());
  const double middle = median(std::vector<double>(sizes_px.begin(), sizes_px.end()));
  ErrorMixture mixture;
  mixture.spread_px = std::clamp(kSpreadOfMedian * middle, least_spread_px, 0.5 * reach_px);
  mixture.right_share = 0.8;
  for (int step = 0; step < kMixtureSteps; ++step) {
    const double spread = mixture.spread_px;
    const double right_peak = mixture.right_share * Space::right_peak(spread);
    const double wrong = (1.0 - mixture.right_share) * Space::wrong(reach_px);
    double sum = 0.0;
    double squares = 0.0;
    mixture.log_likelihood = 0.0;
    for (const double size : sizes_px) {
      const double right = right_peak * std::exp(-0.5 * size * size / (spread * spread));
      mixture.log_likelihood += std::log(right + wrong);
      const double share = right / (right + wrong);
      if (share > 0.0) {
        sum += share;
        squares += share * size * size;
      }
    }
    mixture.right_share = std::clamp(sum / count, kLeastShare, 1.0 - kLeastShare);
    mixture.spread_px =
        std::clamp(std::sqrt(squares / std::max(Space::kCoordinates * sum, 1e-9)), least_spread_px, 0.5 * reach_px);
  }
  return mixture;
}

}  // namespace

ErrorMixture error_mixture(std::span<const double> sizes_px, double least_spread_px, double reach_px) {
  return mixture_in<Line>(sizes_px, least_spread_px, reach_px);
}

ErrorMixture error_mixture_on_plane(std::span<const double> distances_px, double least_spread_px, double reach_px) {
  return mixture_in<Plane>(distances_px, least_spread_px, reach_px);
}

double log_likelihood_on_plane(const ErrorMixture& across_lines, std::size_t count, double reach_px) {
  // Sizes have both signs: half the density each.
  return across_lines.log_likelihood - static_cast<double>(count) * std::log(4.0 * reach_px);
}

}  // namespace homeward::geometry
