// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "camera/panorama.hpp"

namespace homeward::tracking {

struct TrackConfig {
  int window_px = 15;            // side of the patch that is compared
  int levels = 3;                // of the pyramid, over the finest
  int iterations = 20;           // on each level
  double least_contrast = 1e-3;  // least eigenvalue of a patch's gradients, per pixel: less cannot be tracked
  double most_return_px = 0.6;   // a point tracked back must come so near to where it began
};

/// Where a point of one picture lies in the next one.
struct TrackedPoint {
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();  // of the panorama
  bool found = false;
};

/// One panorama made ready for tracking: grey, its seam closed, a pyramid. Copies share it.
class TrackingFrame {
 public:
  /// No picture: has_value() is false.
  TrackingFrame() = default;
  explicit TrackingFrame(const camera::Panorama& panorama);

  [[nodiscard]] bool has_value() const { return parts_ != nullptr; }
  /// Preconditions of all below: has_value().
  [[nodiscard]] const camera::PanoramaGeometry& geometry() const;
  /// The patch of a side (odd) around a point, rows from the top; empty where it is not in the picture.
  [[nodiscard]] std::vector<std::uint8_t> patch(const Eigen::Vector2d& pixel_px, int side_px) const;

  /// Where a patch of `window_px` can be tracked best within `within_px` (1 to 20) of a point: the pixel whose patch's
  /// gradients have the largest least eigenvalue (Shi and Tomasi 1994, OpenCV's cornerMinEigenVal). The point itself
  /// where none is any better, or where it is not in the picture.
  [[nodiscard]] Eigen::Vector2d strongest_corner(const Eigen::Vector2d& pixel_px, int within_px, int window_px) const;

  /// Where points of this frame are in another one, looked for from guesses (Lucas-Kanade with pyramids, Bouguet 2000,
  /// OpenCV's), each checked by tracking it back. Points may cross the seam. As many as `points_px`.
  [[nodiscard]] std::vector<TrackedPoint> track_into(const TrackingFrame& next,
                                                     std::span<const Eigen::Vector2d> points_px,
                                                     std::span<const Eigen::Vector2d> guesses_px,
                                                     const TrackConfig& config) const;

  /// Where a patch that was seen before is, near a guess (normalised correlation); nothing where nothing looks like it.
  [[nodiscard]] TrackedPoint find(std::span<const std::uint8_t> patch, int side_px, const Eigen::Vector2d& guess_px,
                                  int search_px, double least_correlation) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace homeward::tracking
