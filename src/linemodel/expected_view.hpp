// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.hpp"
#include "core/pose2.hpp"
#include "linemodel/hough_space.hpp"
#include "linemodel/plan.hpp"
#include "linemodel/sight_map.hpp"
#include "linemodel/visible_lines.hpp"

namespace homeward::linemodel {

/// A line that a plan lets expect from some pose.
struct ExpectedLine {
  HoughPoint point;
  float length_rad = 0.0F;  // of what the camera sees of it
  std::int32_t first = 0;   // of its cells in ExpectedView::cells
  std::int32_t count = 0;   // of directions along it that the camera sees
  std::int32_t index = 0;   // of the line among those around (VisibleLines::around)
};

/// What a plan lets a camera see from one pose.
struct ExpectedView {
  std::vector<ExpectedLine> lines;
  std::vector<std::int32_t> cells;  // of SightMap, along what is seen of each line; none if nobody asked for them
};

/// Puts the lines of a plan before a camera.
class Expectation {
 public:
  explicit Expectation(const camera::Camera& camera);

  /// Where the camera's centre is, over the floor of the plan, when the robot is at `robot`.
  [[nodiscard]] Eigen::Vector3d eye_m(const Pose2& robot) const;
  /// What is to be seen from `robot` of the lines around it; `view` is written over. Without cells it takes less time.
  void expect(const Pose2& robot, std::span<const PlanLine> around, ExpectedView& view, bool with_cells = true) const;

  [[nodiscard]] const HoughSpace& space() const { return space_; }

 private:
  Eigen::Vector3d robot_from_eye_m_;
  HoughSpace space_;
  SightMap sights_;
};

}  // namespace homeward::linemodel
