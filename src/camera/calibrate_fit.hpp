// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "camera/calibration_input.hpp"

namespace homeward::camera {

// The numbers behind `calibrate`: one least-squares fit of a camera and of the board's pose in each view.

/// Camera from board: the board's plane is z = 0.
struct BoardPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

struct CameraFit {
  CameraModel model;
  std::vector<BoardPose> poses;
  std::vector<std::vector<Eigen::Vector2d>> predicted_px;
  std::vector<double> view_rms_px;
  double rms_px = 0.0;
  double focal_deviation = 0.0;  // relative, of the focal length at the middle: fx, fy, for the unified model by 1 + xi
  Eigen::VectorXd deviations;    // of the parameters in the order of `parameters_of`; infinite where nothing holds them
};

/// fx fy cx cy, for the unified model xi, then the distortion.
Eigen::VectorXd parameters_of(const CameraModel& model);
std::vector<std::string> parameter_names(CalibratedModel model);

/// The pose of a board for a known camera: the plane-induced homography between board and bearings, which holds for
/// every central camera (linear, then made a rotation by its singular values). Nothing when the camera does not see a
/// corner or the corners lie on a line.
/// Zhang (2000), §2 and §3.1, with bearings in place of pixels.
std::optional<BoardPose> pose_of_board(const CameraModel& model, const std::vector<Eigen::Vector2d>& board_m,
                                       const std::vector<Eigen::Vector2d>& corners_px);

/// A camera without distortion whose focal length suits the views best, out of a wide range. Nothing when no focal
/// length poses at least half of the views.
/// A search, and ours: one for all models.
std::optional<CameraModel> first_guess(const CalibrationInput& input, const std::vector<BoardView>& views);

/// Levenberg-Marquardt over intrinsics and poses, the poses eliminated view by view (Schur complement); first without,
/// then with the distortion. Nothing when a view cannot be posed with `start` or the fit breaks down.
/// Triggs, McLauchlan, Hartley & Fitzgibbon, Bundle adjustment: a modern synthesis (2000), §6.1.
std::optional<CameraFit> fit_camera(const CameraModel& start, const BoardGeometry& board,
                                    const std::vector<BoardView>& views);

}  // namespace homeward::camera
