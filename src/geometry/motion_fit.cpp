// SPDX-License-Identifier: Apache-2.0
#include "geometry/motion_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

// Right matches' residuals have Student's distribution: features are located the worse the larger they are, so that
// their errors have heavier tails than a normal distribution's.
constexpr double kFreedom = 4.0;               // the density falls as the power (4 + 1) / 2 of its tail
constexpr double kWindowOfSpread = 4.0 / 3.0;  // 1 over twice the distribution's density at 0

/// The share of azimuths at which a bearing of this height lies within `window` (a sine) of the plane of `line`.
double share_of_azimuths(const Eigen::Vector3d& line, double height, double window) {
  const double per_length = 1.0 / std::sqrt(std::max(line.squaredNorm(), 1e-12));
  const double middle = line.z() * height * per_length;
  const double reach = std::hypot(line.x(), line.y()) * per_length * std::sqrt(std::max(0.0, 1.0 - height * height));
  if (reach < 1e-9) return std::abs(middle) < window ? 1.0 : 0.0;
  const double low = std::clamp((-window - middle) / reach, -1.0, 1.0);
  const double high = std::clamp((window - middle) / reach, -1.0, 1.0);
  return (std::acos(low) - std::acos(high)) / kPi;
}

/// Whether share_of_azimuths is surely no more than `share`, by a bound that takes no arc cosines: between two cosines
/// the angle changes at most as fast as at the one further from 0.
bool surely_within(const Eigen::Vector3d& line, double height, double window, double share) {
  const double length2 = line.squaredNorm();
  const double reach2 = (line.x() * line.x() + line.y() * line.y()) * (1.0 - height * height);
  const double furthest = window * std::sqrt(length2) + std::abs(line.z() * height);
  constexpr double kRounding = 1.0 - 1e-6;
  return 4.0 * window * window * length2 <= kRounding * (share * kPi) * (share * kPi) * (reach2 - furthest * furthest);
}

/// chance_share, but `least` where it is less than that, which is most often and quickly found.
double chance_share_from(double least, const Eigen::Matrix3d& essential, const Correspondence& match,
                         double window_rad) {
  const double window = window_rad * std::sqrt(2.0);
  const Eigen::Vector3d line_in_target = essential.transpose() * match.current;
  const Eigen::Vector3d line_in_current = essential * match.target;
  double share = least;
  if (!surely_within(line_in_target, match.target.z(), window, least)) {
    share = std::max(share, share_of_azimuths(line_in_target, match.target.z(), window));
  }
  if (!surely_within(line_in_current, match.current.z(), window, least)) {
    share = std::max(share, share_of_azimuths(line_in_current, match.current.z(), window));
  }
  return share;
}

/// Where matches lie along a motion's direction, and what that makes of them.
class AlongDirection {
 public:
  explicit AlongDirection(const TiltedMotion& motion)
      : in_current_(motion.direction()), in_target_(motion.rotation().transpose() * in_current_) {}

  void look_at(const Correspondence& match) {
    cosine_here_ = match.current.dot(in_current_);
    cosine_there_ = match.target.dot(in_target_);
    sine2_here_ = std::max(kLeastSine2, 1.0 - cosine_here_ * cosine_here_);
    sine2_there_ = std::max(kLeastSine2, 1.0 - cosine_there_ * cosine_there_);
    log_scale_ratio_ = match.log_scale_ratio;
  }

  /// The sine by which the match lies further from the direction in the target view: positive in front of both views.
  [[nodiscard]] double parallax() const {
    return std::sqrt(sine2_there_) * cosine_here_ - std::sqrt(sine2_here_) * cosine_there_;
  }

  /// How much likelier this side is for a right match, which lies in front, than for a wrong one, which lies anywhere.
  [[nodiscard]] double likelihood_of_side(double spread_rad) const {
    constexpr double kLeastSpreadRad = 0.001;
    constexpr double kLogisticOfNormal = 1.7;  // the logistic function that is nearest to the normal distribution's
    const double parallax_spread_rad = std::numbers::sqrt2 * std::max(spread_rad, kLeastSpreadRad);
    return 2.0 / (1.0 + std::exp(-kLogisticOfNormal * parallax() / parallax_spread_rad));
  }

