// SPDX-License-Identifier: Apache-2.0
#include "geometry/motion_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.hpp"
#include "geometry/tilted_refinement.hpp"

namespace homeward::geometry {
namespace {

constexpr double kWindowOfSpread = 4.0 / 3.0;  // 1 over twice the distribution's density at 0

/// Turns the motion round when that puts more matches in front of both viewpoints.
void orient(const MatchRows& matches, double bound_rad, TiltedMotion& motion) {
  constexpr double kLeastSine2 = 1e-4;
  thread_local std::vector<double> errors_rad;
  matches.errors(EpipolarError(motion), errors_rad);
  const Eigen::Vector3d in_current = motion.direction();
  const Eigen::Vector3d in_target = motion.rotation().transpose() * in_current;
  double evidence = 0.0;
  for (std::size_t i = 0; i < errors_rad.size(); ++i) {
    if (std::abs(errors_rad[i]) > 2.0 * bound_rad) continue;
    const double here = matches.matches()[i].current.dot(in_current);
    const double there = matches.matches()[i].target.dot(in_target);
    const double parallax = std::sqrt(std::max(kLeastSine2, 1.0 - there * there)) * here -
                            std::sqrt(std::max(kLeastSine2, 1.0 - here * here)) * there;
    evidence += std::clamp(parallax / bound_rad, -1.0, 1.0);
  }
  if (evidence >= 0.0) return;
  motion.planar.direction_rad = wrap_angle(motion.planar.direction_rad + kPi);
  motion.elevation_rad = -motion.elevation_rad;
}

/// The quadratic cost of the tilts, in nats.
double prior_cost(const TiltedMotion& motion, const TiltPrior& prior) {
  const auto squared = [](double ratio) { return ratio * ratio; };
  return 0.5 * (squared(motion.elevation_rad / prior.elevation_rad) + squared(motion.roll_rad / prior.tilt_rad) +
                squared(motion.pitch_rad / prior.tilt_rad));
}

/// What `look` needs room for, kept from one look to the next.
struct Room {
  MatchRows::Seen seen;
  std::vector<double> slopes;
};

/// Beliefs, likelihood, share and spread of a motion as it stands; the normal equations of its next step if wanted.
void look(const MatchRows& matches, const FitConfig& config, Room& room, MotionFit& fit, NormalEquations* normal) {
  const EpipolarError error_of(fit.motion);
  MatchRows::Seen& seen = room.seen;
  if (normal != nullptr) {
    matches.errors_and_slopes(error_of, seen.error_rad, room.slopes);
  } else {
    matches.errors(error_of, seen.error_rad);
  }
  constexpr double kHopeless = 30.0;  // beyond so many spreads a match cannot be right enough to matter
  // A window as wide as makes a uniform residual in it as dense as a right one at its middle.
  matches.chances(error_of, fit.spread_rad * kWindowOfSpread, config.least_chance, seen.chance);
  seen.possible.resize(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    seen.possible[i] = std::abs(seen.error_rad[i]) > kHopeless * fit.spread_rad ? 0.0 : 1.0;
  }
  const Eigen::Vector3d direction = fit.motion.direction();
  matches.judge({direction, fit.motion.rotation().transpose() * direction, fit.spread_rad, fit.share}, seen);
  const double per_variance = 1.0 / (fit.spread_rad * fit.spread_rad);
  fit.belief = seen.belief;
  // Likelihoods are given how the matches look: looks alone are no evidence of any motion.
  fit.log_likelihood = -prior_cost(fit.motion, config.tilt);
  fit.greatest_gain = 0.0;
  double telling = 0.0;
  double expected = 0.0;
  double right = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double error_rad = seen.error_rad[i];
    fit.log_likelihood += seen.gain[i];
    fit.greatest_gain = std::max(fit.greatest_gain, seen.gain[i]);
    telling += seen.telling[i];
    expected += seen.telling[i] * seen.share[i];
    right += seen.telling[i] * seen.belief[i];
    squares += seen.telling[i] * seen.belief[i] * seen.pull[i] * error_rad * error_rad;
    if (normal == nullptr || seen.belief[i] < 1e-4) continue;
    normal->add(seen.belief[i] * seen.pull[i] * per_variance, error_rad, room.slopes.data() + i, matches.size());
  }
  // The share is the one that expects as many right matches as there seem to be. One right match more and one wrong one
  // more than seen keep it off its ends.
  const double ratio = (right + 1.0) / (telling - right + 1.0) * (telling - expected + 1.0) / (expected + 1.0);
  const double odds = ratio * fit.share / (1.0 - fit.share);
  constexpr double kLeastShare = 0.002;
  fit.share = std::clamp(odds / (1.0 + odds), kLeastShare, 1.0 - kLeastShare);
  fit.spread_rad =
      std::clamp(std::sqrt(squares / std::max(right, 1e-9)), config.least_spread_rad, config.most_spread_rad);
}

void step(const FitConfig& config, const NormalEquations& normal, MotionFit& fit) {
  constexpr double kHeldRad = 1e-6;
  Eigen::Matrix<double, 5, 5> curvature = normal.curvature();
  MotionAngles gradient = normal.gradient();
  const auto hold = [&](Eigen::Index i, double value_rad, double spread_rad) {
    const double weight = 1.0 / (spread_rad * spread_rad);
    curvature(i, i) += weight;
    gradient[i] += weight * value_rad;
  };
  hold(2, fit.motion.elevation_rad, config.level ? kHeldRad : config.tilt.elevation_rad);
  hold(3, fit.motion.roll_rad, config.level ? kHeldRad : config.tilt.tilt_rad);
  hold(4, fit.motion.pitch_rad, config.level ? kHeldRad : config.tilt.tilt_rad);
  // A little damping keeps the direction where it is when the views coincide and it means nothing.
  const double damping = 1e-9 * curvature.topLeftCorner<2, 2>().trace() + 1e-6;
  const MotionAngles by = (curvature + damping * Eigen::Matrix<double, 5, 5>::Identity()).ldlt().solve(gradient);
  constexpr double kMaxStepRad = 0.1;
  fit.motion = moved(fit.motion, -by.cwiseMax(-kMaxStepRad).cwiseMin(kMaxStepRad));
  const Eigen::Matrix3d tilts = curvature.bottomRightCorner<3, 3>();
  fit.information = curvature.topLeftCorner<2, 2>() -
                    curvature.topRightCorner<2, 3>() * tilts.ldlt().solve(curvature.bottomLeftCorner<3, 2>());
}

}  // namespace

MotionFit fit_motion(const MatchRows& matches, const TiltedMotion& start, const FitConfig& config) {
  thread_local Room room;
  MotionFit fit;
  fit.motion = start;
  if (config.level) fit.motion = {start.planar};
  orient(matches, config.start_spread_rad, fit.motion);
  fit.spread_rad = config.start_spread_rad;
  fit.share = 0.5;
  for (int i = 0; i < config.steps; ++i) {
    NormalEquations normal;
    look(matches, config, room, fit, &normal);
    step(config, normal, fit);
  }
  look(matches, config, room, fit, nullptr);
  return fit;
}

}  // namespace homeward::geometry
