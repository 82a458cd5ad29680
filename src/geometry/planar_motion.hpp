// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "geometry/relative_pose.hpp"

namespace homeward::geometry {

/// One feature seen from both viewpoints. Unit vectors in the robot frame of each.
struct Correspondence {
  Eigen::Vector3d current;
  Eigen::Vector3d target;
};

/// The motions that two correspondences allow: at most two, each up to the sign of its direction, which cheirality
/// decides. With t = (cos f, sin f, 0) and R = Rz(turn) the epipolar constraint current^T [t]x R target = 0 is linear
/// in (cos f, sin f, cos(turn - f), sin(turn - f)); two correspondences leave a plane of solutions, cut by the two unit
/// circles. (Planar motion: Ortín & Montiel 2001; here for bearings all around.)
std::vector<PlanarMotion> solve_planar_motion(const std::array<Correspondence, 2>& pair);

/// First-order angular distance of a correspondence to the epipolar constraint (Sampson), radians.
double epipolar_error_rad(const PlanarMotion& motion, const Correspondence& correspondence);

/// How far tilts are expected to go: standard deviations that hold the estimate where few matches say anything.
struct TiltPrior {
  double elevation_rad = 0.02;
  double tilt_rad = 0.02;
};

struct PlanarRansacConfig {
  double max_error_rad = 0.006;     // inlier bound of the epipolar error
  double search_error_rad = 0.015;  // the same while tilts are not known yet
  int max_iterations = 600;
  double sure_enough = 0.9999;  // stop when a better model would have been met with this probability
  int refinements = 5;          // Gauss-Newton steps of a local optimisation
  TiltPrior tilt;
};

/// What robust estimation found.
struct PlanarEstimate {
  PlanarMotion motion;
  std::vector<int> inliers;           // ascending
  double median_parallax_rad = 0.0;   // over inliers, after the turn is taken out
  double direction_spread_rad = 0.0;  // standard deviation of the direction, from the residuals' curvature
  double forward_share = 0.0;         // of inliers with visible parallax that lie in front of both viewpoints
};

/// The planar motion that most correspondences agree with: locally optimised RANSAC, deterministic by `seed`.
/// Errors: kTooLittleSupport when there are fewer than 3 correspondences or no model has 3 inliers.
Result<PlanarEstimate> estimate_planar_motion(std::span<const Correspondence> correspondences,
                                              const PlanarRansacConfig& config, std::uint64_t seed);

}  // namespace homeward::geometry