  /// How much likelier the change of size is for a right match than for a wrong one. The sines of the angles to the
  /// direction are as the distances' inverses, and so as the sizes.
  [[nodiscard]] double likelihood_of_size(double spread_rad) const {
    if (log_scale_ratio_ == 0.0) return 1.0;
    constexpr double kRight = 0.35;  // spread of right matches about what they should be, in pairs of known direction
    constexpr double kWrong = 0.5;   // and of wrong ones about no change
    constexpr double kTail = 3.0;    // degrees of freedom of Student's distribution
    const double expected = 0.5 * std::log(sine2_there_ / sine2_here_);
    const double variance = kRight * kRight + spread_rad * spread_rad * (1.0 / sine2_here_ + 1.0 / sine2_there_);
    const double off = log_scale_ratio_ - expected;
    const double as_wrong = 1.0 + log_scale_ratio_ * log_scale_ratio_ / (kTail * kWrong * kWrong);
    const double as_right = 1.0 + off * off / (kTail * variance);
    return kWrong / std::sqrt(variance) * (as_wrong * as_wrong) / (as_right * as_right);
  }

 private:
  static constexpr double kLeastSine2 = 1e-4;
  Eigen::Vector3d in_current_;
  Eigen::Vector3d in_target_;
  double cosine_here_ = 0.0;
  double cosine_there_ = 0.0;
  double sine2_here_ = 1.0;
  double sine2_there_ = 1.0;
  double log_scale_ratio_ = 0.0;
};

/// Turns the motion round when that puts more matches in front of both viewpoints.
void orient(std::span<const Correspondence> correspondences, double bound_rad, TiltedMotion& motion) {
  const EpipolarError error_of(motion);
  AlongDirection along(motion);
  double votes = 0.0;
  for (const Correspondence& match : correspondences) {
    if (std::abs(error_of(match)) > 2.0 * bound_rad) continue;
    along.look_at(match);
    votes += std::clamp(along.parallax() / bound_rad, -1.0, 1.0);
  }
  if (votes >= 0.0) return;
  motion.planar.direction_rad = wrap_angle(motion.planar.direction_rad + kPi);
  motion.elevation_rad = -motion.elevation_rad;
}

struct Normal {
  Eigen::Matrix<double, 5, 5> curvature = Eigen::Matrix<double, 5, 5>::Zero();
  MotionAngles gradient = MotionAngles::Zero();
};

/// The quadratic cost of the tilts, in nats.
double prior_cost(const TiltedMotion& motion, const TiltPrior& prior) {
  const auto squared = [](double ratio) { return ratio * ratio; };
  return 0.5 * (squared(motion.elevation_rad / prior.elevation_rad) + squared(motion.roll_rad / prior.tilt_rad) +
                squared(motion.pitch_rad / prior.tilt_rad));
}

