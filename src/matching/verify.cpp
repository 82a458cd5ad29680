// SPDX-License-Identifier: Apache-2.0
#include "matching/verify.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::matching {
namespace {

/// Of two sizes; 0, which says nothing, where one of them is not known.
double log_ratio(float over, float under) {
  return over > 0.0F && under > 0.0F ? std::log(static_cast<double>(over) / static_cast<double>(under)) : 0.0;
}

}  // namespace

std::vector<geometry::Correspondence> correspondences(const features::Appearance& current,
                                                      const features::Appearance& target,
                                                      std::span<const Match> matches) {
  std::vector<geometry::Correspondence> pairs;
  pairs.reserve(matches.size());
  for (const Match& match : matches) {
    pairs.push_back({current.sift.bearings.row(match.current).transpose().cast<double>().normalized(),
                     target.sift.bearings.row(match.target).transpose().cast<double>().normalized(),
                     log_ratio(target.sift.scales_rad[match.target], current.sift.scales_rad[match.current])});
  }
  return pairs;
}

// Logistic regression on pairs of rendered and real pictures with known directions; docs/benchmarks.md has the fit.
double confidence(const geometry::PlanarEstimate& estimate, std::size_t matches) {
  const auto inliers = static_cast<double>(estimate.inliers.size());
  const double share = inliers / static_cast<double>(std::max<std::size_t>(1, matches));
  const double log_odds = -6.0 + 1.6 * std::log(inliers) + 3.0 * share + 3.0 * (estimate.forward_share - 0.75) -
                          8.0 * std::min(estimate.direction_spread_rad, 0.6);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

Result<VerifiedMatch> verify(const features::Appearance& current, const features::Appearance& target,
                             const VerifyConfig& config, std::uint64_t seed) {
  if (current.size() < config.min_inliers || target.size() < config.min_inliers) {
    return fail(ErrorCode::kTooFewFeatures, "A picture has " + std::to_string(std::min(current.size(), target.size())) +
                                                " features; at least " + std::to_string(config.min_inliers) +
                                                " are needed.");
  }
  VerifiedMatch verified;
  verified.matches = match(current.sift, target.sift, config.match);
  const std::vector<geometry::Correspondence> pairs = correspondences(current, target, verified.matches);
  const auto estimate = config.general_motion ? geometry::estimate_motion(pairs, {.planar = config.ransac}, seed)
                                              : geometry::estimate_planar_motion(pairs, config.ransac, seed);
  if (!estimate) return pass_on(estimate);
  if (static_cast<int>(estimate->inliers.size()) < config.min_inliers) {
    return fail(ErrorCode::kTooLittleSupport,
                std::to_string(estimate->inliers.size()) + " of " + std::to_string(verified.matches.size()) +
                    " matches agree on a motion; at least " + std::to_string(config.min_inliers) + " are needed.");
  }
  if (estimate->evidence < config.min_evidence) {
    return fail(ErrorCode::kTooLittleSupport, "The motion that most matches agree on may be one by chance.");
  }
  verified.pose.motion = estimate->motion;
  verified.pose.inliers = estimate->inliers;
  verified.pose.correspondences = static_cast<int>(verified.matches.size());
  verified.pose.confidence = confidence(*estimate, verified.matches.size());
  verified.pose.median_parallax_rad = estimate->median_parallax_rad;
  return verified;
}

}  // namespace homeward::matching
