// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"
#include "linemodel/line_view.hpp"

namespace homeward::linemodel {

/// A straight edge seen in a picture. Directions are unit vectors in the robot frame, from the camera's centre.
struct ImageLine {
  Eigen::Vector3d from = Eigen::Vector3d::UnitX();
  Eigen::Vector3d to = Eigen::Vector3d::UnitX();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // of the plane through the camera's centre; its sign says nothing
  double length_rad = 0.0;                            // of its arc
};

struct LineDetection {
  double least_length_rad = 0.10;  // 6 degrees: shorter ones say little of how they lie
};

/// The straight edges of a picture: line segments by the detector of Grompone von Gioi et al. (2010) in each
/// perspective view of the camera. What lies along the border of what the camera sees is no edge of the building and
/// left out. Errors: those of LineViews::look.
Result<std::vector<ImageLine>> detect_lines(const Image& picture, const LineViews& views, const LineDetection& config);

}  // namespace homeward::linemodel
