// SPDX-License-Identifier: Apache-2.0
#include "geometry/direction_sign.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

double normal_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

SignEvidence sign_evidence(std::span<const Correspondence> correspondences, const MotionFit& fit) {
  // Parallax is the difference of two angles, each as unsure as a bearing.
  constexpr double kLeastSpreadRad = 0.001;
  const double parallax_spread_rad = std::numbers::sqrt2 * std::max(fit.spread_rad, kLeastSpreadRad);
  constexpr double kMostBelief = 0.9;   // what looks right may still be a look-alike that happens to fit
  constexpr double kVisible = 2.0;      // spreads
  constexpr double kScalePerLog = 3.0;  // from pairs of known direction: the change is some 0.25, its spread 0.4
  constexpr double kMostLogScale = 0.7;
  const Eigen::Matrix3d rotation = fit.motion.rotation();
  const Eigen::Vector3d direction = fit.motion.direction();
  SignEvidence evidence;
  double forward = 0.0;
  double visible = 0.0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Correspondence& c = correspondences[i];
    const double belief = std::min(fit.belief[i], kMostBelief);
    const Eigen::Vector3d target_in_current = rotation * c.target;
    const double cosine = c.current.dot(direction);
    const double cosine_there = target_in_current.dot(direction);
    const double parallax_rad = std::atan2(target_in_current.cross(direction).norm(), cosine_there) -
                                std::atan2(c.current.cross(direction).norm(), cosine);
    const double x = parallax_rad / parallax_spread_rad;
    evidence.parallax += std::log((belief * normal_below(x) + 0.5 * (1.0 - belief)) /
                                  (belief * normal_below(-x) + 0.5 * (1.0 - belief)));
    evidence.scale += belief * kScalePerLog * 0.5 * (cosine + cosine_there) *
                      std::clamp(c.log_scale_ratio, -kMostLogScale, kMostLogScale);
    if (fit.belief[i] > 0.5 && std::abs(x) > kVisible) {
      visible += 1.0;
      forward += x > 0.0 ? 1.0 : 0.0;
    }
  }
  evidence.forward_share = visible > 0.0 ? forward / visible : 0.0;
  return evidence;
}

SignEvidence settle_sign(std::span<const Correspondence> correspondences, MotionFit& fit) {
  SignEvidence evidence = sign_evidence(correspondences, fit);
  if (evidence.log_odds() >= 0.0) return evidence;
  fit.motion.planar.direction_rad = wrap_angle(fit.motion.planar.direction_rad + kPi);
  fit.motion.elevation_rad = -fit.motion.elevation_rad;
  const bool seen = evidence.forward_share > 0.0 || evidence.parallax != 0.0;
  return {-evidence.parallax, -evidence.scale, seen ? 1.0 - evidence.forward_share : 0.0};
}

}  // namespace homeward::geometry
