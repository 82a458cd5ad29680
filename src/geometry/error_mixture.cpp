// SPDX-License-Identifier: Apache-2.0
#include "geometry/error_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/median.hpp"

namespace homeward::geometry {

ErrorMixture error_mixture(std::span<const double> sizes_px, double least_spread_px, double reach_px) {
  constexpr int kSteps = 12;
  constexpr double kLeastShare = 0.05;
  constexpr double kSpreadOfMedian = 1.4826;  // standard deviation of normal errors over the median of their sizes
  const auto count = static_cast<double>(sizes_px.size());
  const double middle = median(std::vector<double>(sizes_px.begin(), sizes_px.end()));
  ErrorMixture mixture;
  mixture.spread_px = std::clamp(kSpreadOfMedian * middle, least_spread_px, 0.5 * reach_px);
  mixture.right_share = 0.8;
  for (int step = 0; step < kSteps; ++step) {
    const double spread = mixture.spread_px;
    const double right_peak = mixture.right_share * std::sqrt(2.0 / M_PI) / spread;  // of sizes: both signs
    const double wrong = (1.0 - mixture.right_share) / reach_px;
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
    mixture.spread_px = std::clamp(std::sqrt(squares / std::max(sum, 1e-9)), least_spread_px, 0.5 * reach_px);
  }
  return mixture;
}

}  // namespace homeward::geometry
