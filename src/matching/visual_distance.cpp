// SPDX-License-Identifier: Apache-2.0
#include "matching/visual_distance.hpp"

#include <cmath>
#include <vector>

#include "core/angles.hpp"

namespace homeward::matching {

PairComparison compare(const features::Appearance& a, const features::Appearance& b, const VerifyConfig& config,
                       std::uint64_t seed) {
  PairComparison comparison;
  auto verified = verify(a, b, config, seed);
  if (!verified) return comparison;
  comparison.matches = static_cast<int>(verified->matches.size());
  comparison.verified = static_cast<int>(verified->pose.inliers.size());
  constexpr int kFewestVerified = 8;  // one match alone would give D = 0
  if (comparison.verified >= kFewestVerified) {
    std::vector<double> differences_rad;
    for (const int inlier : verified->pose.inliers) {
      const Match& pair = verified->matches[static_cast<std::size_t>(inlier)];
      const bool column = pair.kind == FeatureKind::kColumn;
      differences_rad.push_back(wrap_angle(azimuth_rad(column ? b.columns : b.sift, pair.target) -
                                           azimuth_rad(column ? a.columns : a.sift, pair.current)));
    }
    const double turn_rad = circular_median(differences_rad);
    double sum_rad = 0.0;
    for (const double difference_rad : differences_rad) sum_rad += std::abs(wrap_angle(difference_rad - turn_rad));
    const double n = comparison.verified;
    comparison.distance = (1.0 / n) * ((a.size() + b.size()) / 2.0) * (sum_rad / n);
  }
  comparison.pose = std::move(verified->pose);
  return comparison;
}

}  // namespace homeward::matching
