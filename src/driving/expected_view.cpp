// SPDX-License-Identifier: Apache-2.0
#include "driving/expected_view.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

Eigen::Matrix2d rotation(double angle_rad) { return Eigen::Rotation2Dd(angle_rad).toRotationMatrix(); }

constexpr double kMost = 50.0;  // squared standard deviations: what is farther off is no more wrong

}  // namespace

ExpectedView expected_view(const PoseHypothesis& hypothesis, const ViewSighting& sighting) {
  ExpectedView result;
  result.robot_from_view = inverse(hypothesis.map_from_robot) * sighting.map_from_view;
  result.distance_m = position_m(result.robot_from_view).norm();
  // r = R(-theta) (v - x): moves against x, and across with the heading.
  Eigen::Matrix<double, 2, 3> moved;
  moved.leftCols<2>() = -rotation(-hypothesis.map_from_robot.theta_rad);
  moved.col(2) = Vector2(result.robot_from_view.y_m, -result.robot_from_view.x_m);
  result.covariance_m2 = moved * hypothesis.covariance * moved.transpose() +
                         sighting.spread_m * sighting.spread_m * Eigen::Matrix2d::Identity();
  return result;
}

double disagreement(const PoseHypothesis& hypothesis, const ExpectedView& view, const SightedDirection& seen,
                    const PoseHypothesesConfig& config) {
  constexpr double kNearest_m = 0.5;
  constexpr double kDistanceSpread = 0.9;  // of the logarithm
  const Vector2 along(std::cos(seen.bearing_rad), std::sin(seen.bearing_rad));
  const Vector2 across(-along.y(), along.x());
  const Vector2 at_m = position_m(view.robot_from_view);
  const double noise = std::pow(config.bearing_rad * std::max(0.2, view.distance_m), 2) + 0.05 * 0.05;
  const double variance = across.dot(view.covariance_m2 * across) + noise;
  const double off_m = across.dot(at_m);
  double squared = off_m * off_m / variance;
  // Behind the robot in place of ahead.
  const double behind_m = -along.dot(at_m);
  if (behind_m > 0.0) squared += behind_m * behind_m / (along.dot(view.covariance_m2 * along) + noise);
  const double turned = config.turn_rad * config.turn_rad;
  const double turn_variance = hypothesis.covariance(2, 2) + turned;
  const double off_rad = wrap_angle(seen.turn_rad - view.robot_from_view.theta_rad);
  // The share of features recognised tells the distance to a factor; by night less is recognised of what is near.
  const double farther =
      std::log(std::max(kNearest_m, view.distance_m) / std::max(kNearest_m, seen.distance_m)) / kDistanceSpread;
  squared += off_rad * off_rad / turn_variance + farther * farther;
  return std::min(kMost, squared);
}

MeasuredPose measured_pose(const ViewSighting& sighting, const PoseHypothesesConfig& config) {
  MeasuredPose result;
  result.map_from_robot = sighting.map_from_view * inverse(sighting.pose->robot_from_view);
  const Eigen::Matrix2d turned = rotation(result.map_from_robot.theta_rad);
  result.covariance.setZero();
  result.covariance.topLeftCorner<2, 2>() = turned * sighting.pose->covariance_m2 * turned.transpose() +
                                            sighting.spread_m * sighting.spread_m * Eigen::Matrix2d::Identity();
  result.covariance(2, 2) = config.turn_rad * config.turn_rad;
  return result;
}

Eigen::Vector3d difference(const Pose2& to, const Pose2& from) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

double disagreement(const PoseHypothesis& hypothesis, const ViewSighting& sighting,
                    const PoseHypothesesConfig& config) {
  if (sighting.pose) {
    const MeasuredPose seen = measured_pose(sighting, config);
    const Eigen::Matrix3d sum = hypothesis.covariance + seen.covariance;
    const Eigen::Vector3d off = difference(seen.map_from_robot, hypothesis.map_from_robot);
    return std::min(kMost, off.dot(sum.llt().solve(off)));
  }
  return disagreement(hypothesis, expected_view(hypothesis, sighting), *sighting.direction, config);
}

PoseHypothesis begun_at(const ViewSighting& sighting, double distance_m, const PoseHypothesesConfig& config) {
  const SightedDirection& seen = *sighting.direction;
  PoseHypothesis one;
  const Pose2 robot_from_view{distance_m * std::cos(seen.bearing_rad), distance_m * std::sin(seen.bearing_rad),
                              seen.turn_rad};
  one.map_from_robot = sighting.map_from_view * inverse(robot_from_view);
  const double angle_rad = one.map_from_robot.theta_rad + seen.bearing_rad;
  const Vector2 along(std::cos(angle_rad), std::sin(angle_rad));
  const Vector2 across(-along.y(), along.x());
  const double along_m = 0.35 * distance_m + sighting.spread_m;
  const double across_m = 1.5 * config.bearing_rad * distance_m + sighting.spread_m;
  one.covariance.setZero();
  one.covariance.topLeftCorner<2, 2>() =
      along_m * along_m * along * along.transpose() + across_m * across_m * across * across.transpose();
  one.covariance(2, 2) = 4.0 * config.turn_rad * config.turn_rad;
  return one;
}

}  // namespace homeward::driving
