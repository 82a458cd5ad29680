// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "matching/verify.hpp"

namespace homeward::homing {

struct HomingConfig {
  int min_inliers = 8;                 // fewer: no answer
  double arrived_parallax_rad = 0.03;  // median parallax below which the target is reached
};

/// Which way to drive from here to where the target picture was taken.
struct HomeVector {
  double bearing_rad = 0.0;          // direction to drive in the present robot frame, (-pi, pi]
  double turn_rad = 0.0;             // turn that brings the present heading onto the target's, (-pi, pi]
  std::optional<double> nearness;    // distance over the first baseline; nothing until one is known
  double median_parallax_rad = 0.0;  // small when near: monotone proxy of distance over scene depth
  int matches = 0;
  int inliers = 0;
  double confidence = 0.0;  // probability that bearing_rad is right within 15 degrees
};

/// The home vector that verified matches say.
HomeVector vector_of(const matching::VerifiedMatch& verified);

/// The home vector from two appearances alone (no memory of former frames).
/// Errors: kTooFewFeatures, kTooLittleSupport. It never guesses. When the two views coincide the bearing means nothing:
/// median_parallax_rad is then below arrived_parallax_rad.
/// Method: planar epipolar geometry, Goedemé 2007 §7.1.1, for planar motion (geometry/planar_motion.hpp).
Result<HomeVector> home_vector(const features::Appearance& current, const features::Appearance& target,
                               const HomingConfig& config, std::uint64_t seed);

/// The same for a robot that would rather follow a hint than stand: where home_vector has no answer, the motion that at
/// least three matches agree on, which may be chance and of another place. Its confidence is 0.02 then.
/// Errors: kTooFewFeatures, kTooLittleSupport.
/// Ours: docs/experiments/homing_grid.md.
Result<HomeVector> uncertain_home_vector(const features::Appearance& current, const features::Appearance& target,
                                         std::uint64_t seed);

}  // namespace homeward::homing
