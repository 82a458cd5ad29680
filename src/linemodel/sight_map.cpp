// SPDX-License-Identifier: Apache-2.0
#include "linemodel/sight_map.hpp"

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
}

}  // namespace homeward::linemodel
