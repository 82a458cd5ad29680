// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

namespace homeward::sim {

enum class LightPreset { kDay, kNight, kHalf };

/// The light that a world is seen in: a preset, or so much daylight.
class Light {
 public:
  Light(LightPreset preset = LightPreset::kDay) : preset_(preset) {}  // NOLINT(google-explicit-constructor)
  /// Between night (0: no daylight, the lamps that burn at night) and day (1); what lies outside is taken to the nearer
  /// end. Those two are the presets.
  static Light of_daylight(double level) {
    if (level >= 1.0) return LightPreset::kDay;
    Light light(LightPreset::kNight);
    if (level > 0.0) light.level_ = level;
    return light;
  }

  /// The preset, where `is_between()` does not say otherwise.
  [[nodiscard]] LightPreset preset() const { return preset_; }
  /// Whether it lies between night and day.
  [[nodiscard]] bool is_between() const { return level_ > 0.0; }
  /// How much of the day's light there is, between 0 and 1. Precondition: is_between().
  [[nodiscard]] double level() const { return level_; }

  friend auto operator<=>(const Light&, const Light&) = default;

 private:
  LightPreset preset_;
  double level_ = 0.0;  // 0: a preset
};

}  // namespace homeward::sim
