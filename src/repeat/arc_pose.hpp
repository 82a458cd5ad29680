// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "geometry/epipolar_px.hpp"
#include "geometry/seen_point.hpp"
#include "repeat/arc_surroundings.hpp"

namespace homeward::repeat {

/// Where the camera is in the frame of an arc's surroundings.
struct ArcPose {
  Eigen::Matrix3d local_from_current = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// A landmark in the current picture.
struct SeenLandmark {
  Landmark landmark;
  geometry::SeenPoint seen;
};

/// A landmark as it should be seen from a pose.
struct Expected {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitX();  // unit, in the current frame
  double distance = 1.0;    // over that from the first key image; both infinite for what is as far as the sky
  double spread_rad = 0.0;  // by how little its distance is known
};
Expected expected_at(const ArcPose& pose, const Landmark& landmark);

struct PoseFitConfig {
  double seen_spread_px = 0.5;  // of where a tracked feature is
  double agree_rad = 0.013;     // a feature agrees within so much and 2.5 times what its distance leaves open: 3 px of
                                // 320 over 70 degrees
  double most_open_rad = 0.03;  // at most so much of that
  double stray_share = 0.3;     // standard deviation of the position from the start, over the landmarks' distance
  std::optional<geometry::DrivingPrior> driving;  // its tilt, and that the camera keeps its height
};

struct PoseFit {
  ArcPose pose;
  std::vector<double> off_px;  // of each landmark from where it should be seen
  std::vector<bool> agrees;
  int agreeing = 0;
  double error_px = 0.0;   // root mean square of off_px as its median tells it, wrong ones included
  double error_rad = 0.0;  // about the same as an angle
};

/// The pose from which landmarks are seen where they are: the views of the current picture and of both key images by
/// the structure that they share. Robust Gauss-Newton steps from `start` (Geman and McClure 1987). Without a unit only
/// the turn is found. Precondition: there is a landmark.
PoseFit fit_pose(std::span<const SeenLandmark> seen, const ArcSurroundings& around, const ArcPose& start,
                 const PoseFitConfig& config);

/// How landmarks agree with a pose as it is.
PoseFit judge_pose(std::span<const SeenLandmark> seen, const ArcPose& pose, const PoseFitConfig& config);

}  // namespace homeward::repeat
