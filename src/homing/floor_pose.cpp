// SPDX-License-Identifier: Apache-2.0
#include "homing/floor_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <random>

namespace homeward::homing {
namespace {

/// A point in the robot's frame.
Eigen::Vector3d in_robot(const Pose2& pose, const Eigen::Vector3d& point_m) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  const double dx = point_m.x() - pose.x_m;
  const double dy = point_m.y() - pose.y_m;
  return {c * dx + s * dy, -s * dx + c * dy, point_m.z()};
}

double off_rad(const Pose2& pose, const PointSighting& sighting) {
  const Eigen::Vector3d seen = in_robot(pose, sighting.point_m);
  return std::atan2(seen.cross(sighting.here).norm(), seen.dot(sighting.here));
}

/// Truncated squares: what RANSAC minimises (MSAC).
double cost_of(const Pose2& pose, std::span<const PointSighting> sightings, double limit_rad) {
  double cost = 0.0;
  for (const PointSighting& sighting : sightings) {
    const double off = std::min(off_rad(pose, sighting), limit_rad);
    cost += off * off;
  }
  return cost;
}

/// Gauss-Newton with Cauchy weights; the information of the last step.
Eigen::Matrix3d refine(Pose2& pose, std::span<const PointSighting> sightings, double spread_rad, double limit_rad) {
  constexpr int kSteps = 8;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    information.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    const double c = std::cos(pose.theta_rad);
    const double s = std::sin(pose.theta_rad);
    for (const PointSighting& sighting : sightings) {
      const Eigen::Vector3d seen = in_robot(pose, sighting.point_m);
      const double distance_m = std::max(seen.norm(), 1e-6);
      const Eigen::Vector3d unit = seen / distance_m;
      const Eigen::Vector3d residual = unit - sighting.here;
      const double off = residual.norm();
      if (off > 3.0 * limit_rad) continue;
      const double weight = 1.0 / (1.0 + (off * off) / (4.0 * spread_rad * spread_rad));
      Eigen::Matrix3d moved;  // of the point in the robot's frame, by x, y, theta
      moved << -c, -s, seen.y(), s, -c, -seen.x(), 0.0, 0.0, 0.0;
      const Eigen::Matrix3d jacobian = (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / distance_m * moved;
      information += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() * residual;
    }
    const Eigen::Vector3d change = -(information + 1e-9 * Eigen::Matrix3d::Identity()).ldlt().solve(gradient);
    if (!change.allFinite()) break;
    pose = {pose.x_m + change.x(), pose.y_m + change.y(), wrap_angle(pose.theta_rad + change.z())};
    if (change.norm() < 1e-6) break;
  }
  return information / (spread_rad * spread_rad);
}

/// The pose on the floor nearest to a pose in space; nothing where that one leans or floats too much.
std::optional<Pose2> upright(const opengv::transformation_t& pose) {
  constexpr double kLean = 0.98;  // cosine of the tilt
  constexpr double kFloat_m = 0.4;
  if (!pose.allFinite() || pose(2, 2) < kLean || std::abs(pose(2, 3)) > kFloat_m) return std::nullopt;
  return Pose2{pose(0, 3), pose(1, 3), std::atan2(pose(1, 0), pose(0, 0))};
}

}  // namespace

std::optional<FloorPose> floor_pose(std::span<const PointSighting> sightings, const std::optional<Pose2>& expected,
                                    const FloorPoseConfig& config, std::uint64_t seed) {
  constexpr std::size_t kFewest = 3;
  if (sightings.size() < kFewest) return std::nullopt;
  const double search_rad = 1.5 * config.inlier_rad;
  std::optional<Pose2> best;
  double least = 0.0;
  const auto consider = [&](Pose2 pose) {
    const double cost = cost_of(pose, sightings, search_rad);
    if (best && cost >= least) return;
    best = pose;
    least = cost;
  };
  if (expected) {
    Pose2 refined = *expected;
    refine(refined, sightings, config.bearing_spread_rad, 4.0 * config.inlier_rad);
    consider(refined);
  }
  opengv::bearingVectors_t here;
  opengv::points_t points;
  for (const PointSighting& sighting : sightings) {
    here.push_back(sighting.here);
    points.push_back(sighting.point_m);
  }
  opengv::absolute_pose::CentralAbsoluteAdapter adapter(here, points);
  std::mt19937_64 random(seed);
  const int count = static_cast<int>(sightings.size());
  // Where most agree with what was expected, nothing else can win.
  const double chance = static_cast<double>(count) * search_rad * search_rad;
  const int rounds = best && least < 0.25 * chance ? 0 : config.ransac_rounds;
  for (int round = 0; round < rounds; ++round) {
    std::vector<int> sample;
    while (sample.size() < kFewest) {
      const int pick = static_cast<int>(random() % static_cast<std::uint64_t>(count));
      if (std::ranges::find(sample, pick) == sample.end()) sample.push_back(pick);
    }
    for (const opengv::transformation_t& pose : opengv::absolute_pose::p3p_kneip(adapter, sample)) {
      if (const auto standing = upright(pose)) consider(*standing);
    }
  }
  if (!best) return std::nullopt;
  FloorPose result;
  result.map_from_robot = *best;
  const Eigen::Matrix3d information =
      refine(result.map_from_robot, sightings, config.bearing_spread_rad, config.inlier_rad);
  for (int i = 0; i < count; ++i) {
    if (off_rad(result.map_from_robot, sightings[static_cast<std::size_t>(i)]) < config.inlier_rad) {
      result.inliers.push_back(i);
    }
  }
  if (result.inliers.size() < kFewest) return std::nullopt;
  result.covariance = (information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  return result;
}

}  // namespace homeward::homing
