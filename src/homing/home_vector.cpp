// SPDX-License-Identifier: Apache-2.0
#include "homing/home_vector.hpp"

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

Result<HomeVector> home_vector(const features::Appearance& current, const features::Appearance& target,
                               const HomingConfig& config, std::uint64_t seed) {
  matching::VerifyConfig verify_config;
  verify_config.min_inliers = config.min_inliers;
  const auto verified = matching::verify(current, target, verify_config, seed);
  if (!verified) return pass_on(verified);
  return vector_of(*verified);
}

}  // namespace homeward::homing
