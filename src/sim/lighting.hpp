// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "raycast/ray_scene.hpp"
#include "sim/light.hpp"
#include "sim/scene.hpp"
#include "sim/sky.hpp"

namespace homeward::sim {

/// How a light shines on a world: which lamps burn, their colour, what the windows give.
struct LightSettings {
  std::array<float, 3> lamp_colour{1.0F, 1.0F, 1.0F};
  float lamp_intensity = 1.0F;   // of a lamp of strength 1
  int lamps_off_every = 0;       // every n-th lamp is dimmed; 0: all burn
  float window_radiance = 0.0F;  // daylight through windows
  float window_shown = 0.05F;    // brightness of a window pane itself
  float noise_levels = 1.5F;     // standard deviation of the sensor's noise, grey levels of 255
  float exposure = 1.0F;
  float dimmed = 0.0F;                         // what a dimmed lamp still gives of its light; 0: it is off
  int gather_rays = 40;                        // directions from which diffuse light is gathered; more, less blotchy
  std::optional<SkyLight> sky = std::nullopt;  // in the open; none: a ray that meets nothing shows a dim grey
};
LightSettings light_settings(const Light& light);
/// The same under a sky, where there is one: no lamps burn by day, the first at dusk, and the less light there is, the
/// longer the camera exposes and the noisier it is.
LightSettings light_settings(const Light& light, const std::optional<Sky>& sky);

/// What lamp number `index` gives of its light, 0 to 1.
float lamp_share(const LightSettings& settings, std::size_t index);

/// Light arriving at every corner of every triangle of a tessellated scene, linear RGB.
struct Irradiance {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> corners;  // 3T x 3; row 3 t + k: corner k of triangle t
};

/// Lamps with shadows, daylight from windows and two diffuse bounces, gathered at the corners (radiosity by ray
/// casting, Arvo 1986). `scene`: the tessellated scene; every triangle has its own three vertices. Data-parallel, same
/// result always.
Irradiance compute_irradiance(const Scene& scene, const raycast::RayScene& rays, const std::vector<Lamp>& lamps,
                              const LightSettings& settings);

/// Mean linear colour of each material's texture times its base colour.
std::vector<Eigen::Array3f> mean_albedos(const Scene& scene);

/// sRGB byte to linear 0..1.
float linear_from_srgb(std::uint8_t value);

}  // namespace homeward::sim
