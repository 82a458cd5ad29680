// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace homeward::features {

constexpr int kColumnColours = 3;       // C_RG, C_RB, C_GB
constexpr int kColumnCoefficients = 7;  // of the cosine transform of the profile
constexpr int kColumnInvariants = kColumnColours + kColumnCoefficients;

/// Colour invariants, then profile coefficients; every one lies within -1 and 1.
using ColumnInvariants = std::array<float, kColumnInvariants>;

/// What one unit of the diagonal Mahalanobis distance is for each of them: the standard deviation of the difference
/// between the same segment in two pictures taken 0.4 to 1 m apart. Measured; docs/experiments/columns.md says how.
constexpr ColumnInvariants kColumnSpread = {0.08F, 0.10F, 0.03F, 0.15F, 0.21F, 0.14F, 0.13F, 0.09F, 0.08F, 0.07F};

/// A piece of one column of a panorama between two neighbouring maxima of the vertical gradient.
struct ColumnSegment {
  int u_px = 0;
  double top_px = 0.0;     // row of the upper end
  double bottom_px = 0.0;  // row of the lower end, > top
};

}  // namespace homeward::features
