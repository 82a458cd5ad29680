// SPDX-License-Identifier: Apache-2.0
#include "sim/shading.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace homeward::sim {
namespace {

float texels_per_m(const Scene& scene, Eigen::Index t, const MipTexture& texture) {
  const Eigen::Vector3f ab = scene.vertices_m.row(3 * t + 1) - scene.vertices_m.row(3 * t);
  const Eigen::Vector3f ac = scene.vertices_m.row(3 * t + 2) - scene.vertices_m.row(3 * t);
  const Eigen::Vector2f uv_ab = scene.texture_uv.row(3 * t + 1) - scene.texture_uv.row(3 * t);
  const Eigen::Vector2f uv_ac = scene.texture_uv.row(3 * t + 2) - scene.texture_uv.row(3 * t);
  const float area_m2 = ab.cross(ac).norm();
  const float area_texels = std::abs(uv_ab.x() * uv_ac.y() - uv_ab.y() * uv_ac.x()) *
                            static_cast<float>(texture.width_px()) * static_cast<float>(texture.height_px());
  return area_m2 > 1e-12F ? std::sqrt(area_texels / area_m2) : 0.0F;
}

}  // namespace

Surfaces surfaces_of(const Scene& scene) {
  Surfaces surfaces;
  surfaces.textures.reserve(scene.textures.size());
  for (const Image& texture : scene.textures) surfaces.textures.emplace_back(texture);
  surfaces.facets.resize(static_cast<std::size_t>(scene.triangles.rows()));
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    Facet& facet = surfaces.facets[static_cast<std::size_t>(t)];
    const Eigen::Vector3f ab = scene.vertices_m.row(3 * t + 1) - scene.vertices_m.row(3 * t);
    const Eigen::Vector3f ac = scene.vertices_m.row(3 * t + 2) - scene.vertices_m.row(3 * t);
    facet.normal = ab.cross(ac).normalized();
    facet.material = scene.triangle_materials[static_cast<std::size_t>(t)];
    const int texture = scene.materials[static_cast<std::size_t>(facet.material)].texture;
    if (texture < 0) continue;
    facet.texels_per_m = texels_per_m(scene, t, surfaces.textures[static_cast<std::size_t>(texture)]);
  }
  return surfaces;
}

Shader::Shader(const Scene& scene, const Surfaces& surfaces, std::shared_ptr<const Irradiance> light,
               const LightSettings& settings, float radians_per_pixel)
    : scene_(&scene),
      surfaces_(&surfaces),
      light_(std::move(light)),
      settings_(settings),
      radians_per_pixel_(radians_per_pixel) {
  for (const Material& material : scene.materials) {
    Paint paint;
    paint.base_colour = {material.base_colour[0], material.base_colour[1], material.base_colour[2], 0.0F};
    if (material.texture >= 0) paint.texture = &surfaces.textures[static_cast<std::size_t>(material.texture)];
    paint.role = material.role;
    paints_.push_back(paint);
  }
}

Eigen::Array4f Shader::shade(const raycast::Hit& hit, const Eigen::Vector3f& direction) const {
  const Facet& facet = surfaces_->facets[hit.triangle];
  const Paint& paint = paints_[static_cast<std::size_t>(facet.material)];
  const float w = 1.0F - hit.u - hit.v;
  Eigen::Array4f albedo = paint.base_colour;
  if (paint.texture != nullptr) {
    const float* uv = scene_->texture_uv.data() + 6 * static_cast<std::size_t>(hit.triangle);
    const float slant = std::max(0.15F, std::abs(facet.normal.dot(direction)));
    // Half way between the footprint's short and long side keeps slanted floors readable.
    const float width_m = hit.distance_m * radians_per_pixel_ / std::sqrt(slant);
    albedo *= paint.texture->sample(w * uv[0] + hit.u * uv[2] + hit.v * uv[4],
                                    w * uv[1] + hit.u * uv[3] + hit.v * uv[5], width_m * facet.texels_per_m);
  }
  if (paint.role == MaterialRole::kWindow) return albedo * settings_.window_shown;
  const float* corners = light_->corners.data() + 9 * static_cast<std::size_t>(hit.triangle);
  const Eigen::Array4f arriving = w * Eigen::Map<const Eigen::Array4f>(corners) +
                                  hit.u * Eigen::Map<const Eigen::Array4f>(corners + 3) +
                                  hit.v * Eigen::Array4f(corners[6], corners[7], corners[8], 0.0F);
  Eigen::Array4f seen = albedo * arriving * settings_.exposure;
  if (paint.role == MaterialRole::kLamp) seen += albedo * 1.5F * settings_.lamp_intensity;
  return seen;
}

}  // namespace homeward::sim
