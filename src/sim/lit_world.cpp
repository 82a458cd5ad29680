// SPDX-License-Identifier: Apache-2.0
#include "sim/lit_world.hpp"

#include <cstdio>
#include <map>

#include "sim/hash.hpp"
#include "sim/scene_rays.hpp"
#include "sim/tessellate.hpp"

namespace homeward::sim {
namespace {

constexpr float kFinest_m = 0.3F;         // edges of the triangles that carry the light
constexpr float kFinestOutside_m = 0.8F;  // the same under a sky, which lights evenly

}  // namespace

struct LitWorld::Parts {
  World world;
  Scene fine;
  raycast::RayScene rays;
  Surfaces surfaces;
  std::map<Light, Irradiance> light;
};

LitWorld::LitWorld(World world) {
  Scene fine = tessellate(world.scene, world.sky ? kFinestOutside_m : kFinest_m);
  raycast::RayScene rays = rays_of(fine);
  Surfaces surfaces = surfaces_of(fine);
  parts_ = std::make_unique<Parts>(Parts{std::move(world), std::move(fine), std::move(rays), std::move(surfaces), {}});
}
LitWorld::~LitWorld() = default;
LitWorld::LitWorld(LitWorld&&) noexcept = default;
LitWorld& LitWorld::operator=(LitWorld&&) noexcept = default;

const World& LitWorld::world() const { return parts_->world; }
const Scene& LitWorld::fine_scene() const { return parts_->fine; }
const raycast::RayScene& LitWorld::rays() const { return parts_->rays; }
const Surfaces& LitWorld::surfaces() const { return parts_->surfaces; }

const Irradiance& LitWorld::irradiance(const Light& light) {
  const auto known = parts_->light.find(light);
  if (known != parts_->light.end()) return known->second;
  return parts_->light
      .emplace(light, compute_irradiance(parts_->fine, parts_->rays, parts_->world.lamps,
                                         light_settings(light, parts_->world.sky)))
      .first->second;
}

bool LitWorld::set_irradiance(const Light& light, Irradiance irradiance) {
  if (irradiance.corners.rows() != parts_->fine.vertices_m.rows()) return false;
  parts_->light.insert_or_assign(light, std::move(irradiance));
  return true;
}

std::string LitWorld::light_key(const Light& light) const {
  constexpr std::uint64_t kLightVersion = 1;  // rises when compute_irradiance changes
  std::uint64_t hash = mix(kLightVersion * 1000003ULL + static_cast<std::uint64_t>(light.preset()));
  const auto add = [&](const void* data, std::size_t bytes) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ first[i]) * 0x100000001B3ULL;  // FNV-1a
    hash = mix(hash);
  };
  if (light.is_between()) {
    const double level = light.level();
    add(&level, sizeof level);
  }
  const Scene& fine = parts_->fine;
  add(fine.vertices_m.data(), static_cast<std::size_t>(fine.vertices_m.size()) * sizeof(float));
  add(fine.triangle_materials.data(), fine.triangle_materials.size() * sizeof(int));
  for (const Eigen::Array3f& albedo : mean_albedos(fine)) add(albedo.data(), 3 * sizeof(float));
  for (const Material& material : fine.materials) add(&material.role, sizeof material.role);
  for (const Lamp& lamp : parts_->world.lamps) {
    add(lamp.position_m.data(), 3 * sizeof(double));
    add(&lamp.strength, sizeof lamp.strength);
  }
  if (parts_->world.sky) add(&parts_->world.sky->sun_azimuth_rad, sizeof(double));
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace homeward::sim