/// Beliefs, likelihood, share and spread of a motion as it stands; the normal equations of its next step if wanted.
void look(std::span<const Correspondence> correspondences, const FitConfig& config, MotionFit& fit, Normal* normal) {
  const EpipolarError error_of(fit.motion);
  // A window as wide as makes a uniform residual in it as dense as a right one at its middle.
  const double window_rad = fit.spread_rad * kWindowOfSpread;
  AlongDirection along(fit.motion);
  const double per_variance = 1.0 / (fit.spread_rad * fit.spread_rad);
  fit.belief.resize(correspondences.size());
  fit.log_likelihood = -prior_cost(fit.motion, config.tilt);
  fit.greatest_gain = 0.0;
  // Likelihoods are given how the matches look: looks alone are no evidence of any motion.
  const auto share_of = [&](double odds) { return fit.share * odds / (fit.share * odds + 1.0 - fit.share); };
  // Beyond so many spreads a match cannot be right enough to matter.
  constexpr double kHopeless2 = 30.0 * 30.0;
  double telling = 0.0;
  double expected = 0.0;
  double right = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const double error_rad = error_of(correspondences[i]);
    const double error2 = error_rad * error_rad * per_variance;
    const double share = share_of(correspondences[i].odds);
    if (error2 > kHopeless2) {
      fit.belief[i] = 0.0;
      fit.log_likelihood += std::log(1.0 - share);
      telling += 1.0;
      expected += share;
      continue;
    }
    const double chance = chance_share_from(config.least_chance, error_of.essential(), correspondences[i], window_rad);
    along.look_at(correspondences[i]);
    const double tail = 1.0 / (1.0 + error2 / kFreedom);
    const double as_right = share * along.likelihood_of_side(fit.spread_rad) *
                            along.likelihood_of_size(fit.spread_rad) * tail * tail * std::sqrt(tail) / chance;
    const double belief = as_right / (as_right + 1.0 - share);
    const double gain = std::log(as_right + 1.0 - share);
    fit.belief[i] = belief;
    fit.log_likelihood += gain;
    fit.greatest_gain = std::max(fit.greatest_gain, gain);
    const double pull = tail * (kFreedom + 1.0) / kFreedom;
    telling += 1.0 - chance;
    expected += (1.0 - chance) * share;
    right += (1.0 - chance) * belief;
    squares += (1.0 - chance) * belief * pull * error_rad * error_rad;
    if (normal == nullptr || belief < 1e-4) continue;
    MotionAngles slope;
    static_cast<void>(error_of(correspondences[i], slope));
    const double weight = belief * pull * per_variance;
    normal->curvature += weight * slope * slope.transpose();
    normal->gradient += weight * error_rad * slope;
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

void step(const FitConfig& config, Normal& normal, MotionFit& fit) {
  constexpr double kHeldRad = 1e-6;
  const auto hold = [&](Eigen::Index i, double value_rad, double spread_rad) {
    const double weight = 1.0 / (spread_rad * spread_rad);
    normal.curvature(i, i) += weight;
    normal.gradient[i] += weight * value_rad;
  };
  hold(2, fit.motion.elevation_rad, config.level ? kHeldRad : config.tilt.elevation_rad);
  hold(3, fit.motion.roll_rad, config.level ? kHeldRad : config.tilt.tilt_rad);
  hold(4, fit.motion.pitch_rad, config.level ? kHeldRad : config.tilt.tilt_rad);
  // A little damping keeps the direction where it is when the views coincide and it means nothing.
  const double damping = 1e-9 * normal.curvature.topLeftCorner<2, 2>().trace() + 1e-6;
  const MotionAngles by =
      (normal.curvature + damping * Eigen::Matrix<double, 5, 5>::Identity()).ldlt().solve(normal.gradient);
  constexpr double kMaxStepRad = 0.1;
  fit.motion = moved(fit.motion, -by.cwiseMax(-kMaxStepRad).cwiseMin(kMaxStepRad));
  const Eigen::Matrix3d tilts = normal.curvature.bottomRightCorner<3, 3>();
  fit.information =
      normal.curvature.topLeftCorner<2, 2>() -
      normal.curvature.topRightCorner<2, 3>() * tilts.ldlt().solve(normal.curvature.bottomLeftCorner<3, 2>());
}

}  // namespace

double chance_share(const Eigen::Matrix3d& essential, const Correspondence& match, double window_rad) {
  // Both bearings share the error, so that the distance of one to its line may be sqrt(2) times as large.
  const double window = window_rad * std::sqrt(2.0);
  return std::max(share_of_azimuths(essential.transpose() * match.current, match.target.z(), window),
                  share_of_azimuths(essential * match.target, match.current.z(), window));
}

MotionFit fit_motion(std::span<const Correspondence> correspondences, const TiltedMotion& start,
                     const FitConfig& config) {
  MotionFit fit;
  fit.motion = start;
  if (config.level) fit.motion = {start.planar};
  orient(correspondences, config.start_spread_rad, fit.motion);
  fit.spread_rad = config.start_spread_rad;
  fit.share = 0.5;
  for (int i = 0; i < config.steps; ++i) {
    Normal normal;
    look(correspondences, config, fit, &normal);
    step(config, normal, fit);
  }
  look(correspondences, config, fit, nullptr);
  return fit;
}

}  // namespace homeward::geometry
