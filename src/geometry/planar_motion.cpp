// SPDX-License-Identifier: Apache-2.0
#include "geometry/planar_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"

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

/// One Gauss-Newton step on (direction, turn) with Cauchy weights; numeric derivatives of two angles are exact enough.
/// Returns the curvature matrix J^T W J.
Eigen::Matrix2d refine_once(std::span<const Correspondence> correspondences, const std::vector<int>& inliers,
                            double scale_rad, PlanarMotion& motion) {
  constexpr double kStepRad = 1e-6;
  const PlanarEpipolar here(motion);
  const PlanarEpipolar direction_moved({motion.direction_rad + kStepRad, motion.turn_rad});
  const PlanarEpipolar turn_moved({motion.direction_rad, motion.turn_rad + kStepRad});
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (const int index : inliers) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(index)];
    const double error_rad = here.error(c);
    const Eigen::Vector2d slope((direction_moved.error(c) - error_rad) / kStepRad,
                                (turn_moved.error(c) - error_rad) / kStepRad);
    const double ratio = error_rad / scale_rad;
    const double weight = 1.0 / (1.0 + ratio * ratio);
    curvature += weight * slope * slope.transpose();
    gradient += weight * slope * error_rad;
  }
  // A little damping keeps the direction where it is when the views coincide and it means nothing.
  const double damping = 1e-9 * (curvature.trace() + 1.0);
  const Eigen::Vector2d step = (curvature + damping * Eigen::Matrix2d::Identity()).ldlt().solve(gradient);
  constexpr double kMaxStepRad = 0.2;
  motion.direction_rad = wrap_angle(motion.direction_rad - std::clamp(step[0], -kMaxStepRad, kMaxStepRad));
  motion.turn_rad = wrap_angle(motion.turn_rad - std::clamp(step[1], -kMaxStepRad, kMaxStepRad));
  return curvature;
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

std::vector<int> inliers_of(const PlanarMotion& motion, std::span<const Correspondence> correspondences,
                            double max_error_rad) {
  const PlanarEpipolar epipolar(motion);
  std::vector<int> inliers;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (std::abs(epipolar.error(correspondences[i])) < max_error_rad) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

/// Which inliers lie in front of both viewpoints: >0 forward, <0 with the direction reversed, 0 too little parallax to
/// say.
int cheirality(const PlanarMotion& motion, const Correspondence& c, double min_parallax_rad) {
  const Eigen::Vector3d target_in_current =
      Eigen::AngleAxisd(motion.turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * c.target;
  const Eigen::Vector3d t(std::cos(motion.direction_rad), std::sin(motion.direction_rad), 0.0);
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

double median_parallax_rad(const PlanarMotion& motion, std::span<const Correspondence> correspondences,
                           const std::vector<int>& inliers) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(motion.turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
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
double settle_direction(PlanarMotion& motion, std::span<const Correspondence> correspondences,
                        const std::vector<int>& inliers, double min_parallax_rad) {
  int forward = 0;
  int backward = 0;
  for (const int index : inliers) {
    const int side = cheirality(motion, correspondences[static_cast<std::size_t>(index)], min_parallax_rad);
    forward += side > 0 ? 1 : 0;
    backward += side < 0 ? 1 : 0;
  }
  if (backward > forward) {
    motion.direction_rad = wrap_angle(motion.direction_rad + kPi);
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
  PlanarMotion best;
  Score best_score{static_cast<double>(count), 0};
  int needed = config.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    const int first = pick(count);
    int second = pick(count - 1);
    if (second >= first) ++second;
    const std::array<Correspondence, 2> sample = {correspondences[static_cast<std::size_t>(first)],
                                                  correspondences[static_cast<std::size_t>(second)]};
    for (PlanarMotion motion : solve_planar_motion(sample)) {
      Score found = score(motion, correspondences, config.max_error_rad);
      if (found.cost >= best_score.cost) continue;
      // Local optimisation (Chum, Matas & Kittler 2003): the refined model is kept when it is better still.
      for (int step = 0; step < config.refinements; ++step) {
        PlanarMotion refined = motion;
        refine_once(correspondences, inliers_of(motion, correspondences, config.max_error_rad), config.max_error_rad,
                    refined);
        const Score refined_score = score(refined, correspondences, config.max_error_rad);
        if (refined_score.cost >= found.cost) break;
        motion = refined;
        found = refined_score;
      }
      best = motion;
      best_score = found;
      needed = std::min(needed, iterations_needed(static_cast<double>(found.inliers) / count, config.sure_enough,
                                                  config.max_iterations));
    }
  }
  if (best_score.inliers < kFewest) return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");

  PlanarEstimate estimate;
  Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
  constexpr int kFinalSteps = 5;
  for (int step = 0; step < kFinalSteps; ++step) {
    curvature = refine_once(correspondences, inliers_of(best, correspondences, config.max_error_rad),
                            config.max_error_rad * 0.5, best);
  }
  estimate.inliers = inliers_of(best, correspondences, config.max_error_rad);
  if (static_cast<int>(estimate.inliers.size()) < kFewest) {
    return fail(ErrorCode::kTooLittleSupport, "No motion explains three matches.");
  }
  estimate.forward_share = settle_direction(best, correspondences, estimate.inliers, 2.0 * config.max_error_rad);
  estimate.motion = best;
  estimate.median_parallax_rad = median_parallax_rad(best, correspondences, estimate.inliers);
  double squares = 0.0;
  for (const int index : estimate.inliers) {
    const double error_rad = epipolar_error_rad(best, correspondences[static_cast<std::size_t>(index)]);
    squares += error_rad * error_rad;
  }
  const double variance = squares / std::max(1.0, static_cast<double>(estimate.inliers.size()) - 2.0);
  const double determinant = curvature.determinant();
  estimate.direction_spread_rad =
      determinant > 1e-18 ? std::min(kPi, std::sqrt(variance * curvature(1, 1) / determinant)) : kPi;
  return estimate;
}

}  // namespace homeward::geometry
