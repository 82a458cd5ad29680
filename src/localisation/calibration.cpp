// SPDX-License-Identifier: Apache-2.0
#include "localisation/calibration.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::localisation {
namespace {

// Beliefs beyond are as good as certain: products of a few pictures reach any number of nines.
constexpr double kLeastShare = 1e-4;
constexpr double kOffsetSpread = 2.0;
constexpr double kSlopeSpread = 0.5;
constexpr double kLeastSlope = 0.05;
constexpr int kMostRounds = 50;

double log_odds(double share) {
  const double inside = std::clamp(share, kLeastShare, 1.0 - kLeastShare);
  return std::log(inside / (1.0 - inside));
}

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// Minus the logarithm of the posterior, up to a constant.
double cost(const map::BeliefCalibration& c, std::span<const CalibrationSample> samples,
            const map::BeliefCalibration& prior) {
  const double o = (c.offset - prior.offset) / kOffsetSpread;
  const double s = (c.slope - prior.slope) / kSlopeSpread;
  double sum = 0.5 * (o * o + s * s);
  for (const CalibrationSample& sample : samples) {
    const double x = c.offset + c.slope * log_odds(sample.near_share);
    sum += std::log1p(std::exp(sample.near ? -x : x));
  }
  return sum;
}

}  // namespace

double calibrated(const map::BeliefCalibration& calibration, double near_share) {
  return logistic(calibration.offset + calibration.slope * log_odds(near_share));
}

map::BeliefCalibration fit_calibration(std::span<const CalibrationSample> samples,
                                       const map::BeliefCalibration& prior) {
  map::BeliefCalibration best = prior;
  double best_cost = cost(best, samples, prior);
  for (int round = 0; round < kMostRounds; ++round) {
    // Newton's method; the cost is convex.
    double gradient_offset = (best.offset - prior.offset) / (kOffsetSpread * kOffsetSpread);
    double gradient_slope = (best.slope - prior.slope) / (kSlopeSpread * kSlopeSpread);
    double h00 = 1.0 / (kOffsetSpread * kOffsetSpread);
    double h01 = 0.0;
    double h11 = 1.0 / (kSlopeSpread * kSlopeSpread);
    for (const CalibrationSample& sample : samples) {
      const double x = log_odds(sample.near_share);
      const double p = logistic(best.offset + best.slope * x);
      const double error = p - (sample.near ? 1.0 : 0.0);
      gradient_offset += error;
      gradient_slope += error * x;
      const double weight = p * (1.0 - p);
      h00 += weight;
      h01 += weight * x;
      h11 += weight * x * x;
    }
    const double determinant = h00 * h11 - h01 * h01;
    const double step_offset = (h11 * gradient_offset - h01 * gradient_slope) / determinant;
    const double step_slope = (h00 * gradient_slope - h01 * gradient_offset) / determinant;
    double length = 1.0;
    bool better = false;
    for (int halving = 0; halving < 20 && !better; ++halving, length *= 0.5) {
      map::BeliefCalibration next = best;
      next.offset -= length * step_offset;
      next.slope = std::max(kLeastSlope, next.slope - length * step_slope);
      const double next_cost = cost(next, samples, prior);
      if (next_cost >= best_cost - 1e-12) continue;
      best = next;
      best_cost = next_cost;
      better = true;
    }
    if (!better) break;
  }
  return best;
}

}  // namespace homeward::localisation
