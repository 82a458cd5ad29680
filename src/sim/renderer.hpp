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
#include "sim/lit_world.hpp"
#include "sim/people.hpp"

namespace homeward::sim {

/// Takes pictures with one camera in one world and light. The look-up tables are computed once.
class Renderer {
 public:
  Renderer(LitWorld& world, const Light& light, const std::shared_ptr<const camera::Camera>& camera);
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
