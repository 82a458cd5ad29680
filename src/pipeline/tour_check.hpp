// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// Fewer pictures make no map.
inline constexpr std::size_t kFewestImages = 3;

/// Zero by zero: the picture could not be read.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

/// That all pictures that could be read have the camera's size. Error: kWrongImageSize, naming the first that has not
/// and how many others there are.
Status check_sizes(std::span<const map::MapImage> images, std::span<const PictureSize> sizes,
                   const camera::CameraConfig& camera);

/// That enough pictures are left after those that cannot be read. Errors: the first one's when there is none left,
/// kTooFewImages.
Status check_left(std::span<const Error> skipped, std::size_t left);

}  // namespace homeward::pipeline
