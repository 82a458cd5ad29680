// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "sim/box.hpp"
#include "sim/lighting.hpp"
#include "sim/people.hpp"
#include "sim/ray_scene.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// A world made ready to be looked at: finely tessellated, with the light of each preset that was asked for.
class LitWorld {
 public:
  explicit LitWorld(World world);
  ~LitWorld();
  LitWorld(LitWorld&&) noexcept;
  LitWorld& operator=(LitWorld&&) noexcept;

  [[nodiscard]] const World& world() const;
  [[nodiscard]] const Scene& fine_scene() const;
  [[nodiscard]] const RayScene& rays() const;
  /// The light of a preset; computed at first use (seconds), then kept. Not for use from several threads.
  const Irradiance& irradiance(LightPreset preset);
  /// Takes light that was computed before. Its size must fit; false when it does not.
  bool set_irradiance(LightPreset preset, Irradiance irradiance);
  /// Short text that changes with anything that the light depends on.
  [[nodiscard]] std::string light_key(LightPreset preset) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Takes pictures with one camera in one world and light. The look-up tables are computed once.
class Renderer {
 public:
  Renderer(LitWorld& world, LightPreset preset, const std::shared_ptr<const camera::Camera>& camera);
  /// The same in a light of the caller's own. `light`: of the world's fine scene, by these settings; must not be null.
  Renderer(const LitWorld& world, const LightSettings& settings, std::shared_ptr<const Irradiance> light,
           const std::shared_ptr<const camera::Camera>& camera);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// The picture at a robot pose. Same arguments, same picture, whatever the number of threads.
  [[nodiscard]] Image render(const Pose2& robot, const std::vector<Person>& people, std::uint64_t noise_seed,
                             const std::vector<Box>& boxes = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace homeward::sim
