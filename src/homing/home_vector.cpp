// SPDX-License-Identifier: Apache-2.0
#include "homing/home_vector.hpp"

#include <algorithm>
#include <limits>

namespace homeward::homing {

HomeVector vector_of(const matching::VerifiedMatch& verified) {
  HomeVector vector;
  vector.bearing_rad = verified.pose.motion.direction_rad;
  vector.turn_rad = verified.pose.motion.turn_rad;
  vector.median_parallax_rad = verified.pose.median_parallax_rad;
  vector.matches = static_cast<int>(verified.matches.size());
  vector.inliers = static_cast<int>(verified.pose.inliers.size());
  vector.confidence = verified.pose.confidence;
  return vector;
}

namespace {

Result<HomeVector> verified_vector(const features::Appearance& current, const features::Appearance& target,
                                   const matching::VerifyConfig& config, std::uint64_t seed) {
  const auto verified = matching::verify(current, target, config, seed);
  if (!verified) return pass_on(verified);
  return vector_of(*verified);
}

}  // namespace

Result<HomeVector> home_vector(const features::Appearance& current, const features::Appearance& target,
                               const HomingConfig& config, std::uint64_t seed) {
  matching::VerifyConfig verify_config;
  verify_config.min_inliers = config.min_inliers;
  return verified_vector(current, target, verify_config, seed);
}

Result<HomeVector> uncertain_home_vector(const features::Appearance& current, const features::Appearance& target,
                                         std::uint64_t seed) {
  // Of pairs of which half show one place, and that get no other answer: docs/experiments/homing_grid.md.
  constexpr double kConfidence = 0.02;
  const auto sure = home_vector(current, target, {}, seed);
  if (sure) return sure;
  matching::VerifyConfig verify_config;
  verify_config.min_inliers = 3;
  verify_config.min_evidence = -std::numeric_limits<double>::infinity();
  auto hint = verified_vector(current, target, verify_config, seed);
  if (hint) hint->confidence = std::min(hint->confidence, kConfidence);
  return hint;
}

}  // namespace homeward::homing
