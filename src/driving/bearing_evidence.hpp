// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "homing/home_vector.hpp"

namespace homeward::driving {

/// Where a view lies by the answers to it, frame of odometry.
struct TriangulatedView {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
  double heading_rad = 0.0;
  double support = 0.0;  // of the bearings that agree, by their weights
};

/// Where a view lies of which so little is recognised that bearings alone say it. From far off single answers are
/// turned round or of another thing now and then, and so are several in a row; right ones agree on the view's heading
/// and meet in one spot. So each answer is evidence, and the spot and heading that most agree on count: a robust
/// triangulation of bearings over odometry.
/// Ours: docs/experiments/homing_to_one_view.md.
class BearingEvidence {
 public:
  /// `sure`: not a mere hint (homing::uncertain_home_vector). `guess_m`: how far the view may be, as this answer says.
  void add(const Pose2& robot, const homing::HomeVector& answer, bool sure, double guess_m);

  /// What most bearings agree on; nothing while they are too few or too divided. `undecided`: however few and divided.
  [[nodiscard]] std::optional<TriangulatedView> best(bool undecided = false) const;

  /// The bearings that do not agree with a view that was looked for where these say, and not found.
  [[nodiscard]] BearingEvidence without(const TriangulatedView& view) const;

  /// Whether an answer is one of those that agree with where the view is by `best`.
  [[nodiscard]] static bool agrees(const TriangulatedView& view, const Pose2& robot, const homing::HomeVector& answer);

  [[nodiscard]] bool empty() const { return observations_.empty(); }
  void clear() { observations_.clear(); }

 private:
  struct Observation {
    Eigen::Vector2d from_m;
    double bearing_rad;  // frame of odometry
    double heading_rad;  // of the view, frame of odometry
    double weight;
    double guess_m;
  };
  struct Hypothesis {
    Eigen::Vector2d position_m;
    double heading_rad;
    double support;
  };
  /// What most bearings agree on but for those `taken`.
  [[nodiscard]] std::optional<Hypothesis> most_agreed(const std::vector<bool>& taken) const;
  [[nodiscard]] static double agreement(const Observation& observation, const Eigen::Vector2d& position_m,
                                        double heading_rad);
  [[nodiscard]] TriangulatedView refined(const Eigen::Vector2d& position_m, double heading_rad, double guess_m) const;

  std::vector<Observation> observations_;  // oldest first
};

}  // namespace homeward::driving
