// SPDX-License-Identifier: Apache-2.0
#include "sim/sky.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::sim {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour kDayZenith{0.42F, 0.62F, 1.0F};
constexpr Colour kDayHorizon{0.95F, 1.02F, 1.12F};
constexpr Colour kDuskHorizon{1.25F, 0.95F, 0.66F};
constexpr Colour kNight{0.0022F, 0.0026F, 0.0040F};
constexpr Colour kSun{3.4F, 2.9F, 2.1F};
constexpr float kDusk = 0.1F;  // where the horizon is warmest

}  // namespace

Eigen::Array3f radiance(const SkyLight& sky, const Eigen::Vector3f& direction) {
  const Eigen::Map<const Eigen::Array3f> zenith(sky.zenith.data());
  const Eigen::Map<const Eigen::Array3f> horizon(sky.horizon.data());
  const Eigen::Map<const Eigen::Array3f> sun(sky.sun.data());
  const float up = std::sqrt(std::max(0.0F, direction.z()));
  const float towards = std::max(0.0F, direction.dot(Eigen::Map<const Eigen::Vector3f>(sky.to_sun.data())));
  const float squared = towards * towards;
  const float fourth = squared * squared;
  return horizon + up * (zenith - horizon) + fourth * fourth * sun;
}

float daylight_in(const Light& light) {
  constexpr float kHalf = 0.24F;  // what `half` leaves of the daylight through windows
  if (light.is_between()) return static_cast<float>(light.level());
  if (light.preset() == LightPreset::kDay) return 1.0F;
  return light.preset() == LightPreset::kHalf ? kHalf : 0.0F;
}

SkyLight sky_light(const Sky& sky, float daylight) {
  SkyLight light;
  const float warm = std::clamp(1.0F - std::abs(daylight - kDusk) / 0.3F, 0.0F, 1.0F);
  for (std::size_t band = 0; band < 3; ++band) {
    light.zenith[band] = kNight[band] + daylight * kDayZenith[band];
    light.horizon[band] = kNight[band] + daylight * std::lerp(kDayHorizon[band], kDuskHorizon[band], warm);
    light.sun[band] = daylight * daylight * kSun[band];
  }
  // It stands low when there is little light.
  const float elevation_rad = static_cast<float>(radians(6.0)) + daylight * static_cast<float>(radians(36.0));
  const auto azimuth_rad = static_cast<float>(sky.sun_azimuth_rad);
  light.to_sun = {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
                  std::sin(elevation_rad)};
  return light;
}

}  // namespace homeward::sim
