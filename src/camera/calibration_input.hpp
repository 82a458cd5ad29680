// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "camera/board.hpp"
#include "camera/camera_config.hpp"

namespace homeward::camera {

/// The models that `calibrate` can fit.
enum class CalibratedModel { kMei, kFisheye, kPinhole };

/// One picture of the board: the corners as `find_board` gives them.
struct BoardView {
  std::string name;
  std::vector<Eigen::Vector2d> corners_px;
};

/// What is known of the camera beforehand.
struct CalibrationInput {
  CalibratedModel model = CalibratedModel::kMei;
  bool mirror = false;  // the unified model of a mirror: fy_px comes out negative (see `Mei`); flat boards cannot tell
  BoardGeometry board;
  CameraConfig camera;  // picture size and mounting; its model is not looked at
};

}  // namespace homeward::camera
