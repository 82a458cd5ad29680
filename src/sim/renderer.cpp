// SPDX-License-Identifier: Apache-2.0
#include "sim/renderer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "sim/texture.hpp"

namespace homeward::sim {
namespace {

constexpr float kFinest_m = 0.3F;  // edges of the triangles that carry the light
constexpr float kFar_m = 80.0F;

std::uint64_t mix(std::uint64_t x) {  // splitmix64's finaliser (Steele, Lea & Flood 2014)
  x ^= x >> 30U;
  x *= 0xBF58476D1CE4E5B9ULL;
  x ^= x >> 27U;
  x *= 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// Noise of unit variance from a hash: the sum of four uniform numbers is near enough to a Gauss curve.
float noise(std::uint64_t key) {
  const std::uint64_t bits = mix(key);
  float sum = 0.0F;
  for (unsigned i = 0; i < 4; ++i) sum += static_cast<float>((bits >> (16U * i)) & 0xFFFFU) / 65535.0F;
  return (sum - 2.0F) * 1.7320508F;
}

/// Light to grey levels: a soft shoulder above, then the sRGB curve.
float display_level(float light) {
  const float bounded = 1.0F - std::exp(-light);
  const float srgb = bounded <= 0.0031308F ? 12.92F * bounded : 1.055F * std::pow(bounded, 1.0F / 2.4F) - 0.055F;
  return 255.0F * srgb;
}

/// The same from a table over the root of the light, right to a hundredth of a level: each pixel asks three times.
class DisplayCurve {
 public:
  DisplayCurve() {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const float root = static_cast<float>(i) / kSteps;
      levels_[i] = display_level(root * root);
    }
  }
  [[nodiscard]] float level(float light) const {
    const float place = kSteps * std::min(std::sqrt(light), kBrightest);
    const auto below = static_cast<std::size_t>(place);
    return levels_[below] + (place - static_cast<float>(below)) * (levels_[below + 1] - levels_[below]);
  }

 private:
  static constexpr float kBrightest = 3.5F;  // e^-12 short of white
  static constexpr float kSteps = 512.0F;
  std::array<float, static_cast<std::size_t>(kBrightest* kSteps) + 2> levels_{};
};

std::vector<Eigen::Vector3f> normals(const Scene& scene) {
  std::vector<Eigen::Vector3f> result(static_cast<std::size_t>(scene.triangles.rows()));
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    const Eigen::Vector3f ab = scene.vertices_m.row(3 * t + 1) - scene.vertices_m.row(3 * t);
    const Eigen::Vector3f ac = scene.vertices_m.row(3 * t + 2) - scene.vertices_m.row(3 * t);
    result[static_cast<std::size_t>(t)] = ab.cross(ac).normalized();
  }
  return result;
}

std::vector<float> texels_per_metre(const Scene& scene, const std::vector<MipTexture>& textures) {
  std::vector<float> result(static_cast<std::size_t>(scene.triangles.rows()), 0.0F);
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    const Material& material =
        scene.materials[static_cast<std::size_t>(scene.triangle_materials[static_cast<std::size_t>(t)])];
    if (material.texture < 0) continue;
    const MipTexture& texture = textures[static_cast<std::size_t>(material.texture)];
    const Eigen::Vector3f ab = scene.vertices_m.row(3 * t + 1) - scene.vertices_m.row(3 * t);
    const Eigen::Vector3f ac = scene.vertices_m.row(3 * t + 2) - scene.vertices_m.row(3 * t);
    const Eigen::Vector2f uv_ab = scene.texture_uv.row(3 * t + 1) - scene.texture_uv.row(3 * t);
    const Eigen::Vector2f uv_ac = scene.texture_uv.row(3 * t + 2) - scene.texture_uv.row(3 * t);
    const float area_m2 = ab.cross(ac).norm();
    const float area_texels = std::abs(uv_ab.x() * uv_ac.y() - uv_ab.y() * uv_ac.x()) *
                              static_cast<float>(texture.width_px()) * static_cast<float>(texture.height_px());
    if (area_m2 > 1e-12F) result[static_cast<std::size_t>(t)] = std::sqrt(area_texels / area_m2);
  }
  return result;
}

