// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "core/image.hpp"
#include "sim/generate/colour.hpp"
#include "sim/random.hpp"

namespace homeward::sim {

/// Something to paint on. Coordinates in pixels, u to the right, v down.
class Canvas {
 public:
  Canvas(int width_px, int height_px, Rgb ground);

  void rectangle(double u0, double v0, double u1, double v1, Rgb colour);
  void frame(double u0, double v0, double u1, double v1, Rgb colour, int thickness);
  void line(double u0, double v0, double u1, double v1, Rgb colour, int thickness);
  void ellipse(double u, double v, double radius_u, double radius_v, double angle_rad, Rgb colour);
  void polygon(const std::vector<Eigen::Vector2d>& corners, Rgb colour);
  /// From the first colour at v0 to the second at v1.
  void fade(double v0, double v1, Rgb above, Rgb below);
  /// Fine streaks along u.
  void grain(Random& random, double u0, double v0, double u1, double v1, Rgb base, int streaks);
  /// Soft lighter and darker patches of `levels` standard deviation.
  void clouds(Random& random, double levels);
  /// The picture with fine noise of `levels` over it.
  [[nodiscard]] Image finished(Random& random, double levels) const;

  [[nodiscard]] int width_px() const { return pixels_.cols; }
  [[nodiscard]] int height_px() const { return pixels_.rows; }

 private:
  cv::Mat pixels_;  // 8UC3, red first
};

}  // namespace homeward::sim
