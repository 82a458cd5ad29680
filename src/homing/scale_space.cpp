// SPDX-License-Identifier: Apache-2.0
#include "homing/scale_space.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/angles.hpp"
#include "core/median.hpp"
#include "matching/match.hpp"

namespace homeward::homing {
namespace {

/// How sure a direction is, by how much the features agree on it: rises with the length of their mean. Not calibrated.
double probability(double agreement) { return 1.0 / (1.0 + std::exp(-(6.0 * agreement - 3.6))); }

}  // namespace

Result<HomeVector> scale_space_vector(const features::Appearance& current, const features::Appearance& target,
                                      const ScaleSpaceConfig& config) {
  if (current.sift.size() < config.fewest_matches || target.sift.size() < config.fewest_matches) {
    return fail(ErrorCode::kTooFewFeatures,
                "A picture has " + std::to_string(std::min(current.sift.size(), target.sift.size())) +
                    " features; at least " + std::to_string(config.fewest_matches) + " are needed.");
  }
  const std::vector<matching::Match> matches = matching::match(current.sift, target.sift, {});
  double sine = 0.0;
  double cosine = 0.0;
  int changed = 0;
  std::vector<double> turns_rad;
  for (const matching::Match& match : matches) {
    const double here_rad = azimuth_rad(current.sift, match.current);
    turns_rad.push_back(wrap_angle(here_rad - azimuth_rad(target.sift, match.target)));
    const double change = std::log(static_cast<double>(target.sift.scales_rad[match.target]) /
                                   static_cast<double>(current.sift.scales_rad[match.current]));
    if (!std::isfinite(change) || std::abs(change) < config.least_change) continue;
    // Contracted (smaller here): towards it; expanded: away from it.
    const double sign = change > 0.0 ? 1.0 : -1.0;
    sine += sign * std::sin(here_rad);
    cosine += sign * std::cos(here_rad);
    ++changed;
  }
  if (changed < config.fewest_matches) {
    return fail(ErrorCode::kTooLittleSupport, std::to_string(changed) + " matches change their size; at least " +
                                                  std::to_string(config.fewest_matches) + " are needed.");
  }
  HomeVector vector;
  vector.bearing_rad = std::atan2(sine, cosine);
  vector.turn_rad = circular_median(turns_rad);
  std::vector<double> parallax_rad;
  parallax_rad.reserve(turns_rad.size());
  for (const double turn : turns_rad) parallax_rad.push_back(std::abs(wrap_angle(turn - vector.turn_rad)));
  vector.median_parallax_rad = median(std::move(parallax_rad));
  vector.matches = static_cast<int>(matches.size());
  vector.inliers = changed;
  vector.confidence = probability(std::hypot(sine, cosine) / changed);
  return vector;
}

}  // namespace homeward::homing