/// What a ray shows where one of these `things`, each in its own light, is nearer than what it has met. `hit`: where
/// the ray meets one of them.
template <class Thing, class HitThing>
void hide_behind(const std::vector<Thing>& things, const std::vector<Eigen::Array3f>& light_on, const HitThing& hit,
                 const Eigen::Vector3f& viewpoint_m, const Eigen::Vector3f& direction, float& nearest_m,
                 Eigen::Array3f& light) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto met = hit(things[i], viewpoint_m, direction);
    if (!met || met->distance_m >= nearest_m) continue;
    nearest_m = met->distance_m;
    light = met->albedo * light_on[i];
  }
}

}  // namespace

struct LitWorld::Parts {
  World world;
  Scene fine;
  RayScene rays;
  std::map<LightPreset, Irradiance> light;
};

LitWorld::LitWorld(World world) {
  Scene fine = tessellate(world.scene, kFinest_m);
  RayScene rays(fine);
  parts_ = std::make_unique<Parts>(Parts{std::move(world), std::move(fine), std::move(rays), {}});
}
LitWorld::~LitWorld() = default;
LitWorld::LitWorld(LitWorld&&) noexcept = default;
LitWorld& LitWorld::operator=(LitWorld&&) noexcept = default;

const World& LitWorld::world() const { return parts_->world; }
const Scene& LitWorld::fine_scene() const { return parts_->fine; }
const RayScene& LitWorld::rays() const { return parts_->rays; }

const Irradiance& LitWorld::irradiance(LightPreset preset) {
  const auto known = parts_->light.find(preset);
  if (known != parts_->light.end()) return known->second;
  return parts_->light
      .emplace(preset, compute_irradiance(parts_->fine, parts_->rays, parts_->world.lamps, light_settings(preset)))
      .first->second;
}

bool LitWorld::set_irradiance(LightPreset preset, Irradiance irradiance) {
  if (irradiance.corners.rows() != parts_->fine.vertices_m.rows()) return false;
  parts_->light.insert_or_assign(preset, std::move(irradiance));
  return true;
}

std::string LitWorld::light_key(LightPreset preset) const {
  constexpr std::uint64_t kLightVersion = 1;  // rises when compute_irradiance changes
  std::uint64_t hash = mix(kLightVersion * 1000003ULL + static_cast<std::uint64_t>(preset));
  const auto add = [&](const void* data, std::size_t bytes) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ first[i]) * 0x100000001B3ULL;  // FNV-1a
    hash = mix(hash);
  };
  const Scene& fine = parts_->fine;
  add(fine.vertices_m.data(), static_cast<std::size_t>(fine.vertices_m.size()) * sizeof(float));
  add(fine.triangle_materials.data(), fine.triangle_materials.size() * sizeof(int));
  for (const Eigen::Array3f& albedo : mean_albedos(fine)) add(albedo.data(), 3 * sizeof(float));
  for (const Material& material : fine.materials) add(&material.role, sizeof material.role);
  for (const Lamp& lamp : parts_->world.lamps) {
    add(lamp.position_m.data(), 3 * sizeof(double));
    add(&lamp.strength, sizeof lamp.strength);
  }
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

struct Renderer::Parts {
  const Scene* scene;
  const RayScene* rays;
  std::shared_ptr<const Irradiance> light;
  LightSettings settings;
  Eigen::Vector3f viewpoint_in_robot_m;
  int width_px;
  int height_px;
  std::vector<Eigen::Vector3f> directions_in_robot;  // of the pixels that see something
  std::vector<int> pixels;                           // their indices
  float radians_per_pixel;
  std::vector<MipTexture> textures;
  std::vector<float> texel_density;  // texels per metre of each triangle
  std::vector<Eigen::Vector3f> triangle_normals;
  DisplayCurve display;

