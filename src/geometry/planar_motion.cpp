// SPDX-License-Identifier: Apache-2.0
#include "geometry/planar_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"
#include "geometry/tilted_motion.hpp"

namespace homeward::geometry {
namespace {

/// E = [t]x R of a planar motion has five entries; phi = direction, psi = turn - direction.
struct PlanarEpipolar {
  double cos_phi;
  double sin_phi;
  double cos_psi;
  double sin_psi;

  explicit PlanarEpipolar(const PlanarMotion& motion)
      : cos_phi(std::cos(motion.direction_rad)),
        sin_phi(std::sin(motion.direction_rad)),
        cos_psi(std::cos(motion.turn_rad - motion.direction_rad)),
        sin_psi(std::sin(motion.turn_rad - motion.direction_rad)) {}

  /// Signed first-order angular error.
  [[nodiscard]] double error(const Correspondence& c) const {
    const double across_current = c.current.x() * sin_phi - c.current.y() * cos_phi;
    const double across_target = c.target.x() * sin_psi + c.target.y() * cos_psi;
    const double residual = c.target.z() * across_current + c.current.z() * across_target;
    // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
    const double gradient2 = c.target.z() * c.target.z() + across_target * across_target +
                             c.current.z() * c.current.z() + across_current * across_current -
                             2.0 * residual * residual;
    return residual / std::sqrt(std::max(gradient2, 1e-12));
  }
};

Eigen::RowVector4d constraint_row(const Correspondence& c) {
  return {-c.current.y() * c.target.z(), c.current.x() * c.target.z(), c.current.z() * c.target.y(),
          c.current.z() * c.target.x()};
}

PlanarMotion motion_from(const Eigen::Vector4d& v) {
  const double phi_rad = std::atan2(v[1], v[0]);
  const double psi_rad = std::atan2(v[3], v[2]);
  return {wrap_angle(phi_rad), wrap_angle(phi_rad + psi_rad)};
}

struct Score {
  double cost = 0.0;  // truncated squared error summed, in units of the bound (MSAC, Torr & Zisserman 2000)
  int inliers = 0;
};

Score score(const PlanarMotion& motion, std::span<const Correspondence> correspondences, double max_error_rad) {
  const PlanarEpipolar epipolar(motion);
  const double bound2 = max_error_rad * max_error_rad;
  Score result;
  for (const Correspondence& c : correspondences) {
    const double error = epipolar.error(c);
    const double ratio = error * error / bound2;
    if (ratio < 1.0) ++result.inliers;
    result.cost += std::min(ratio, 1.0);
  }
  return result;
}

/// The same for a motion that may be tilted.
Score score(const TiltedMotion& motion, std::span<const Correspondence> correspondences, double max_error_rad) {
  const EpipolarError error_of(motion);
  const double bound2 = max_error_rad * max_error_rad;
  Score result;
  for (const Correspondence& c : correspondences) {
    const double error = error_of(c);
    const double ratio = error * error / bound2;
    if (ratio < 1.0) ++result.inliers;
    result.cost += std::min(ratio, 1.0);
  }
  return result;
}

std::vector<int> inliers_of(const TiltedMotion& motion, std::span<const Correspondence> correspondences,
                            double max_error_rad) {
  const EpipolarError error_of(motion);
  std::vector<int> inliers;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (std::abs(error_of(correspondences[i])) < max_error_rad) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

/// From a planar motion that holds loosely to one, slightly tilted, that holds tightly.
TiltedMotion tightened(const PlanarMotion& planar, std::span<const Correspondence> correspondences,
                       const PlanarRansacConfig& config) {
  TiltedMotion motion{planar};
  for (int step = 0; step < config.refinements; ++step) {
    const double share = static_cast<double>(step) / std::max(1, config.refinements - 1);
    const double bound_rad = config.search_error_rad * std::pow(config.max_error_rad / config.search_error_rad, share);
    refine_tilted(correspondences, inliers_of(motion, correspondences, bound_rad), 0.5 * bound_rad, config.tilt,
                  motion);
  }
  return motion;
}

/// Which inliers lie in front of both viewpoints: >0 forward, <0 with the direction reversed, 0 too little parallax to
/// say.
int cheirality(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& t, const Correspondence& c,
               double min_parallax_rad) {
  const Eigen::Vector3d target_in_current = rotation * c.target;
  const double cosine = c.current.dot(target_in_current);
  const double sine2 = 1.0 - cosine * cosine;
  if (sine2 < min_parallax_rad * min_parallax_rad) return 0;
  // Closest points of the two rays: current * d1 = target * d2 + t.
  const double d1 = (c.current.dot(t) - cosine * target_in_current.dot(t)) / sine2;
  const double d2 = (cosine * c.current.dot(t) - target_in_current.dot(t)) / sine2;
  if (d1 > 0.0 && d2 > 0.0) return 1;
  if (d1 < 0.0 && d2 < 0.0) return -1;
  return 0;
}

double median_parallax_rad(const TiltedMotion& motion, std::span<const Correspondence> correspondences,
                           const std::vector<int>& inliers) {
  const Eigen::Matrix3d turn = motion.rotation();
  std::vector<double> parallaxes_rad;
  parallaxes_rad.reserve(inliers.size());
  for (const int index : inliers) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(index)];
    parallaxes_rad.push_back(std::atan2(c.current.cross(turn * c.target).norm(), c.current.dot(turn * c.target)));
  }
  const auto middle = parallaxes_rad.begin() + static_cast<std::ptrdiff_t>(parallaxes_rad.size() / 2);
  std::nth_element(parallaxes_rad.begin(), middle, parallaxes_rad.end());
  return *middle;
}

/// Turns the direction round when most inliers say so; gives the share of those that agree in the end.
double settle_direction(TiltedMotion& motion, std::span<const Correspondence> correspondences,
                        const std::vector<int>& inliers, double min_parallax_rad) {
  const Eigen::Matrix3d rotation = motion.rotation();
  const Eigen::Vector3d direction = motion.direction();
  int forward = 0;
  int backward = 0;
  for (const int index : inliers) {
    const int side =
        cheirality(rotation, direction, correspondences[static_cast<std::size_t>(index)], min_parallax_rad);
    forward += side > 0 ? 1 : 0;
    backward += side < 0 ? 1 : 0;
  }
  if (backward > forward) {
    motion.planar.direction_rad = wrap_angle(motion.planar.direction_rad + kPi);
    motion.elevation_rad = -motion.elevation_rad;
    std::swap(forward, backward);
  }
  return forward + backward == 0 ? 0.0 : static_cast<double>(forward) / (forward + backward);
}

/// How many samples of two make it `sure_enough` that one of them was free of outliers.
int iterations_needed(double inlier_share, double sure_enough, int limit) {
  const double clean = inlier_share * inlier_share;
  if (clean <= 0.0) return limit;
  if (clean >= 1.0) return 1;
  const double needed = std::log(1.0 - sure_enough) / std::log(1.0 - clean);
  return needed >= limit ? limit : std::max(1, static_cast<int>(std::ceil(needed)));
}

}  // namespace

