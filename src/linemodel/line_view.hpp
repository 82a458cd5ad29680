// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::linemodel {

/// A perspective view cut out of a camera's picture, in which straight edges of the building are straight.
struct LineView {
  Eigen::Matrix3d robot_from_view = Eigen::Matrix3d::Identity();  // view: x right, y down, z ahead
  double focal_px = 0.0;                                          // both ways
  double cx_px = 0.0;
  double cy_px = 0.0;
  int width_px = 0;
  int height_px = 0;

  /// The direction (robot frame, not of unit length) that a pixel of the view sees.
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector2d& pixel_px) const {
    return robot_from_view * Eigen::Vector3d((pixel_px.x() - cx_px) / focal_px, (pixel_px.y() - cy_px) / focal_px, 1.0);
  }
};

/// One picture seen through all views of its camera: grey, with what the camera does not see marked.
struct SeenView {
  const LineView* view = nullptr;
  Image grey;                      // view's height x width x 1
  std::vector<std::uint8_t> seen;  // height x width, 1 = the camera sees the world there
};

/// Cuts pictures of one camera into perspective views; the look-up tables are computed once. A pinhole gives one view,
/// its own picture without distortion; every other camera a ring of them that covers what it sees around. Ours.
class LineViews {
 public:
  /// `views`: in the ring of a camera that sees all around.
  explicit LineViews(const camera::Camera& camera, int views = 6);
  ~LineViews();
  LineViews(LineViews&&) noexcept;
  LineViews& operator=(LineViews&&) noexcept;

  [[nodiscard]] const std::vector<LineView>& views() const;
  /// Errors: kEmptyInput (no pixels), kWrongImageSize (not the camera's).
  [[nodiscard]] Result<std::vector<SeenView>> look(const Image& picture) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace homeward::linemodel
