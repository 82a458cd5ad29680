// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/pose2.hpp"
#include "driving/pose_hypotheses_config.hpp"
#include "driving/pose_hypothesis.hpp"
#include "driving/view_sighting.hpp"

namespace homeward::driving {

/// Where a view lies by a hypothesis: in the robot's frame, with the covariance of its position there.
struct ExpectedView {
  Pose2 robot_from_view;
  double distance_m = 0.0;
  Eigen::Matrix2d covariance_m2;
};
ExpectedView expected_view(const PoseHypothesis& hypothesis, const ViewSighting& sighting);

/// What a local map says as a measurement of the robot's own pose.
struct MeasuredPose {
  Pose2 map_from_robot;
  Eigen::Matrix3d covariance;
};
/// Precondition: the sighting has a pose.
MeasuredPose measured_pose(const ViewSighting& sighting, const PoseHypothesesConfig& config);

/// From one pose to another: metres and metres in the frame of the map, radians within a half turn.
Eigen::Vector3d difference(const Pose2& to, const Pose2& from);

/// A measurement against what is expected: its squared difference, in standard deviations, 50 at most.
/// Mahalanobis distance, as in the gate of a Kalman filter.
double disagreement(const PoseHypothesis& hypothesis, const ExpectedView& view, const SightedDirection& seen,
                    const PoseHypothesesConfig& config);
/// By the sighting's pose, or where it has none by its direction. Precondition: it has one of them.
double disagreement(const PoseHypothesis& hypothesis, const ViewSighting& sighting, const PoseHypothesesConfig& config);

/// A robot that sees a view so far away in its direction. Precondition: the sighting has a direction.
PoseHypothesis begun_at(const ViewSighting& sighting, double distance_m, const PoseHypothesesConfig& config);

}  // namespace homeward::driving
