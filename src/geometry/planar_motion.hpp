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
  double log_scale_ratio = 0.0;  // log of the feature's size in the target view over that in the current; 0: not known
  double odds = 1.0;             // factor on the odds that the match is right, from how it looks; 1: says nothing
};

/// What a minimal sample allows: none, one or two motions.
class MinimalMotions {
 public:
  void push_back(const PlanarMotion& motion) { motions_[count_++] = motion; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] const PlanarMotion* begin() const { return motions_.data(); }
  [[nodiscard]] const PlanarMotion* end() const { return motions_.data() + count_; }

 private:
  std::array<PlanarMotion, 2> motions_;
  std::size_t count_ = 0;
};

/// The motions that two correspondences allow: at most two, each up to the sign of its direction, which cheirality
/// decides. With t = (cos f, sin f, 0) and R = Rz(turn) the epipolar constraint current^T [t]x R target = 0 is linear
/// in (cos f, sin f, cos(turn - f), sin(turn - f)); two correspondences leave a plane of solutions, cut by the two unit
/// circles: a quadratic. (Planar motion: Ortín & Montiel 2001; here for bearings all around.)
MinimalMotions solve_planar_motion(const std::array<Correspondence, 2>& pair);

/// First-order angular distance of a correspondence to the epipolar constraint (Sampson), radians.
double epipolar_error_rad(const PlanarMotion& motion, const Correspondence& correspondence);

/// How far tilts are expected to go: standard deviations that hold the estimate where few matches say anything.
struct TiltPrior {
  double elevation_rad = 0.02;
  double tilt_rad = 0.02;
};

struct PlanarRansacConfig {
  double max_error_rad = 0.008;    // inlier bound of the epipolar error
  double search_error_rad = 0.02;  // the same while tilts are not known yet
  int max_iterations = 1000;
  double sure_enough = 0.9999;  // stop when a better model would have been met with this probability
  int refinements = 5;          // Gauss-Newton steps of a local optimisation
  int candidates = 6;           // directions that are optimised and judged in the end
  TiltPrior tilt;
};

/// What robust estimation found.
struct PlanarEstimate {
  PlanarMotion motion;
  std::vector<int> inliers;           // ascending
  double median_parallax_rad = 0.0;   // over inliers, after the turn is taken out
  double direction_spread_rad = 0.0;  // standard deviation of the direction, from the residuals' curvature
  double forward_share = 0.0;         // of inliers with visible parallax that lie in front of both viewpoints
  double error_spread_rad = 0.0;      // standard deviation of the right matches' epipolar errors
  double tilt_rad = 0.0;              // between the views; 0 where the matches do not ask for any
  double height = 0.0;                // median of right matches over or under the camera, in units of the distance
  double agreeing = 0.0;              // share of all matches that agree with the motion
  bool general = false;               // not planar: see general_motion.hpp
  // Natural logarithms of how much likelier the matches are with this motion than
  double evidence = 0.0;       // at random, less what the search tried: matches that any motion explains add nothing
  double lead = 0.0;           // with the best motion found whose direction or turn is another
  double sign_log_odds = 0.0;  // with the direction reversed
};

/// The planar motion that most correspondences agree with, deterministic by `seed`. Random samples of two are scored
/// by a truncated cost in which a match weighs the more the fewer motions explain it; the best of several directions
/// are optimised with small tilts free (Chum, Matas & Kittler 2003) and judged by their likelihood over that of chance
/// (a contrario: Moisan & Stival 2004); tilts stay only where they pay for themselves.
/// Errors: kTooLittleSupport when there are fewer than 3 correspondences or no model has 3 inliers.
Result<PlanarEstimate> estimate_planar_motion(std::span<const Correspondence> correspondences,
                                              const PlanarRansacConfig& config, std::uint64_t seed);

}  // namespace homeward::geometry
