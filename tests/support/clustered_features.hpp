// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>

#include "features/appearance.hpp"

namespace homeward::testing {

/// Features with descriptors of 32 bytes about `centres` places of the descriptors' space (the same for every seed),
/// as those of pictures gather. Bearings all around, below, at and above
/// the horizon in turn.
inline features::FeatureSet clustered_features(int count, std::uint64_t seed, int centres = 50) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> spread(0.0, 12.0);
  features::FeatureSet set;
  set.bearings.setZero(count, 3);
  set.scales_rad.setConstant(count, 0.01F);
  set.descriptors.resize(count, 32);
  set.colours.setZero(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double azimuth_rad = 6.2831853 * static_cast<double>(i) / count;
    set.bearings.row(i) << static_cast<float>(std::cos(azimuth_rad)), static_cast<float>(std::sin(azimuth_rad)),
        0.3F * static_cast<float>(i % 3 - 1);
    set.bearings.row(i).normalize();
    std::mt19937_64 centre(1000 + random() % static_cast<std::uint64_t>(centres));
    for (Eigen::Index d = 0; d < 32; ++d) {
      const double middle = 40.0 + static_cast<double>(centre() % 176);
      set.descriptors(i, d) = static_cast<std::uint8_t>(std::clamp(middle + spread(random), 0.0, 255.0));
    }
  }
  return set;
}

}  // namespace homeward::testing
