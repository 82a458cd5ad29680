// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "raycast/ray_scene.hpp"
#include "sim/lighting.hpp"
#include "sim/scene.hpp"
#include "sim/texture.hpp"

namespace homeward::sim {

/// What is asked of a triangle for every pixel that shows it, besides its light.
struct Facet {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float texels_per_m = 0.0F;  // of its material's texture; 0 without one
  int material = 0;
};

/// The facets of a scene's triangles, and its textures ready to be sampled.
struct Surfaces {
  std::vector<MipTexture> textures;
  std::vector<Facet> facets;
};
Surfaces surfaces_of(const Scene& scene);

/// The light that comes from a scene's surfaces. What it is made of has to outlive it.
class Shader {
 public:
  /// `light`: of the scene, by these settings; must not be null. `radians_per_pixel`: mean width of a pixel, which
  /// decides which copy of a texture is read.
  Shader(const Scene& scene, const Surfaces& surfaces, std::shared_ptr<const Irradiance> light,
         const LightSettings& settings, float radians_per_pixel);

  /// Red, green, blue, linear, of where a ray of this direction (unit vector) meets the scene; the fourth number means
  /// nothing.
  [[nodiscard]] Eigen::Array4f shade(const raycast::Hit& hit, const Eigen::Vector3f& direction) const;
  [[nodiscard]] const LightSettings& settings() const { return settings_; }
  [[nodiscard]] const Irradiance& light() const { return *light_; }

 private:
  struct Paint {  // a material as it is shaded
    Eigen::Array4f base_colour;
    const MipTexture* texture = nullptr;
    MaterialRole role = MaterialRole::kNone;
  };
  const Scene* scene_;
  const Surfaces* surfaces_;
  std::shared_ptr<const Irradiance> light_;
  LightSettings settings_;
  float radians_per_pixel_;
  std::vector<Paint> paints_;
};

}  // namespace homeward::sim
