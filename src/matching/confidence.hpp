// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "geometry/correspondence.hpp"
#include "geometry/planar_estimate.hpp"
#include "matching/match.hpp"

namespace homeward::matching {

/// What an estimate and the matches that it was made from tell of whether it is right.
struct ConfidenceSigns {
  double lead = 0.0;                 // logarithm of how much likelier the motion is than its best rival
  double around = 0.0;               // share of the circle in which matches agree, of 0 to 1, over both views
  double disagreeing = 0.0;          // SIFT matches far off the motion: each counts the more the less else is like it
  double median_parallax_rad = 0.0;  // of those that agree
  // Of the SIFT matches that agree, those whose feature no place of the map far from the target's has; nothing where
  // the target does not know its map.
  std::optional<double> distinct_share = std::nullopt;
};

/// Two views of one room agree all around, and clear matches that disagree are few; two rooms that look alike share
/// some things, which agree, and others that stand elsewhere, which match as clearly and disagree. `correspondences`
/// are those of `matches`, in their order. Turning one of the views changes nothing. `target`, SIFT features of the
/// picture that the matches lead to, says what is common in its map; without it nothing does.
/// Ours, because in buildings that look alike the number of matches tells next to nothing.
ConfidenceSigns signs_of(const geometry::PlanarEstimate& estimate, std::span<const Match> matches,
                         std::span<const geometry::Correspondence> correspondences,
                         const features::FeatureSet* target = nullptr);

/// The probability that the two views are of one place and the direction is right within 15 degrees. Logistic
/// regression on pairs of rendered and real pictures, rooms that look alike among them, by
/// tests/bench/quality/confidence.py; docs/experiments/confidence.md has how. Where the map of the target is known it
/// is that much less likely as what agrees is found elsewhere too: which never makes it more likely.
double confidence(const ConfidenceSigns& signs);

}  // namespace homeward::matching
