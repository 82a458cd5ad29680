// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "camera/calibration_input.hpp"
#include "camera/camera_config.hpp"
#include "core/result.hpp"

namespace homeward::camera {

/// A view that served: what the calibrated camera predicts for each corner.
struct UsedView {
  std::size_t view = 0;  // index into the views given
  double rms_px = 0.0;
  std::vector<Eigen::Vector2d> predicted_px;
};

/// A view that did not, and why.
struct LeftOutView {
  std::size_t view = 0;
  std::string reason;
};

struct ParameterDeviation {
  std::string name;  // as camera.json names it
  double value = 0.0;
  double deviation = 0.0;  // one standard deviation, from the residuals
};

struct CalibrationResult {
  CameraConfig config;  // mounted as the caller said
  double rms_px = 0.0;  // distance of seen and predicted corner, over all corners of the views used
  std::vector<UsedView> used;
  std::vector<LeftOutView> left_out;
  std::vector<ParameterDeviation> parameters;
  std::vector<std::string> warnings;  // sentences: why these views may not determine the model
};

/// Intrinsics from views of a board. Starts from OpenCV's closed forms (Zhang 2000 for the pinhole, Kannala & Brandt
/// 2006 for the fisheye, Mei & Rives 2007 for the unified model) and ends with least squares over all corners
/// (Levenberg-Marquardt). Views that cannot be posed or fit far worse than the others are left out and named.
/// Errors: kInvalidInput (board, picture size, corners; fewer than 3 usable views; no camera fits).
Result<CalibrationResult> calibrate(const CalibrationInput& input, const std::vector<BoardView>& views);

}  // namespace homeward::camera
