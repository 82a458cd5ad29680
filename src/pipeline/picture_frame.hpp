// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// What of a picture tells its camera and not its place: the pixels that the camera's model calls blind (outside of the
/// mirror's ring), which stay as they are while the robot drives; and whether its four corners are black around a
/// picture that is not, as a mirror's or a fisheye's are.
struct PictureFrame {
  std::vector<std::uint8_t> blind;  // grey values; empty when the camera sees everywhere or the picture was not read
  bool black_corners = false;
  bool read = false;
};

/// Takes the frame of pictures of one camera's size.
class FrameSampler {
 public:
  explicit FrameSampler(const camera::Camera& camera);
  /// Precondition: the picture has the camera's size.
  [[nodiscard]] PictureFrame sample(const Image& picture) const;

 private:
  std::vector<Eigen::Vector2i> blind_px_;
};

/// That all pictures were taken by one camera, as far as their frames tell. It is blind to two cameras of the same size
/// that both see in all corners. Error: kInvalidInput, naming the first picture of the other camera.
/// Ours, because features of two cameras do not compare.
Status check_one_camera(std::span<const map::MapImage> images, std::span<const PictureFrame> frames);

}  // namespace homeward::pipeline
