// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "features/appearance.hpp"
#include "geometry/relative_pose.hpp"
#include "matching/verify.hpp"

namespace homeward::matching {

/// How different two pictures are.
struct PairComparison {
  int matches = 0;                                            // that look alike
  int verified = 0;                                           // that one planar motion explains
  double distance = std::numeric_limits<double>::infinity();  // visual distance D; infinite below 8 verified matches
  std::optional<geometry::RelativePose> pose;                 // of b seen from a
};

/// The visual distance D = (1/N) ((n_a + n_b) / 2) (sum |da_i| / N) over N verified matches, da_i being their azimuth
/// differences after the best common turn (circular median), radians. Goedemé 2007 eq. 3, Goedemé 2006 eq. 4.
/// Nearly symmetric; deterministic by `seed`.
PairComparison compare(const features::Appearance& a, const features::Appearance& b, const VerifyConfig& config,
                       std::uint64_t seed);

}  // namespace homeward::matching
