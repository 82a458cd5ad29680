// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace homeward::mapping {

/// Empirical distribution of the visual distance D between images of one place: tells how usual a distance is. It takes
/// the part of the spread that the papers divide by (2006 eq. 6), which is 0 for places of one image and saturates.
class UsualDistances {
 public:
  /// Distances that are infinite are left out.
  explicit UsualDistances(std::vector<float> distances);

  /// Share of the places' own distances that are at least this large: 1 for 0, 0 beyond the largest. 0 when nothing is
  /// known.
  [[nodiscard]] double share_at_least(float distance) const;

  /// The distance below which a share `q` in [0,1] lies; 0 when nothing is known.
  [[nodiscard]] float quantile(double q) const;

  [[nodiscard]] bool empty() const { return sorted_.empty(); }

 private:
  std::vector<float> sorted_;
};

}  // namespace homeward::mapping
