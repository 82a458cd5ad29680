// SPDX-License-Identifier: Apache-2.0
#include "geometry/estimate_summary.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "core/median.hpp"
#include "geometry/direction_sign.hpp"
#include "geometry/tilted_refinement.hpp"

namespace homeward::geometry {
namespace {

double median_parallax_rad(const TiltedMotion& motion, std::span<const Correspondence> correspondences,
                           const std::vector<int>& inliers) {
  const Eigen::Matrix3d turn = motion.rotation();
  std::vector<double> parallaxes_rad;
  parallaxes_rad.reserve(inliers.size());
  for (const int index : inliers) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(index)];
    const Eigen::Vector3d target_in_current = turn * c.target;
    parallaxes_rad.push_back(std::atan2(c.current.cross(target_in_current).norm(), c.current.dot(target_in_current)));
  }
  return median(std::move(parallaxes_rad));
}

}  // namespace

Result<PlanarEstimate> summarise(std::span<const Correspondence> correspondences, MotionFit fit, double max_error_rad) {
  constexpr std::size_t kFewest = 3;
  const SignEvidence sign = settle_sign(correspondences, fit);
  PlanarEstimate estimate;
  estimate.inliers = matches_within(max_error_rad, fit.motion, correspondences);
  if (estimate.inliers.size() < kFewest) {
    return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");
  }
  estimate.motion = fit.motion.planar;
  estimate.median_parallax_rad = median_parallax_rad(fit.motion, correspondences, estimate.inliers);
  estimate.forward_share = sign.forward_share;
  estimate.error_spread_rad = fit.spread_rad;
  estimate.tilt_rad = std::hypot(fit.motion.roll_rad, fit.motion.pitch_rad);
  estimate.sign_log_odds = sign.log_odds();
  const double determinant = fit.information.determinant();
  estimate.direction_spread_rad =
      determinant > 1e-6 ? std::min(kPi, std::sqrt(fit.information(1, 1) / determinant)) : kPi;
  return estimate;
}

Result<PlanarEstimate> with_finite_only(
    std::span<const Correspondence> correspondences,
    const std::function<Result<PlanarEstimate>(std::span<const Correspondence>)>& estimate) {
  const auto is_finite = [](const Correspondence& c) {
    return c.current.allFinite() && c.target.allFinite() && std::isfinite(c.log_scale_ratio) && std::isfinite(c.odds);
  };
  if (std::ranges::all_of(correspondences, is_finite)) return estimate(correspondences);
  std::vector<Correspondence> finite;
  std::vector<int> index;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (!is_finite(correspondences[i])) continue;
    finite.push_back(correspondences[i]);
    index.push_back(static_cast<int>(i));
  }
  auto result = estimate(finite);
  if (result) {
    for (int& inlier : result->inliers) inlier = index[static_cast<std::size_t>(inlier)];
  }
  return result;
}

}  // namespace homeward::geometry
