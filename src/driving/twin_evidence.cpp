// SPDX-License-Identifier: Apache-2.0
#include "driving/twin_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace homeward::driving {
namespace {

/// Of the normal distribution.
double share_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace

void take(RecognitionRecord& record, const Recognition& seen, double news) {
  record.log_share += news * seen.log_share;
  record.variance += news * seen.variance;
  record.pictures += news;
}

double odds_to_best(const RecognitionRecord& record, const RecognitionRecord& best, const TwinEvidenceConfig& config,
                    int rivals) {
  constexpr double kLeast = 1e-9;
  const double pictures = std::min(record.pictures, best.pictures);
  if (pictures <= 0.0) return 1.0;
  // If the one that is recognised less were right, it should show as many features as the other.
  const double of_picture = std::min(record.variance / record.pictures, best.variance / best.pictures);
  const double counting = 2.0 * pictures * of_picture;
  const double variance = counting * (1.0 + config.lasting_variance * std::min(pictures, config.lasting_pictures));
  const double z = (record.log_share - best.log_share) / std::sqrt(variance);
  const double misled = config.outlier / rivals * std::exp(-pictures / config.outlier_pictures);
  const auto probability = [&](double below) { return std::max(kLeast, misled + (1.0 - 2.0 * misled) * below); };
  return probability(share_below(z)) / probability(share_below(-z));
}

}  // namespace homeward::driving
