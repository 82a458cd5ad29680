// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.hpp"

namespace homeward::repeat {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::array<double, 12> kOutlierSpreads{40.0, 40.0, 25.0, 12.0, 12.0, 8.0, 5.0, 4.0, 3.0, 3.0, 3.0, 3.0};
constexpr double kAtRest = 1e-6;
constexpr double kOfMedian = 1.2011;   // root of the mean square over the median of a length in the plane (Rayleigh)
constexpr double kSpreads = 2.5;       // agreeing within so many standard deviations
constexpr int kFewestDistances = 8;    // fewer landmarks with a distance do not show how the camera moves
constexpr double kStrayUnseen = 0.1;   // of what it may stray then
constexpr double kHeightShare = 0.02;  // standard deviation of the camera's height over the landmarks' distance

Eigen::Matrix3d across(const Eigen::Vector3d& v) {
  Eigen::Matrix3d made;
  made << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return made;
}

double radians_per_px(const geometry::SeenPoint& seen) { return seen.bearing_per_px.norm() / std::sqrt(2.0); }

/// Pixels by a small change of the bearing.
Eigen::Matrix<double, 2, 3> pixels_by_bearing(const geometry::SeenPoint& seen) {
  const auto& slope = seen.bearing_per_px;
  return (slope.transpose() * slope).inverse() * slope.transpose();
}

struct Step {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
};

void add_landmark(const SeenLandmark& one, const ArcPose& pose, double outlier, double seen_spread_px, Step& step) {
  const Landmark& landmark = one.landmark;
  const Eigen::Matrix3d turned = pose.local_from_current.transpose();
  const Eigen::Vector3d point = turned * (landmark.bearing - landmark.nearness * pose.position);
  const double distance = point.norm();
  if (!(distance > 1e-6)) return;
  const Eigen::Vector3d bearing = point / distance;
  if (!(bearing.dot(one.seen.bearing) > 0.5)) return;
  const Expected expected = expected_at(pose, landmark);
  const double open_px = expected.spread_rad / radians_per_px(one.seen);
  const double variance = seen_spread_px * seen_spread_px + open_px * open_px;
  const Eigen::Matrix<double, 2, 3> pixels = pixels_by_bearing(one.seen);
  const Eigen::Vector2d off = pixels * (bearing - one.seen.bearing);
  const Eigen::Matrix<double, 2, 3> by_point =
      pixels * (Eigen::Matrix3d::Identity() - bearing * bearing.transpose()) / distance;
  Eigen::Matrix<double, 2, 6> slope;
  slope.leftCols<3>() = by_point * across(point);
  slope.rightCols<3>() = -landmark.nearness * by_point * turned;
  const double share = 1.0 / (1.0 + off.squaredNorm() / (variance * outlier * outlier));
  const double weight = share * share / variance;
  step.normal += weight * slope.transpose() * slope;
  step.right -= weight * slope.transpose() * off;
}

void add_priors(const ArcPose& pose, const ArcPose& start, double nearness, double stray_share,
                const PoseFitConfig& config, Step& step) {
  const double stray = nearness / stray_share;
  step.normal.bottomRightCorner<3, 3>().diagonal().array() += stray * stray;
  step.right.tail<3>() -= stray * stray * (pose.position - start.position);
  if (!config.driving) return;
  const double height = nearness / kHeightShare;
  step.normal(5, 5) += height * height;
  step.right(5) -= height * height * pose.position.z();
  // Of the vertical, by a turn w about the current frame's axes: turn * (w x up).
  const Eigen::Matrix3d& turn = pose.local_from_current;
  Eigen::Matrix<double, 2, 6> slope = Eigen::Matrix<double, 2, 6>::Zero();
  slope.col(0) = -turn.col(1).head<2>();
  slope.col(1) = turn.col(0).head<2>();
  const double weight = 1.0 / (config.driving->tilt_rad * config.driving->tilt_rad);
  step.normal += weight * slope.transpose() * slope;
  step.right -= weight * slope.transpose() * turn.col(2).head<2>();
}

}  // namespace

Expected expected_at(const ArcPose& pose, const Landmark& landmark) {
  Expected expected;
  const Eigen::Vector3d point = landmark.bearing - landmark.nearness * pose.position;
  expected.distance = point.norm();
  if (!(expected.distance > 1e-9)) return expected;
  const Eigen::Vector3d unit = point / expected.distance;
  expected.bearing = pose.local_from_current.transpose() * unit;
  const Eigen::Vector3d aside = pose.position - unit * unit.dot(pose.position);
  expected.spread_rad = landmark.nearness_spread * aside.norm() / expected.distance;
  return expected;
}

PoseFit judge_pose(std::span<const SeenLandmark> seen, const ArcPose& pose, const PoseFitConfig& config) {
  PoseFit fit;
  fit.pose = pose;
  for (const SeenLandmark& one : seen) {
    const Expected expected = expected_at(pose, one.landmark);
    double off_px = geometry::offset_px(one.seen, expected.bearing).norm();
    if (!std::isfinite(off_px)) off_px = 1e6;
    const bool agrees = off_px * radians_per_px(one.seen) <=
                        config.agree_rad + std::min(kSpreads * expected.spread_rad, config.most_open_rad);
    fit.off_px.push_back(off_px);
    fit.agrees.push_back(agrees);
    fit.agreeing += agrees ? 1 : 0;
  }
  if (fit.off_px.empty()) return fit;
  fit.error_px = kOfMedian * median(fit.off_px);
  fit.error_rad = fit.error_px * radians_per_px(seen.front().seen);
  return fit;
}

PoseFit fit_pose(std::span<const SeenLandmark> seen, const ArcSurroundings& around, const ArcPose& start,
                 const PoseFitConfig& config) {
  ArcPose pose = start;
  const bool is_placed = around.nearness > 0.0;
  const auto distances = std::ranges::count_if(seen, [](const SeenLandmark& one) { return one.landmark.has_distance; });
  const double stray_share = distances >= kFewestDistances ? config.stray_share : kStrayUnseen * config.stray_share;
  for (const double outlier : kOutlierSpreads) {
    Step step;
    for (const SeenLandmark& one : seen) add_landmark(one, pose, outlier, config.seen_spread_px, step);
    if (is_placed) {
      add_priors(pose, start, around.nearness, stray_share, config, step);
    } else {
      step.normal.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity();
      step.normal.topRightCorner<3, 3>().setZero();
      step.normal.bottomLeftCorner<3, 3>().setZero();
      step.right.tail<3>().setZero();
    }
    step.normal.diagonal().array() += 1e-9;
    const Vector6 by = step.normal.ldlt().solve(step.right);
    if (!by.allFinite()) break;
    const double angle = by.head<3>().norm();
    if (angle > 0.0) {
      pose.local_from_current =
          (pose.local_from_current * Eigen::AngleAxisd(angle, by.head<3>() / angle).toRotationMatrix()).eval();
    }
    pose.position += by.tail<3>();
    if (angle < kAtRest && by.tail<3>().norm() * around.nearness < kAtRest && outlier <= 3.0) break;
  }
  return judge_pose(seen, pose, config);
}

}  // namespace homeward::repeat
