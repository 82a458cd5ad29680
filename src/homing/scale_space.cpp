// SPDX-License-Identifier: Apache-2.0
#include "homing/scale_space.hpp"

#include <Eigen/Core>
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

/// The sum of one group's directions: s and c of its mean direction, times how many there are.
Eigen::Vector2d group_sum(std::span<const ScaleChange> changes, bool contracted) {
  Eigen::Vector2d sum(0.0, 0.0);
  int count = 0;
  for (const ScaleChange& change : changes) {
    if (change.contracted != contracted) continue;
    sum += Eigen::Vector2d(std::sin(change.bearing_rad), std::cos(change.bearing_rad));
    ++count;
  }
  // Directions all round have no mean.
  constexpr double kNone = 1e-9;
  return sum.norm() > kNone * count ? Eigen::Vector2d(count * sum.normalized()) : Eigen::Vector2d(0.0, 0.0);
}

}  // namespace

ScaleSpaceDirection scale_space_direction(std::span<const ScaleChange> changes, ScaleSpaceSum sum) {
  double sine = 0.0;
  double cosine = 0.0;
  for (const ScaleChange& change : changes) {
    // Contracted (smaller here): towards it; expanded: away from it.
    const double sign = change.contracted ? 1.0 : -1.0;
    sine += sign * std::sin(change.bearing_rad);
    cosine += sign * std::cos(change.bearing_rad);
  }
  ScaleSpaceDirection direction;
  direction.agreement = std::hypot(sine, cosine) / static_cast<double>(changes.size());
  direction.bearing_rad = std::atan2(sine, cosine);
  if (sum == ScaleSpaceSum::kGroupSizes) {
    // sin(theta + pi) = -sin(theta), and so for cosines.
    const Eigen::Vector2d both = group_sum(changes, true) - group_sum(changes, false);
    direction.bearing_rad = std::atan2(both.x(), both.y());
  }
  return direction;
}

Result<HomeVector> scale_space_vector(const features::Appearance& current, const features::Appearance& target,
                                      const ScaleSpaceConfig& config) {
  if (current.sift.size() < config.fewest_matches || target.sift.size() < config.fewest_matches) {
    return fail(ErrorCode::kTooFewFeatures,
                "A picture has " + std::to_string(std::min(current.sift.size(), target.sift.size())) +
                    " features; at least " + std::to_string(config.fewest_matches) + " are needed.");
  }
  const std::vector<matching::Match> matches = matching::match(current.sift, target.sift, {});
  std::vector<ScaleChange> changes;
  std::vector<double> turns_rad;
  for (const matching::Match& match : matches) {
    const double here_rad = azimuth_rad(current.sift, match.current);
    turns_rad.push_back(wrap_angle(here_rad - azimuth_rad(target.sift, match.target)));
    const double change = std::log(static_cast<double>(target.sift.scales_rad[match.target]) /
                                   static_cast<double>(current.sift.scales_rad[match.current]));
    if (!std::isfinite(change) || std::abs(change) < config.least_change) continue;
    changes.push_back({here_rad, change > 0.0});
  }
  const auto changed = static_cast<int>(changes.size());
  if (changed < config.fewest_matches) {
    return fail(ErrorCode::kTooLittleSupport, std::to_string(changed) + " matches change their size; at least " +
                                                  std::to_string(config.fewest_matches) + " are needed.");
  }
  HomeVector vector;
  const ScaleSpaceDirection direction = scale_space_direction(changes, config.sum);
  vector.bearing_rad = direction.bearing_rad;
  vector.turn_rad = circular_median(turns_rad);
  std::vector<double> parallax_rad;
  parallax_rad.reserve(turns_rad.size());
  for (const double turn : turns_rad) parallax_rad.push_back(std::abs(wrap_angle(turn - vector.turn_rad)));
  vector.median_parallax_rad = median(std::move(parallax_rad));
  vector.matches = static_cast<int>(matches.size());
  vector.inliers = changed;
  vector.confidence = probability(direction.agreement);
  return vector;
}

}  // namespace homeward::homing
