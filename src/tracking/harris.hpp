// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::tracking {

struct HarrisConfig {
  int most = 200;           // corners
  double spacing_px = 8.0;  // none is nearer to another one
  int cells_across = 8;     // of the grid over the picture
  int cells_down = 6;
  double cells_share = 2.0;      // a cell holds at most so many times its even share of `most`; 0: as many as there are
  int margin_px = 9;             // from the border: half a tracker's window and its gradient
  int window_px = 5;             // side of the square over which gradients are summed, odd
  double sensitivity = 0.04;     // k of Harris and Stephens 1988
  double least_strength = 50.0;  // (grey levels a pixel)^4
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const HarrisConfig& config);

struct Corner {
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();  // whole pixels
  double strength = 0.0;  // determinant less `sensitivity` times the squared trace of the mean gradient matrix
};

/// The strongest corners of a picture's finest level, strongest first, spread by spacing and cells, and as far as
/// spacing_px from `occupied_px`, such as features that are being tracked. Method: Harris and Stephens 1988.
/// Errors: kInvalidInput with the first of `problems`. A plain picture has none, which is no error.
Result<std::vector<Corner>> harris_corners(const ImagePyramid& picture, const HarrisConfig& config,
                                           std::span<const Eigen::Vector2d> occupied_px = {});

}  // namespace homeward::tracking
