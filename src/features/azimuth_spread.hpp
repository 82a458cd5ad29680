// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace homeward::features {

inline constexpr int kAzimuthSectors = 24;

/// One found feature: how strong, and in which of `kAzimuthSectors` it lies.
struct RankedFeature {
  double strength = 0.0;
  int sector = 0;
};

/// Which features to keep, at most `budget`: the strongest of each sector of azimuth in turn, so that no single poster
/// takes the whole budget. Indices, round by round; among equally strong ones the first.
/// Ours: geometry needs matches all around.
std::vector<int> spread_over_azimuth(std::span<const RankedFeature> found, int budget);

}  // namespace homeward::features
