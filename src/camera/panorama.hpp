// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::camera {

/// The common working image: columns are azimuth, wrapping, forward in the centre and left on the left
/// (azimuth = -2 pi ((u + 0.5) / width - 0.5)); rows are linear in elevation, highest first, square pixels.
/// Ours: Goedemé 2007 §3 works on the radial lines of the mirror picture itself; here one image serves every camera.
struct PanoramaGeometry {
  int width_px = 1024;
  double elevation_max_rad = 0.34;
  double elevation_min_rad = -0.95;

  [[nodiscard]] int height_px() const;
  [[nodiscard]] Eigen::Vector3d bearing(const Eigen::Vector2d& pixel_px) const;        // unit, robot frame
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d& bearing_in_robot) const;  // u in [-0.5, width - 0.5)
};

struct Panorama {
  PanoramaGeometry geometry;
  Image rgb;                        // height x width x 3
  std::vector<std::uint8_t> valid;  // height x width, 1 = seen by the camera
};

/// Unwraps pictures of one camera; the look-up tables are computed once.
class PanoramaUnwrapper {
 public:
  PanoramaUnwrapper(const Camera& camera, const PanoramaGeometry& geometry);
  ~PanoramaUnwrapper();
  PanoramaUnwrapper(PanoramaUnwrapper&&) noexcept;
  PanoramaUnwrapper& operator=(PanoramaUnwrapper&&) noexcept;

  /// A grey picture (one channel) gives three equal bands. Errors: kEmptyInput (no pixels), kWrongImageSize when
  /// `picture` does not have the camera's size, kInvalidInput when its pixels do not fit its own size.
  [[nodiscard]] Result<Panorama> unwrap(const Image& picture) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace homeward::camera