  [[nodiscard]] Eigen::Array3f shade(const Hit& hit, const Eigen::Vector3f& direction) const;
};

// The world keeps the light of a preset, and has to outlive the renderer anyway.
Renderer::Renderer(LitWorld& world, LightPreset preset, const std::shared_ptr<const camera::Camera>& camera)
    : Renderer(world, light_settings(preset),
               std::shared_ptr<const Irradiance>(std::shared_ptr<void>(), &world.irradiance(preset)), camera) {}

Renderer::Renderer(const LitWorld& world, const LightSettings& settings, std::shared_ptr<const Irradiance> light,
                   const std::shared_ptr<const camera::Camera>& camera) {
  const camera::CameraConfig& config = camera->config();
  std::vector<MipTexture> textures;
  textures.reserve(world.fine_scene().textures.size());
  for (const Image& texture : world.fine_scene().textures) textures.emplace_back(texture);
  std::vector<float> density = texels_per_metre(world.fine_scene(), textures);
  parts_ = std::make_unique<Parts>(Parts{&world.fine_scene(),
                                         &world.rays(),
                                         std::move(light),
                                         settings,
                                         config.robot_from_camera_translation_m.cast<float>(),
                                         config.width_px,
                                         config.height_px,
                                         {},
                                         {},
                                         0.005F,
                                         std::move(textures),
                                         std::move(density),
                                         normals(world.fine_scene()),
                                         {}});
  const camera::BearingTable table = camera::bearing_table(*camera);
  for (std::size_t i = 0; i < table.valid.size(); ++i) {
    if (table.valid[i] == 0) continue;
    parts_->pixels.push_back(static_cast<int>(i));
    parts_->directions_in_robot.emplace_back(table.bearings.row(static_cast<Eigen::Index>(i)));
  }
  // The pixels share the solid angle that the camera sees; their mean width decides which texture copy is read.
  double sum_rad = 0.0;
  std::size_t neighbours = 0;
  for (std::size_t i = 1; i < parts_->pixels.size(); i += 11) {
    if (parts_->pixels[i] != parts_->pixels[i - 1] + 1) continue;
    sum_rad += static_cast<double>((parts_->directions_in_robot[i] - parts_->directions_in_robot[i - 1]).norm());
    ++neighbours;
  }
  if (neighbours > 0) parts_->radians_per_pixel = static_cast<float>(sum_rad / static_cast<double>(neighbours));
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Eigen::Array3f Renderer::Parts::shade(const Hit& hit, const Eigen::Vector3f& direction) const {
  const auto t = static_cast<Eigen::Index>(hit.triangle);
  const Material& material = scene->materials[static_cast<std::size_t>(scene->triangle_materials[hit.triangle])];
  const float w = 1.0F - hit.u - hit.v;
  Eigen::Array3f albedo(material.base_colour[0], material.base_colour[1], material.base_colour[2]);
  if (material.texture >= 0) {
    const Eigen::Vector2f uv = w * scene->texture_uv.row(3 * t) + hit.u * scene->texture_uv.row(3 * t + 1) +
                               hit.v * scene->texture_uv.row(3 * t + 2);
    const float slant = std::max(0.15F, std::abs(triangle_normals[hit.triangle].dot(direction)));
    // Half way between the footprint's short and long side keeps slanted floors readable.
    const float width_m = hit.distance_m * radians_per_pixel / std::sqrt(slant);
    albedo *= textures[static_cast<std::size_t>(material.texture)].sample(uv.x(), uv.y(),
                                                                          width_m * texel_density[hit.triangle]);
  }
  if (material.role == MaterialRole::kWindow) return albedo * settings.window_shown;
  const Eigen::Array3f arriving = w * light->corners.row(3 * t).array() +
                                  hit.u * light->corners.row(3 * t + 1).array() +
                                  hit.v * light->corners.row(3 * t + 2).array();
  Eigen::Array3f seen = albedo * arriving * settings.exposure;
  if (material.role == MaterialRole::kLamp) seen += albedo * 1.5F * settings.lamp_intensity;
  return seen;
}

Image Renderer::render(const Pose2& robot, const std::vector<Person>& people, std::uint64_t noise_seed,
                       const std::vector<Box>& boxes) const {
  const Parts& parts = *parts_;
  Image image(parts.width_px, parts.height_px, 3);
  const Eigen::Matrix3f world_from_robot =
      Eigen::AngleAxisf(static_cast<float>(robot.theta_rad), Eigen::Vector3f::UnitZ()).toRotationMatrix();
  const Eigen::Vector3f viewpoint_m =
      world_from_robot * parts.viewpoint_in_robot_m +
      Eigen::Vector3f(static_cast<float>(robot.x_m), static_cast<float>(robot.y_m), 0.0F);
  // Light on people and boxes: what falls on the floor at their feet, roughly; it is looked up by a ray straight down.
  const auto light_at = [&](double x_m, double y_m) -> Eigen::Array3f {
    const Eigen::Vector3f above_m(static_cast<float>(x_m), static_cast<float>(y_m), 1.9F);
    const auto floor = parts.rays->first_hit(above_m, -Eigen::Vector3f::UnitZ(), kFar_m);
    Eigen::Array3f light = Eigen::Array3f::Constant(0.5F);
    if (floor) light = parts.light->corners.row(3 * static_cast<Eigen::Index>(floor->triangle)).array();
    return light * parts.settings.exposure;
  };
  std::vector<Eigen::Array3f> person_light;
  person_light.reserve(people.size());
  for (const Person& person : people) person_light.push_back(light_at(person.x_m, person.y_m));
  std::vector<Eigen::Array3f> box_light;
  box_light.reserve(boxes.size());
  for (const Box& box : boxes) box_light.push_back(light_at(box.pose.x_m, box.pose.y_m));
  const std::uint64_t noise_key = mix(noise_seed);
  const std::size_t packets = (parts.pixels.size() + 7) / 8;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets, 64), [&](const auto& range) {
    for (std::size_t packet_index = range.begin(); packet_index != range.end(); ++packet_index) {
      RayPacket packet;
      const std::size_t first = packet_index * 8;
      const std::size_t count = std::min<std::size_t>(8, parts.pixels.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        packet.directions[i] = world_from_robot * parts.directions_in_robot[first + i];
        packet.wanted[i] = true;
      }
      const auto hits = parts.rays->first_hits(viewpoint_m, packet, kFar_m);
      for (std::size_t i = 0; i < count; ++i) {
        Eigen::Array3f light = Eigen::Array3f::Constant(0.6F * parts.settings.window_shown);  // the sky
        float nearest_m = kFar_m;
        if (hits[i]) {
          light = parts.shade(*hits[i], packet.directions[i]);
          nearest_m = hits[i]->distance_m;
        }
        hide_behind(people, person_light, hit_person, viewpoint_m, packet.directions[i], nearest_m, light);
        hide_behind(boxes, box_light, hit_box, viewpoint_m, packet.directions[i], nearest_m, light);
        const int pixel = parts.pixels[first + i];
        std::uint8_t* target = image.data.data() + static_cast<std::size_t>(pixel) * 3;
        for (unsigned band = 0; band < 3; ++band) {
          const std::uint64_t key = noise_key + static_cast<std::uint64_t>(pixel) * 3 + band;
          const float level =
              parts.display.level(light[static_cast<Eigen::Index>(band)]) + parts.settings.noise_levels * noise(key);
          target[band] = static_cast<std::uint8_t>(std::clamp(level + 0.5F, 0.0F, 255.0F));
        }
      }
    }
  });
  return image;
}

}  // namespace homeward::sim
