// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "geometry/general_motion.hpp"
#include "geometry/planar_motion.hpp"
#include "geometry/relative_pose.hpp"
#include "matching/match.hpp"
#include "matching/match_columns.hpp"

namespace homeward::matching {

struct VerifyConfig {
  MatchConfig match;
  ColumnMatchConfig columns;
  geometry::PlanarRansacConfig ransac;
  int min_inliers = 8;
  double min_evidence = 3.0;    // natural logarithm over chance: one motion in twenty of pairs at random would pass
  bool general_motion = false;  // look for a general motion where the planar one is weak; some ten times as slow
};

/// Matches that one planar motion explains, and that motion.
struct VerifiedMatch {
  std::vector<Match> matches;   // all that looked alike, of both kinds of features
  geometry::RelativePose pose;  // of the target seen from the current view; inliers index `matches`
};

/// What looks alike in two appearances: SIFT features, then columns.
std::vector<Match> match_both_kinds(const features::Appearance& current, const features::Appearance& target,
                                    const MatchConfig& sift, const ColumnMatchConfig& columns);

/// The bearings of matches and, of SIFT features, how their sizes change.
std::vector<geometry::Correspondence> correspondences(const features::Appearance& current,
                                                      const features::Appearance& target,
                                                      std::span<const Match> matches);

/// Matches two appearances and verifies them by planar epipolar geometry. Deterministic by `seed`.
/// Errors: kTooFewFeatures, kTooLittleSupport.
/// Goedemé 2007 counts matches as they are (§4.2.2) and fits geometry for homing alone (§7.1.1); to verify before
/// counting is ours.
Result<VerifiedMatch> verify(const features::Appearance& current, const features::Appearance& target,
                             const VerifyConfig& config, std::uint64_t seed);

}  // namespace homeward::matching
