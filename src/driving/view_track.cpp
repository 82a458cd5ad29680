// SPDX-License-Identifier: Apache-2.0
#include "driving/view_track.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

/// Standard deviation of a bearing by its confidence.
double bearing_doubt_rad(const homing::HomeVector& answer) {
  const double unsure = 1.0 - std::clamp(answer.confidence, 0.0, 1.0);
  return 0.04 + 0.35 * unsure;
}

double distance_guess_m(const homing::HomeVector& answer, const ViewTrackConfig& config) {
  return std::clamp(config.metres_per_parallax * answer.median_parallax_rad, 0.05, 5.0);
}

}  // namespace

double ViewTrack::doubt_m() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_m2_);
  return std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff()));
}

void ViewTrack::begin(const Pose2& robot, const homing::HomeVector& answer, double distance_m) {
  const double angle_rad = robot.theta_rad + answer.bearing_rad;
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  const double along_m = 0.8 * distance_m + 0.6;
  const double across_m = bearing_doubt_rad(answer) * distance_m + 0.05;
  position_m_ = Eigen::Vector2d(robot.x_m, robot.y_m) + distance_m * along;
  covariance_m2_ = along_m * along_m * along * along.transpose() + across_m * across_m * across * across.transpose();
  heading_rad_ = wrap_angle(robot.theta_rad + answer.turn_rad);
  known_ = true;
  contradictions_ = 0;
}

ViewTrack::Innovation ViewTrack::compare(const Pose2& robot, const homing::HomeVector& answer,
                                         const ViewTrackConfig& config) const {
  const Eigen::Vector2d here(robot.x_m, robot.y_m);
  const double angle_rad = robot.theta_rad + answer.bearing_rad;
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  const double apart_m = (position_m_ - here).norm();
  // The bearing is compared where the view is thought to be: comparing across the measured bearing would draw the view
  // nearer with every picture, the bias of the plain pseudo-linear filter. Very near, the thought bearing says nothing.
  constexpr double kNear_m = 0.3;
  const Eigen::Vector2d towards = apart_m > kNear_m ? Eigen::Vector2d((position_m_ - here) / apart_m) : along;
  Innovation result;
  result.across = Eigen::Vector2d(-towards.y(), towards.x());
  result.apart_m = apart_m;
  result.doubt_m = bearing_doubt_rad(answer) * std::max(0.2, apart_m) + 0.03;
  const double off_rad = wrap_angle(angle_rad - std::atan2(towards.y(), towards.x()));
  result.off_m = apart_m > kNear_m ? apart_m * off_rad : -result.across.dot(position_m_ - here);
  const double variance = result.across.dot(covariance_m2_ * result.across) + result.doubt_m * result.doubt_m;
  // A view that is near may lie on any side; a far one must not change sides.
  const bool turned_round = apart_m > 0.6 && along.dot(position_m_ - here) < -0.3;
  result.contradicts = turned_round || result.off_m * result.off_m > config.gate * config.gate * variance;
  return result;
}

bool ViewTrack::agrees(const Pose2& robot, const homing::HomeVector& answer, const ViewTrackConfig& config) const {
  return !compare(robot, answer, config).contradicts;
}

bool ViewTrack::observe(const Pose2& robot, const homing::HomeVector& answer, const ViewTrackConfig& config) {
  if (!known_) {
    begin(robot, answer, distance_guess_m(answer, config));
    return true;
  }
  const Innovation seen = compare(robot, answer, config);
  if (seen.contradicts) {
    constexpr int kPatience = 3;
    if (++contradictions_ < kPatience) return false;
    // Direction anew, distance as it was thought: the parallax knows it worse.
    begin(robot, answer, std::max(seen.apart_m, distance_guess_m(answer, config)));
    return true;
  }
  contradictions_ = 0;
  measure(seen.across, seen.off_m, seen.doubt_m);
  // Bearings of one moment share their errors: repeated, they add up to no certainty.
  constexpr double kLeastDoubt_m = 0.04;
  covariance_m2_ += Eigen::Matrix2d::Identity() * kLeastDoubt_m * kLeastDoubt_m * 0.2;
  const double blend = std::clamp(answer.confidence, 0.1, 0.7);
  heading_rad_ = wrap_angle(heading_rad_ + blend * wrap_angle(robot.theta_rad + answer.turn_rad - heading_rad_));
  return true;
}

void ViewTrack::settle(const Eigen::Vector2d& position_m, const Eigen::Matrix2d& covariance_m2, double heading_rad) {
  known_ = true;
  contradictions_ = 0;
  position_m_ = position_m;
  covariance_m2_ = covariance_m2;
  heading_rad_ = wrap_angle(heading_rad);
}

void ViewTrack::measure(const Eigen::Vector2d& axis, double off_m, double doubt_m) {
  const double variance = axis.dot(covariance_m2_ * axis) + doubt_m * doubt_m;
  const Eigen::Vector2d gain = covariance_m2_ * axis / variance;
  position_m_ += gain * off_m;
  covariance_m2_ -= gain * (axis.transpose() * covariance_m2_);
}

void ViewTrack::drift(double driven_m, const ViewTrackConfig& config) {
  const double doubt_m = config.drift_per_m * driven_m;
  covariance_m2_ += Eigen::Matrix2d::Identity() * doubt_m * doubt_m;
}

}  // namespace homeward::driving
