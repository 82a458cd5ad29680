// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "core/result.hpp"
#include "geometry/correspondence.hpp"
#include "geometry/planar_estimate.hpp"
#include "geometry/tilt_prior.hpp"

namespace homeward::geometry {

/// How planar motions are looked for.
struct PlanarRansacConfig {
  double max_error_rad = 0.008;    // inlier bound of the epipolar error
  double search_error_rad = 0.02;  // the same while tilts are not known yet
  int max_iterations = 1000;
  double sure_enough = 0.9999;  // stop when a better model would have been met with this probability
  int refinements = 5;          // Gauss-Newton steps of a local optimisation
  int candidates = 6;           // directions that are optimised and judged in the end
  TiltPrior tilt;
};

/// The planar motion that most correspondences agree with, deterministic by `seed`. Random samples of two are scored
/// by a truncated cost in which a match weighs the more the fewer motions explain it; the best of several directions
/// are optimised with small tilts free (Chum, Matas & Kittler 2003) and judged by their likelihood over that of chance
/// (a contrario: Moisan & Stival 2004); tilts stay only where they pay for themselves.
/// Errors: kTooLittleSupport when there are fewer than 3 correspondences or no model has 3 inliers.
Result<PlanarEstimate> estimate_planar_motion(std::span<const Correspondence> correspondences,
                                              const PlanarRansacConfig& config, std::uint64_t seed);

}  // namespace homeward::geometry
