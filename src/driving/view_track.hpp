// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose2.hpp"
#include "homing/home_vector.hpp"

namespace homeward::driving {

struct ViewTrackConfig {
  double metres_per_parallax =
      4.0;                    // rough depth of rooms: how far a view is for its parallax; along corridors far off
  double drift_per_m = 0.03;  // of odometry
  double gate = 3.5;          // standard deviations beyond which an answer contradicts what is known
};

/// Where one view lies in the frame of odometry: bearings from several poses, triangulated as they come (a bearing-only
/// Kalman filter). Depth comes from the map's edges, from bearings that turn as the robot drives, and,
/// where nothing else is known, as a first guess from the parallax.
/// Aidala, Kalman filter behavior in bearings-only tracking applications (1979).
class ViewTrack {
 public:
  [[nodiscard]] bool known() const { return known_; }
  /// Precondition of all below: known().
  [[nodiscard]] const Eigen::Vector2d& position_m() const { return position_m_; }
  [[nodiscard]] double heading_rad() const { return heading_rad_; }
  /// Standard deviation of the position, larger axis.
  [[nodiscard]] double doubt_m() const;

  /// Whether an answer may be true by what is known.
  [[nodiscard]] bool agrees(const Pose2& robot, const homing::HomeVector& answer, const ViewTrackConfig& config) const;

  /// Takes a fresh answer into account; false when it contradicts what is known and is passed over. A view that is
  /// contradicted three times in a row starts anew from the last answer.
  bool observe(const Pose2& robot, const homing::HomeVector& answer, const ViewTrackConfig& config);

  /// Takes over where the view lies from what has weighed all pictures of it already (homing/visual_homing.hpp).
  void settle(const Eigen::Vector2d& position_m, const Eigen::Matrix2d& covariance_m2, double heading_rad);

  /// The robot drove on: odometry has drifted.
  void drift(double driven_m, const ViewTrackConfig& config);

  [[nodiscard]] const Eigen::Matrix2d& covariance_m2() const { return covariance_m2_; }

 private:
  /// What a bearing says against what is known.
  struct Innovation {
    Eigen::Vector2d across = Eigen::Vector2d::Zero();  // the direction in which it says anything
    double apart_m = 0.0;                              // robot and view, as it is known
    double off_m = 0.0;                                // along `across`
    double doubt_m = 0.0;                              // of the bearing alone
    bool contradicts = false;
  };
  [[nodiscard]] Innovation compare(const Pose2& robot, const homing::HomeVector& answer,
                                   const ViewTrackConfig& config) const;
  void measure(const Eigen::Vector2d& axis, double off_m, double doubt_m);
  void begin(const Pose2& robot, const homing::HomeVector& answer, double distance_m);

  bool known_ = false;
  int contradictions_ = 0;
  Eigen::Vector2d position_m_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2_ = Eigen::Matrix2d::Identity();
  double heading_rad_ = 0.0;
};

}  // namespace homeward::driving
