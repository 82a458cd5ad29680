// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "camera/board.hpp"
#include "camera/camera.hpp"
#include "core/image.hpp"

namespace homeward::testing {

/// Where a board hangs: seen in a direction of the robot frame, its face towards the camera but for the tilts.
struct HungBoard {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double distance_m = 0.5;
  double tilt_about_x_rad = 0.0;
  double tilt_about_y_rad = 0.0;
  double roll_rad = 0.0;
};

/// Robot from board: the board's middle in the direction asked for, its corners in the plane z = 0.
inline Eigen::Isometry3d pose_of(const HungBoard& hung, const camera::BoardGeometry& board) {
  const Eigen::Matrix3d towards = (Eigen::AngleAxisd(hung.azimuth_rad, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(-hung.elevation_rad, Eigen::Vector3d::UnitY()))
                                      .toRotationMatrix();
  Eigen::Matrix3d facing;  // the board's x to the right, y down, z away from the viewer
  facing << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Matrix3d tilted = (Eigen::AngleAxisd(hung.tilt_about_x_rad, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(hung.tilt_about_y_rad, Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(hung.roll_rad, Eigen::Vector3d::UnitZ()))
                                     .toRotationMatrix();
  const Eigen::Vector3d middle_m(0.5 * board.square_m * (board.cols - 1), 0.5 * board.square_m * (board.rows - 1), 0.0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = towards * facing * tilted;
  pose.translation() = towards * Eigen::Vector3d(hung.distance_m, 0.0, 0.0) - pose.linear() * middle_m;
  return pose;
}

/// The true pixels of all corners, or nothing when the camera does not see them all.
inline std::optional<std::vector<Eigen::Vector2d>> corners_of(const camera::Camera& camera,
                                                              const camera::BoardGeometry& board,
                                                              const Eigen::Isometry3d& robot_from_board) {
  std::vector<Eigen::Vector2d> corners_px;
  for (const Eigen::Vector2d& at_m : camera::corners_on_board_m(board)) {
    const auto pixel_px = camera.pixel((robot_from_board * Eigen::Vector3d(at_m.x(), at_m.y(), 0.0)).normalized());
    if (!pixel_px) return std::nullopt;
    corners_px.push_back(*pixel_px);
  }
  return corners_px;
}

inline void add_noise(std::vector<Eigen::Vector2d>& corners_px, double sigma_px, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, sigma_px);
  for (Eigen::Vector2d& at_px : corners_px) at_px += Eigen::Vector2d(noise(random), noise(random));
}

/// Grey picture of the board (a white border of one square around it) before a grey wall; 3 x 3 rays a pixel.
inline Image render_board(const camera::Camera& camera, const camera::BoardGeometry& board,
                          const Eigen::Isometry3d& robot_from_board) {
  constexpr int kRays = 3;
  const Eigen::Isometry3d board_from_robot = robot_from_board.inverse();
  const Eigen::Vector3d eye_m = board_from_robot.translation();
  Image picture(camera.config().width_px, camera.config().height_px, 1);
  const auto grey_of = [&](const Eigen::Vector2d& pixel_px) {
    const auto bearing = camera.bearing(pixel_px);
    if (!bearing) return 10.0;
    const Eigen::Vector3d along = board_from_robot.linear() * *bearing;
    const double distance_m = -eye_m.z() / along.z();
    if (!(distance_m > 0.0)) return 110.0;
    const Eigen::Vector3d at_m = eye_m + distance_m * along;
    const int col = static_cast<int>(std::floor(at_m.x() / board.square_m)) + 1;
    const int row = static_cast<int>(std::floor(at_m.y() / board.square_m)) + 1;
    if (col < -1 || row < -1 || col > board.cols + 1 || row > board.rows + 1) return 110.0;
    const bool on_board = col >= 0 && row >= 0 && col <= board.cols && row <= board.rows;
    return on_board && (col + row) % 2 == 0 ? 30.0 : 225.0;
  };
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      double sum = 0.0;
      for (int i = 0; i < kRays * kRays; ++i) {
        const Eigen::Vector2d within((i % kRays + 0.5) / kRays - 0.5, (i / kRays + 0.5) / kRays - 0.5);
        sum += grey_of(Eigen::Vector2d(u, v) + within);
      }
      *picture.at(u, v) = static_cast<std::uint8_t>(std::lround(sum / (kRays * kRays)));
    }
  }
  return picture;
}

}  // namespace homeward::testing
