// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "features/appearance.hpp"
#include "matching/match.hpp"

namespace homeward::matching {

/// What was seen of one place: one set for each of its appearances.
using SeenPlace = std::vector<const features::FeatureSet*>;

/// Squared distance of SIFT codes below which two features look alike: most matches of one thing seen twice are nearer,
/// most chance ones are not. Chosen with `not_elsewhere`; docs/experiments/common_features.md.
inline constexpr int kAlikeDistance2 = 4000;

/// How many of `places` have each feature's like, 255 for more: its document frequency, a picture being the document
/// (Spärck Jones 1972; Sivic & Zisserman 2003; here without words). A feature that none has is distinctive.
std::vector<std::uint8_t> document_frequency(const features::FeatureSet& set, std::span<const SeenPlace> places);

/// Of the SIFT matches among `inliers` (indices into `matches`), the share whose target feature is distinctive, as if
/// five more agreed that are not: few matches prove little. Nothing where `target` does not know how frequent its
/// features are.
std::optional<double> distinct_share(std::span<const int> inliers, std::span<const Match> matches,
                                     const features::FeatureSet& target);

/// The probability that a motion which is right as far as two views tell is not one onto a place that looks alike.
/// Things at places that look alike agree as well as one place's own do; what agrees is then found elsewhere. (Ours:
/// logistic in the share, on pairs of rendered buildings whose rooms look alike, so that hardly one of two hundred
/// pairs of different places is answered with more than 0.8.)
double not_elsewhere(double distinct_share);

}  // namespace homeward::matching
