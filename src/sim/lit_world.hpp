// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "raycast/ray_scene.hpp"
#include "sim/lighting.hpp"
#include "sim/scene.hpp"
#include "sim/shading.hpp"

namespace homeward::sim {

/// A world made ready to be looked at: finely tessellated, with each light that was asked for.
class LitWorld {
 public:
  explicit LitWorld(World world);
  ~LitWorld();
  LitWorld(LitWorld&&) noexcept;
  LitWorld& operator=(LitWorld&&) noexcept;

  [[nodiscard]] const World& world() const;
  [[nodiscard]] const Scene& fine_scene() const;
  [[nodiscard]] const raycast::RayScene& rays() const;
  [[nodiscard]] const Surfaces& surfaces() const;  // of the fine scene
  /// What a light gives; computed at first use (seconds), then kept. Not for use from several threads.
  const Irradiance& irradiance(const Light& light);
  /// Takes light that was computed before. Its size must fit; false when it does not. Before any renderer is made of
  /// this world: one that stands goes on showing what it has shown.
  bool set_irradiance(const Light& light, Irradiance irradiance);
  /// Short text that changes with anything that the light depends on.
  [[nodiscard]] std::string light_key(const Light& light) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace homeward::sim
