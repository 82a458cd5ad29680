// SPDX-License-Identifier: Apache-2.0
#include "matching/verify.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::matching {
namespace {

/// The probability that the direction is right within 15 degrees, from what the estimate knows about itself.
/// Logistic regression on pairs of rendered and real pictures with known directions; docs/benchmarks.md has the fit.
double confidence(const geometry::PlanarEstimate& estimate, std::size_t matches) {
  const auto inliers = static_cast<double>(estimate.inliers.size());
  const double share = inliers / static_cast<double>(std::max<std::size_t>(1, matches));
  const double log_odds = -6.0 + 1.6 * std::log(inliers) + 3.0 * share + 3.0 * (estimate.forward_share - 0.75) -
                          8.0 * std::min(estimate.direction_spread_rad, 0.6);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace

Result<VerifiedMatch> verify(const features::Appearance& current, const features::Appearance& target,
                             const VerifyConfig& config, std::uint64_t seed) {
  if (current.size() < config.min_inliers || target.size() < config.min_inliers) {
    return fail(ErrorCode::kTooFewFeatures, "A picture has " + std::to_string(std::min(current.size(), target.size())) +
                                                " features; at least " + std::to_string(config.min_inliers) +
                                                " are needed.");
  }
  VerifiedMatch verified;
  verified.matches = match(current.sift, target.sift, config.match);
  std::vector<geometry::Correspondence> correspondences;
  correspondences.reserve(verified.matches.size());
  for (const Match& pair : verified.matches) {
    correspondences.push_back({current.sift.bearings.row(pair.current).transpose().cast<double>().normalized(),
                               target.sift.bearings.row(pair.target).transpose().cast<double>().normalized()});
  }
  const auto estimate = geometry::estimate_planar_motion(correspondences, config.ransac, seed);
  if (!estimate) return pass_on(estimate);
  if (static_cast<int>(estimate->inliers.size()) < config.min_inliers) {
    return fail(ErrorCode::kTooLittleSupport,
                std::to_string(estimate->inliers.size()) + " of " + std::to_string(verified.matches.size()) +
                    " matches agree on a motion; at least " + std::to_string(config.min_inliers) + " are needed.");
  }
  verified.pose.motion = estimate->motion;
  verified.pose.inliers = estimate->inliers;
  verified.pose.correspondences = static_cast<int>(verified.matches.size());
  verified.pose.confidence = confidence(*estimate, verified.matches.size());
  verified.pose.median_parallax_rad = estimate->median_parallax_rad;
  return verified;
}

}  // namespace homeward::matching
