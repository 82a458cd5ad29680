// SPDX-License-Identifier: Apache-2.0
#include "geometry/epipolar_px.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace homeward::geometry {
namespace {

constexpr int kSteps = 15;
constexpr double kAtRest = 1e-7;  // radians

double robust(double error_px, double outlier_px) {
  const double square = error_px * error_px;
  const double bound = outlier_px * outlier_px;
  return square * bound / (bound + square);
}

double weight(double error_px, double outlier_px) {
  const double share = 1.0 / (1.0 + error_px * error_px / (outlier_px * outlier_px));
  return share * share;
}

/// What refine() makes least.
struct Sum {
  std::span<const PointPair> pairs;
  double outlier_px;
  const std::optional<DrivingPrior>& driving;
  double spread_px;

  [[nodiscard]] double operator()(const ViewMotion& motion) const {
    const EpipolarPixels error(motion);
    double sum = spread_px * spread_px * unlike_driving(motion, driving);
    for (const PointPair& pair : pairs) sum += robust(error(pair), outlier_px);
    return sum;
  }
};

}  // namespace

double unlike_driving(const ViewMotion& motion, const std::optional<DrivingPrior>& driving) {
  if (!driving) return 0.0;
  Eigen::Matrix<double, 4, 5> slope;
  return EpipolarPixels(motion).unlike_driving(*driving, slope).squaredNorm();
}

Eigen::Vector4d EpipolarPixels::unlike_driving(const DrivingPrior& driving, Eigen::Matrix<double, 4, 5>& slope) const {
  const Eigen::Matrix3d& turn = motion_.current_from_target;
  const Eigen::Vector3d up = turn.col(2);
  const Eigen::Vector3d& along = motion_.target_in_current;
  slope.setZero();
  // By a turn w about the target's axes: turn * (w x up of the target).
  slope.block<2, 1>(0, 0) = -turn.col(1).head<2>() / driving.tilt_rad;
  slope.block<2, 1>(0, 1) = turn.col(0).head<2>() / driving.tilt_rad;
  slope.block<1, 2>(2, 3) = across_.row(2) / driving.climb_rad;
  slope.block<1, 2>(3, 3) = across_.row(1) / driving.swerve_rad;
  return {up.x() / driving.tilt_rad, up.y() / driving.tilt_rad, along.z() / driving.climb_rad,
          along.y() / driving.swerve_rad};
}

EpipolarPixels::EpipolarPixels(const ViewMotion& motion) : motion_(motion) {
  across_.col(0) = motion.target_in_current.unitOrthogonal();
  across_.col(1) = motion.target_in_current.cross(across_.col(0));
}

double EpipolarPixels::operator()(const PointPair& pair) const {
  const Eigen::Vector3d line = motion_.target_in_current.cross(motion_.current_from_target * pair.target.bearing);
  const Eigen::Vector3d line_in_target =
      motion_.current_from_target.transpose() * pair.current.bearing.cross(motion_.target_in_current);
  const Eigen::Vector2d in_current = pair.current.bearing_per_px.transpose() * line;
  const Eigen::Vector2d in_target = pair.target.bearing_per_px.transpose() * line_in_target;
  const double gradient = std::max(std::sqrt(in_current.squaredNorm() + in_target.squaredNorm()), 1e-12);
  return pair.current.bearing.dot(line) / gradient;
}

double EpipolarPixels::operator()(const PointPair& pair, MotionStep& slope) const {
  const Eigen::Vector3d& along = motion_.target_in_current;
  const Eigen::Matrix3d& turn = motion_.current_from_target;
  const Eigen::Vector3d& current = pair.current.bearing;
  const Eigen::Vector3d turned = turn * pair.target.bearing;
  const Eigen::Vector3d line = along.cross(turned);  // what the error is the current bearing's share of
  const Eigen::Vector3d line_in_target = turn.transpose() * current.cross(along);
  const double error = current.dot(line);
  // The gradient by the pixels, and half the slope of its square by the step.
  const Eigen::Vector2d in_current = pair.current.bearing_per_px.transpose() * line;
  const Eigen::Vector2d in_target = pair.target.bearing_per_px.transpose() * line_in_target;
  const double gradient = std::max(std::sqrt(in_current.squaredNorm() + in_target.squaredNorm()), 1e-12);
  const Eigen::Vector3d by_current = pair.current.bearing_per_px * in_current;
  const Eigen::Vector3d by_target = pair.target.bearing_per_px * in_target;
  const Eigen::Vector3d gradient_by_turn =
      turn.transpose() * (by_current * along.dot(turned) - along * by_current.dot(turned)) +
      by_target.cross(line_in_target);
  const Eigen::Vector3d gradient_by_along = turned.cross(by_current) + (turn * by_target).cross(current);
  const double held = error / (gradient * gradient);
  slope.head<3>() = (pair.target.bearing.cross(line_in_target) - held * gradient_by_turn) / gradient;
  slope.tail<2>() = across_.transpose() * (turned.cross(current) - held * gradient_by_along) / gradient;
  return error / gradient;
}

ViewMotion EpipolarPixels::moved(const MotionStep& by) const {
  ViewMotion motion = motion_;
  const Eigen::Vector3d turn = by.head<3>();
  if (const double angle = turn.norm(); angle > 0.0) {
    const Eigen::Quaterniond turned(motion_.current_from_target * Eigen::AngleAxisd(angle, turn / angle));
    motion.current_from_target = turned.normalized().toRotationMatrix();
  }
  motion.target_in_current = (motion_.target_in_current + across_ * by.tail<2>()).normalized();
  return motion;
}

RefinedMotion refine(const ViewMotion& motion, std::span<const PointPair> pairs, double outlier_px,
                     const std::optional<DrivingPrior>& driving, double spread_px) {
  const Sum sum{pairs, outlier_px, driving, spread_px};
  RefinedMotion best;
  best.motion = motion;
  best.cost = sum(motion);
  double damping = 1e-3;
  for (int i = 0; i < kSteps; ++i) {
    const EpipolarPixels error(best.motion);
    best.information.setZero();
    MotionStep gradient = MotionStep::Zero();
    MotionStep slope;
    for (const PointPair& pair : pairs) {
      const double off = error(pair, slope);
      const double weighs = weight(off, outlier_px);
      best.information += weighs * slope * slope.transpose();
      gradient += weighs * off * slope;
    }
    if (driving) {
      Eigen::Matrix<double, 4, 5> unlike_slope;
      const Eigen::Vector4d unlike = error.unlike_driving(*driving, unlike_slope);
      best.information += spread_px * spread_px * unlike_slope.transpose() * unlike_slope;
      gradient += spread_px * spread_px * unlike_slope.transpose() * unlike;
    }
    Eigen::Matrix<double, 5, 5> damped = best.information;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    const MotionStep step = -damped.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    const ViewMotion tried = error.moved(step);
    const double cost = sum(tried);
    if (cost > best.cost) {
      damping *= 10.0;
      continue;
    }
    best.motion = tried;
    best.cost = cost;
    damping *= 0.1;
    if (step.norm() < kAtRest) break;
  }
  return best;
}

}  // namespace homeward::geometry
