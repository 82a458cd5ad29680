// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace homeward::sim {

/// Light to grey levels of 255: a soft shoulder above, then the sRGB curve (ours). From a table over the root of the
/// light, right to a hundredth of a level: each pixel asks three times.
class DisplayCurve {
 public:
  static constexpr float kBrightest = 3.5F;  // root of the light; e^-12 short of white
  static constexpr float kSteps = 512.0F;    // of the table, for each unit of the root

  DisplayCurve();
  /// The level of a linear light, not negative.
  [[nodiscard]] float level(float light) const;
  /// Entry i: the level of the light whose root is i / kSteps.
  [[nodiscard]] const float* table() const { return levels_.data(); }

 private:
  std::array<float, static_cast<std::size_t>(kBrightest* kSteps) + 2> levels_{};
};

/// Noise of unit variance from a hash of `key`: the sum of four uniform numbers is near enough to a Gauss curve.
float sensor_noise(std::uint64_t key);
inline constexpr float kSensorNoiseScale = 1.7320508F;  // the sum varies by a third

/// What a sensor makes of `count` lights: `curve.level(light[i]) + noise_levels * sensor_noise(first_key + i)`, rounded
/// and within 0..255, the same to the last bit on every kind of processor.
void expose(const DisplayCurve& curve, const float* light, std::size_t count, std::uint64_t first_key,
            float noise_levels, std::uint8_t* levels);

}  // namespace homeward::sim
