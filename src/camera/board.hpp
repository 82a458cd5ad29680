// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::camera {

/// A flat chessboard: its inner corners (where four squares meet) and the side of a square.
struct BoardGeometry {
  int cols = 0;
  int rows = 0;
  double square_m = 0.0;
};

/// All problems of a board's description, empty when it is valid: at least 3 x 3 corners, squares larger than nothing.
std::vector<std::string> problems(const BoardGeometry& board);

/// The corners on the board, row after row, in metres.
std::vector<Eigen::Vector2d> corners_on_board_m(const BoardGeometry& board);

/// The pixels of all inner corners, row after row in the order of `corners_on_board_m` (a board that looks the same
/// when turned may be turned). Duda & Frese, "Accurate detection and localization of checkerboard corners for
/// calibration" (2018), and where that fails the quadrangle linking of Rufli, Scaramuzza & Siegwart (2008), each on the
/// picture as it is, with its contrast evened out, and at twice the size; refined by the gradients around each corner
/// (Förstner & Gülch 1987).
/// Errors: kInvalidInput (board), kEmptyInput (no picture), kTooLittleSupport (no whole board in the picture).
Result<std::vector<Eigen::Vector2d>> find_board(const Image& picture, int cols, int rows);

}  // namespace homeward::camera
