// SPDX-License-Identifier: Apache-2.0
#include "matching/verify.hpp"

#include <algorithm>
#include <cmath>

#include "matching/confidence.hpp"
#include "matching/match_odds.hpp"

namespace homeward::matching {
namespace {

/// Of two sizes; 0, which says nothing, where one of them is not known.
double log_ratio(float over, float under) {
  return over > 0.0F && under > 0.0F ? std::log(static_cast<double>(over) / static_cast<double>(under)) : 0.0;
}

}  // namespace

std::vector<Match> match_both_kinds(const features::Appearance& current, const features::Appearance& target,
                                    const MatchConfig& sift, const ColumnMatchConfig& columns) {
  std::vector<Match> matches = match(current.sift, target.sift, sift);
  const std::vector<Match> of_columns = match_columns(current.columns, target.columns, columns);
  matches.insert(matches.end(), of_columns.begin(), of_columns.end());
  return matches;
}

std::vector<geometry::Correspondence> correspondences(const features::Appearance& current,
                                                      const features::Appearance& target,
                                                      std::span<const Match> matches) {
  std::vector<geometry::Correspondence> pairs;
  pairs.reserve(matches.size());
  for (const Match& match : matches) {
    if (match.kind == FeatureKind::kColumn) {
      const ColumnBearings ends = bearings_of(current.columns, target.columns, match);
      pairs.push_back({ends.current, ends.target, 0.0, odds_of(match)});
      continue;
    }
    pairs.push_back({current.sift.bearings.row(match.current).transpose().cast<double>().normalized(),
                     target.sift.bearings.row(match.target).transpose().cast<double>().normalized(),
                     log_ratio(target.sift.scales_rad[match.target], current.sift.scales_rad[match.current]),
                     odds_of(match)});
  }
  return pairs;
}

Result<VerifiedMatch> verify(const features::Appearance& current, const features::Appearance& target,
                             const VerifyConfig& config, std::uint64_t seed) {
  if (current.size() < config.min_inliers || target.size() < config.min_inliers) {
    return fail(ErrorCode::kTooFewFeatures, "A picture has " + std::to_string(std::min(current.size(), target.size())) +
                                                " features; at least " + std::to_string(config.min_inliers) +
                                                " are needed.");
  }
  VerifiedMatch verified;
  verified.matches = match_both_kinds(current, target, config.match, config.columns);
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
  verified.pose.confidence = confidence(signs_of(*estimate, verified.matches, pairs, &target.sift));
  verified.pose.median_parallax_rad = estimate->median_parallax_rad;
  return verified;
}

}  // namespace homeward::matching
