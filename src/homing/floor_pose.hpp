// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::homing {

/// A point in space and the direction in which the robot sees it.
struct PointSighting {
  Eigen::Vector3d point_m;  // in the map's frame
  Eigen::Vector3d here;     // robot frame, unit
};

struct FloorPoseConfig {
  double bearing_spread_rad = 0.005;
  double inlier_rad = 0.02;
  int ransac_rounds = 60;
};

struct FloorPose {
  Pose2 map_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // of x, y, theta
  std::vector<int> inliers;                                  // ascending
};

/// Where a robot on the floor stands when it sees points of a map so: three-point samples (Kneip et al. 2011, OpenGV),
/// turned upright, in RANSAC beside the pose that is expected; the best is refined with robust weights. Deterministic
/// by `seed`. Nothing where no pose has three inliers.
std::optional<FloorPose> floor_pose(std::span<const PointSighting> sightings, const std::optional<Pose2>& expected,
                                    const FloorPoseConfig& config, std::uint64_t seed);

}  // namespace homeward::homing