std::vector<PlanarMotion> solve_planar_motion(const std::array<Correspondence, 2>& pair) {
  Eigen::Matrix<double, 2, 4> rows;
  rows << constraint_row(pair[0]), constraint_row(pair[1]);
  const Eigen::FullPivLU<Eigen::Matrix<double, 2, 4>> lu(rows);
  if (lu.rank() < 2) return {};
  const Eigen::Matrix<double, 4, 2> null_space = lu.kernel();
  const Eigen::Vector4d n1 = null_space.col(0);
  const Eigen::Vector4d n2 = null_space.col(1);
  // |v_12|^2 = |v_34|^2 for v = a n1 + b n2: p a^2 + 2 q a b + r b^2 = 0.
  const double p = n1.head<2>().squaredNorm() - n1.tail<2>().squaredNorm();
  const double q = n1.head<2>().dot(n2.head<2>()) - n1.tail<2>().dot(n2.tail<2>());
  const double r = n2.head<2>().squaredNorm() - n2.tail<2>().squaredNorm();
  // Views from one point: all that the null space holds is a motion, because any direction will do. Take one.
  constexpr double kRounding = 1e-12;
  if (std::max({std::abs(p), std::abs(q), std::abs(r)}) < kRounding * (n1.squaredNorm() + n2.squaredNorm())) {
    return {motion_from(n1)};
  }
  const double discriminant = q * q - p * r;
  if (discriminant < 0.0) return {};
  const double root = std::sqrt(discriminant);
  std::vector<PlanarMotion> motions;
  const double pivot = -(q + std::copysign(root, q));  // stable form of the quadratic's two roots a : b
  for (const auto& [a, b] : {std::pair(pivot, p), std::pair(r, pivot)}) {
    const Eigen::Vector4d v = a * n1 + b * n2;
    if (v.squaredNorm() > 1e-24) motions.push_back(motion_from(v));
  }
  return motions;
}

