// SPDX-License-Identifier: Apache-2.0
#include "matching/confidence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angles.hpp"
#include "geometry/planar_solver.hpp"
#include "matching/distinctiveness.hpp"

namespace homeward::matching {
namespace {

/// How many sectors of a sixteenth of the circle would hold as many pairs of neighbours if all were equally full
/// (Simpson's index of diversity, without fixed sectors), as a share of sixteen.
double share_of_circle(std::vector<double> azimuths_rad) {
  constexpr double kSectors = 16.0;
  constexpr double kNeighbour_rad = kPi / kSectors;  // half a sector to each side
  if (azimuths_rad.empty()) return 0.0;
  std::ranges::sort(azimuths_rad);
  const std::size_t count = azimuths_rad.size();
  double neighbours = static_cast<double>(count);  // each is its own
  for (std::size_t i = 0, end = 1; i < count; ++i) {
    // All after i and within reach of it, round the seam at most once.
    end = std::max(end, i + 1);
    const auto at = [&](std::size_t k) { return azimuths_rad[k % count] + (k >= count ? 2.0 * kPi : 0.0); };
    while (end < i + count && at(end) - azimuths_rad[i] <= kNeighbour_rad) ++end;
    neighbours += 2.0 * static_cast<double>(end - i - 1);
  }
  const auto all = static_cast<double>(count);
  return std::min(1.0, all * all / neighbours / kSectors);
}

}  // namespace

ConfidenceSigns signs_of(const geometry::PlanarEstimate& estimate, std::span<const Match> matches,
                         std::span<const geometry::Correspondence> correspondences,
                         const features::FeatureSet* target) {
  ConfidenceSigns signs;
  signs.lead = estimate.lead;
  signs.median_parallax_rad = estimate.median_parallax_rad;
  std::vector<double> here_rad;
  std::vector<double> there_rad;
  for (const int inlier : estimate.inliers) {
    const geometry::Correspondence& c = correspondences[static_cast<std::size_t>(inlier)];
    here_rad.push_back(std::atan2(c.current.y(), c.current.x()));
    there_rad.push_back(std::atan2(c.target.y(), c.target.x()));
  }
  signs.around = 0.5 * (share_of_circle(std::move(here_rad)) + share_of_circle(std::move(there_rad)));
  constexpr double kFar_rad = 0.03;      // small tilts and the shake of large features stay below
  constexpr double kAmbiguous = 0.9;     // ratio to the second best that counts nothing
  constexpr double kUnmistakable = 0.5;  // and one that counts in full
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].kind != FeatureKind::kSift) continue;
    if (geometry::epipolar_error_rad(estimate.motion, correspondences[i]) <= kFar_rad) continue;
    signs.disagreeing +=
        std::clamp((kAmbiguous - static_cast<double>(matches[i].ratio)) / (kAmbiguous - kUnmistakable), 0.0, 1.0);
  }
  if (target != nullptr) signs.distinct_share = distinct_share(estimate.inliers, matches, *target);
  return signs;
}

double confidence(const ConfidenceSigns& signs) {
  // No two pictures are without a few wrong matches: where hardly anything matches their want proves nothing.
  constexpr double kFewestDisagreeing = 5.0;
  const double disagreeing = std::log1p(std::max(kFewestDisagreeing, signs.disagreeing));
  const double parallax = std::log(std::clamp(degrees(signs.median_parallax_rad), 0.5, 10.0) / 10.0);
  const double log_odds = 5.69 + 0.23 * std::log(std::max(1.0, signs.lead)) + 9.86 * signs.around - 3.27 * disagreeing +
                          1.86 * parallax * signs.around;
  const double in_two_views = 1.0 / (1.0 + std::exp(-log_odds));
  return signs.distinct_share ? in_two_views * not_elsewhere(*signs.distinct_share) : in_two_views;
}

}  // namespace homeward::matching
