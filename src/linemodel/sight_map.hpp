// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "camera/camera.hpp"

namespace homeward::linemodel {

/// The directions around a robot in cells of half a degree, azimuth by elevation, and which of them its camera sees.
class SightMap {
 public:
  static constexpr int kWidth = 720;   // cells around, counter-clockwise from ahead
  static constexpr int kHeight = 300;  // from 75 degrees below the horizon to 75 above, lowest first
  static constexpr float kCells_per_rad = 360.0F / 3.14159265F;
  static constexpr std::int32_t kNowhere = -1;

  explicit SightMap(const camera::Camera& camera);

  /// The cell of a direction (robot frame, any length), or kNowhere where the camera does not see it.
  [[nodiscard]] std::int32_t cell(const Eigen::Vector3f& direction) const {
    const std::int32_t index = cell_of(direction);
    return index == kNowhere || seen_[static_cast<std::size_t>(index)] == 0 ? kNowhere : index;
  }
  /// How many of `samples` (at most kMostSamples) directions spread evenly over the chord from one unit vector to
  /// another the camera sees. The same as asking `cell` of each, to a tenth of a cell.
  [[nodiscard]] int count_seen(const Eigen::Vector3f& from, const Eigen::Vector3f& to, int samples) const;
  static constexpr int kMostSamples = 12;
  /// The cell of a direction, whether the camera sees it or not; kNowhere far above and below.
  [[nodiscard]] static std::int32_t cell_of(const Eigen::Vector3f& direction);

 private:
  void find_ring();

  std::vector<std::uint8_t> seen_;  // kHeight x kWidth
  bool ring_ = false;               // what it sees is the same all around, between two elevations: ...
  float least_slope_ = 0.0F;        // ... their tangents
  float most_slope_ = 0.0F;
};

/// atan2 to 2e-4 rad, for what is counted in cells (ours: a polynomial of the ratio of the smaller to the larger).
inline float rough_atan2(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float most = std::max(ax, ay);
  if (most == 0.0F) return 0.0F;
  const float ratio = std::min(ax, ay) / most;
  const float square = ratio * ratio;
  float angle = ((-0.0464964749F * square + 0.15931422F) * square - 0.327622764F) * square * ratio + ratio;
  if (ay > ax) angle = 1.57079637F - angle;
  if (x < 0.0F) angle = 3.14159274F - angle;
  return y < 0.0F ? -angle : angle;
}

inline std::int32_t SightMap::cell_of(const Eigen::Vector3f& direction) {
  const float level = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  const float up = rough_atan2(direction.z(), level) * kCells_per_rad + 0.5F * kHeight;
  if (!(up >= 0.0F && up < static_cast<float>(kHeight))) return kNowhere;
  const float turn = rough_atan2(direction.y(), direction.x()) * kCells_per_rad;
  const auto around = static_cast<std::int32_t>(turn < 0.0F ? turn + static_cast<float>(kWidth) : turn);
  return static_cast<std::int32_t>(up) * kWidth + std::min(around, kWidth - 1);
}

}  // namespace homeward::linemodel
