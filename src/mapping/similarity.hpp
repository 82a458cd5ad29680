// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace homeward::mapping {

/// Empirical distribution of the visual distance D between images of one place: tells how usual a distance is. It takes
/// the part of the spread that the papers divide by (2006 eq. 6), which is 0 for places of one image and saturates.
/// Ours in place of that.
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

/// How much more a visual distance D speaks for one place than for the place next to it, learnt on the tour itself: the
/// share of pairs of one place that are at least as different, against the share of pairs a little further apart that
/// are at least as alike. The papers divide D by its spread within a place (2006 eq. 6). That, like the share of the
/// places' own distances alone, gives half of the true pairs less than 0.5 and so speaks against them.
/// Ours: docs/experiments/sources_of_evidence.md.
class SamePlaceScale {
 public:
  /// D of image pairs that certainly show one place, and of pairs that certainly lie next to each other but do not.
  SamePlaceScale(std::vector<float> same, std::vector<float> beside)
      : same_(std::move(same)), beside_(std::move(beside)) {}

  /// s_V in [0,1]: 1 for 0, 0.5 where both are as likely, 0 for the largest. Without pairs beside: the share of the
  /// places' own distances that are at least as large.
  [[nodiscard]] double similarity(float distance) const;

 private:
  UsualDistances same_;
  UsualDistances beside_;
};

}  // namespace homeward::mapping