double epipolar_error_rad(const PlanarMotion& motion, const Correspondence& correspondence) {
  return std::abs(PlanarEpipolar(motion).error(correspondence));
}

Result<PlanarEstimate> estimate_planar_motion(std::span<const Correspondence> correspondences,
                                              const PlanarRansacConfig& config, std::uint64_t seed) {
  const int count = static_cast<int>(correspondences.size());
  constexpr int kFewest = 3;
  if (count < kFewest) return fail(ErrorCode::kTooLittleSupport, "Fewer than three matches.");

  std::mt19937_64 random(seed);
  const auto pick = [&](int limit) { return static_cast<int>(random() % static_cast<std::uint64_t>(limit)); };
  TiltedMotion best;
  Score best_score{static_cast<double>(count), 0};
  Score best_found{static_cast<double>(count), 0};
  int needed = config.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    const int first = pick(count);
    int second = pick(count - 1);
    if (second >= first) ++second;
    const std::array<Correspondence, 2> sample = {correspondences[static_cast<std::size_t>(first)],
                                                  correspondences[static_cast<std::size_t>(second)]};
    for (const PlanarMotion& motion : solve_planar_motion(sample)) {
      const Score found = score(motion, correspondences, config.search_error_rad);
      if (found.cost >= best_found.cost) continue;
      best_found = found;
      needed = std::min(needed, iterations_needed(static_cast<double>(found.inliers) / count, config.sure_enough,
                                                  config.max_iterations));
      // Local optimisation (Chum, Matas & Kittler 2003) of the motion with its tilt.
      const TiltedMotion tight = tightened(motion, correspondences, config);
      const Score tight_score = score(tight, correspondences, config.max_error_rad);
      if (tight_score.cost >= best_score.cost) continue;
      best = tight;
      best_score = tight_score;
    }
  }
  if (best_score.inliers < kFewest) return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");

  PlanarEstimate estimate;
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
  constexpr int kFinalSteps = 3;
  for (int step = 0; step < kFinalSteps; ++step) {
    curvature = refine_tilted(correspondences, inliers_of(best, correspondences, config.max_error_rad),
                              config.max_error_rad * 0.5, config.tilt, best);
  }
  estimate.inliers = inliers_of(best, correspondences, config.max_error_rad);
  if (static_cast<int>(estimate.inliers.size()) < kFewest) {
    return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");
  }
  estimate.forward_share = settle_direction(best, correspondences, estimate.inliers, 2.0 * config.max_error_rad);
  estimate.motion = best.planar;
  estimate.median_parallax_rad = median_parallax_rad(best, correspondences, estimate.inliers);
  const EpipolarError error_of(best);
  double squares = 0.0;
  for (const int index : estimate.inliers) {
    const double error_rad = error_of(correspondences[static_cast<std::size_t>(index)]);
    squares += error_rad * error_rad;
  }
  const double variance = squares / std::max(1.0, static_cast<double>(estimate.inliers.size()) - 2.0);
  const double determinant = curvature.determinant();
  estimate.direction_spread_rad =
      determinant > 1e-18 ? std::min(kPi, std::sqrt(variance * curvature(1, 1) / determinant)) : kPi;
  return estimate;
}

}  // namespace homeward::geometry
