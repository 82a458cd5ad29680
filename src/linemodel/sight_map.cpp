// SPDX-License-Identifier: Apache-2.0
#include "linemodel/sight_map.hpp"

#include <algorithm>
#include <cstddef>

#include "core/angles.hpp"
#include "core/index.hpp"

namespace homeward::linemodel {

SightMap::SightMap(const camera::Camera& camera) : seen_(at(kWidth) * at(kHeight)) {
  for (int up = 0; up < kHeight; ++up) {
    const double elevation = radians((up + 0.5) * 0.5 - 0.25 * kHeight);
    for (int around = 0; around < kWidth; ++around) {
      const double azimuth = radians((around + 0.5) * 0.5);
      const Eigen::Vector3d bearing(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                    std::sin(elevation));
      seen_[at(up) * at(kWidth) + at(around)] = camera.pixel(bearing).has_value() ? 1 : 0;
    }
  }
  find_ring();
}

void SightMap::find_ring() {
  int first = kHeight;
  int last = -1;
  ring_ = true;
  for (int up = 0; up < kHeight; ++up) {
    const auto row = seen_.begin() + static_cast<std::ptrdiff_t>(up) * kWidth;
    const auto count = std::count(row, row + kWidth, std::uint8_t{1});
    if (count != 0 && count != kWidth) ring_ = false;
    if (count != kWidth) continue;
    if (last >= 0 && up != last + 1) ring_ = false;
    first = std::min(first, up);
    last = up;
  }
  if (last < 0) ring_ = false;
  const auto slope = [](int up) { return static_cast<float>(std::tan(radians(up * 0.5 - 0.25 * kHeight))); };
  least_slope_ = slope(first);
  most_slope_ = slope(last + 1);
}

int SightMap::count_seen(const Eigen::Vector3f& from, const Eigen::Vector3f& to, int samples) const {
  const float step = 1.0F / static_cast<float>(samples);
  int count = 0;
  if (!ring_) {
    for (int k = 0; k < samples; ++k) {
      const float share = (static_cast<float>(k) + 0.5F) * step;
      if (cell((1.0F - share) * from + share * to) != kNowhere) ++count;
    }
    return count;
  }
  const Eigen::Vector3f way = to - from;
  for (int k = 0; k < kMostSamples; ++k) {  // all of them, as such a loop is done four at a time
    const float share = (static_cast<float>(k) + 0.5F) * step;
    const float x = from.x() + share * way.x();
    const float y = from.y() + share * way.y();
    const float z = from.z() + share * way.z();
    const float level = std::sqrt(x * x + y * y);
    count += static_cast<int>(k < samples) & static_cast<int>(z >= least_slope_ * level) &
             static_cast<int>(z < most_slope_ * level);
  }
  return count;
}

}  // namespace homeward::linemodel
