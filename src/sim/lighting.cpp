// SPDX-License-Identifier: Apache-2.0
#include "sim/lighting.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <span>

namespace homeward::sim {
namespace {

constexpr float kLift_m = 0.004F;  // rays start so far off their surface
constexpr float kFar_m = 60.0F;
constexpr float kSmallTriangle_m = 0.08F;  // lit by one sample
constexpr std::size_t kMostKeptBytes = std::size_t{384} << 20U;

float maximum_edge_m(const Scene& scene, Eigen::Index t) {
  float longest = 0.0F;
  for (Eigen::Index k = 0; k < 3; ++k) {
    longest = std::max(longest, (scene.vertices_m.row(3 * t + k) - scene.vertices_m.row(3 * t + (k + 1) % 3)).norm());
  }
  return longest;
}

/// How many samples the light of a triangle is taken at; none where it has no surface.
std::size_t samples_of(const Scene& scene, Eigen::Index t) {
  const Eigen::Vector3f a = scene.vertices_m.row(3 * t);
  const Eigen::Vector3f b = scene.vertices_m.row(3 * t + 1);
  const Eigen::Vector3f c = scene.vertices_m.row(3 * t + 2);
  if ((b - a).cross(c - a).squaredNorm() < 1e-16F) return 0;
  return maximum_edge_m(scene, t) < kSmallTriangle_m ? 1 : 3;
}

/// What a gathering ray meets.
struct Met {
  std::uint32_t triangle = raycast::Hit::kNoTriangle;
  float u = 0.0F;
  float v = 0.0F;
};

/// Cosine-weighted directions about +z, the same for all points: bias without speckles.
std::vector<Eigen::Vector3f> gather_directions(int count) {
  std::vector<Eigen::Vector3f> directions;
  constexpr float kGoldenAngle_rad = 2.39996323F;
  for (int i = 0; i < count; ++i) {
    const float r2 = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    const float radius = std::sqrt(r2);
    const float angle_rad = kGoldenAngle_rad * static_cast<float>(i);
    directions.emplace_back(radius * std::cos(angle_rad), radius * std::sin(angle_rad), std::sqrt(1.0F - r2));
  }
  return directions;
}

class Gatherer {
 public:
  Gatherer(const Scene& scene, const raycast::RayScene& rays, const std::vector<Lamp>& lamps,
           const LightSettings& settings)
      : scene_(scene),
        rays_(rays),
        lamps_(lamps),
        settings_(settings),
        albedos_(mean_albedos(scene)),
        directions_(gather_directions(settings.gather_rays)) {
    first_side_.reserve(static_cast<std::size_t>(scene.triangles.rows()) + 1);
    first_side_.push_back(0);
    for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
      first_side_.push_back(first_side_.back() + 2 * samples_of(scene, t));
    }
  }

  [[nodiscard]] Eigen::Array3f direct(const Eigen::Vector3f& point_m, const Eigen::Vector3f& normal) const {
    Eigen::Array3f light = Eigen::Array3f::Zero();
    if (settings_.lamp_intensity == 0.0F) return light;
    const Eigen::Array3f colour(settings_.lamp_colour[0], settings_.lamp_colour[1], settings_.lamp_colour[2]);
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      const float share = lamp_share(settings_, i);
      if (share == 0.0F) continue;
      const Eigen::Vector3f lamp_m = lamps_[i].position_m.cast<float>();
      const Eigen::Vector3f way_m = lamp_m - point_m;
      const float distance2 = std::max(0.09F, way_m.squaredNorm());
      const float cosine = normal.dot(way_m.normalized());
      // The lamp's own shade must not hide it: the last 15 cm are open.
      if (cosine <= 0.0F || rays_.blocked(point_m, lamp_m - 0.15F * way_m.normalized())) continue;
      light +=
          colour * (share * settings_.lamp_intensity * static_cast<float>(lamps_[i].strength) * cosine / distance2);
    }
    return light;
  }

  /// Turns +z to `normal`.
  [[nodiscard]] static Eigen::Quaternionf about(const Eigen::Vector3f& normal) {
    return Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), normal);
  }

  /// What the rays about `normal` meet, one for each direction.
  void trace(const Eigen::Vector3f& point_m, const Eigen::Vector3f& normal, std::span<Met> met) const {
    const Eigen::Quaternionf turn = about(normal);
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const auto hit = rays_.first_hit(point_m, turn * directions_[i], kFar_m);
      met[i] = hit ? Met{hit->triangle, hit->u, hit->v} : Met{};
    }
  }

  /// The light that such rays bring from what they have met, in the light that is `known` there.
  [[nodiscard]] Eigen::Array3f indirect(const Eigen::Vector3f& normal, std::span<const Met> met,
                                        const Irradiance& known) const {
    Eigen::Array3f light = Eigen::Array3f::Zero();
    const Eigen::Quaternionf turn = about(normal);
    for (std::size_t i = 0; i < met.size(); ++i) {
      const Met& one = met[i];
      if (one.triangle == raycast::Hit::kNoTriangle) {
        if (settings_.sky) {
          light += radiance(*settings_.sky, turn * directions_[i]);
        } else {
          light += settings_.window_radiance * 0.1F;
        }
        continue;
      }
      const auto material = static_cast<std::size_t>(scene_.triangle_materials[one.triangle]);
      if (scene_.materials[material].role == MaterialRole::kWindow) {
        light += settings_.window_radiance;
        continue;
      }
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(one.triangle);
      const Eigen::Array3f arriving = (1.0F - one.u - one.v) * known.corners.row(row).array() +
                                      one.u * known.corners.row(row + 1).array() +
                                      one.v * known.corners.row(row + 2).array();
      light += arriving * albedos_[material];
    }
    return light / static_cast<float>(directions_.size());
  }

  [[nodiscard]] std::size_t rays_per_side() const { return directions_.size(); }
  [[nodiscard]] std::size_t sides() const { return first_side_.back(); }

  /// Calls `gather(side, point, normal)` for both sides of each sample, the point lifted off its surface and drawn in
  /// from the edges; sides are numbered from 0 on, those of a triangle one after another.
  template <class Gather>
  [[nodiscard]] Irradiance at_all_corners(const Gather& gather) const {
    Irradiance irradiance;
    irradiance.corners.setZero(scene_.vertices_m.rows(), 3);
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, scene_.triangles.rows(), 256), [&](const auto& range) {
      for (Eigen::Index t = range.begin(); t != range.end(); ++t) {
        const Eigen::Vector3f a = scene_.vertices_m.row(3 * t);
        const Eigen::Vector3f b = scene_.vertices_m.row(3 * t + 1);
        const Eigen::Vector3f c = scene_.vertices_m.row(3 * t + 2);
        std::size_t side = first_side_[static_cast<std::size_t>(t)];
        const std::size_t samples = (first_side_[static_cast<std::size_t>(t) + 1] - side) / 2;
        if (samples == 0) continue;
        const Eigen::Vector3f normal = (b - a).cross(c - a).normalized();
        const Eigen::Vector3f centre = (a + b + c) / 3.0F;
        const auto lit = [&](const Eigen::Vector3f& point_m) -> Eigen::Array3f {
          // Meshes from elsewhere do not say which side is outside: the brighter one is.
          const Eigen::Array3f front = gather(side, Eigen::Vector3f(point_m + kLift_m * normal), normal);
          const Eigen::Array3f back =
              gather(side + 1, Eigen::Vector3f(point_m - kLift_m * normal), Eigen::Vector3f(-normal));
          side += 2;
          return front.max(back);
        };
        if (samples == 1) {
          const Eigen::Array3f light = lit(centre);
          for (Eigen::Index k = 0; k < 3; ++k) irradiance.corners.row(3 * t + k) = light;
          continue;
        }
        constexpr float kDrawnIn = 0.12F;
        for (Eigen::Index k = 0; k < 3; ++k) {
          const Eigen::Vector3f corner = scene_.vertices_m.row(3 * t + k);
          irradiance.corners.row(3 * t + k) = lit(corner + kDrawnIn * (centre - corner));
        }
      }
    });
    return irradiance;
  }

 private:
  const Scene& scene_;
  const raycast::RayScene& rays_;
  const std::vector<Lamp>& lamps_;
  const LightSettings& settings_;
  std::vector<Eigen::Array3f> albedos_;
  std::vector<Eigen::Vector3f> directions_;
  std::vector<std::size_t> first_side_;  // of each triangle, and how many there are: two of each of its samples
};

}  // namespace

LightSettings light_settings(const Light& light) {
  const LightSettings day{{1.0F, 0.97F, 0.92F}, 1.1F, 0, 5.0F, 1.4F, 1.5F, 1.0F};
  const LightSettings night{{1.0F, 0.80F, 0.55F}, 1.4F, 3, 0.0F, 0.03F, 3.0F, 1.1F};
  const LightSettings half{{1.0F, 0.90F, 0.75F}, 1.2F, 2, 1.2F, 0.5F, 2.0F, 1.1F};
  if (!light.is_between()) {
    if (light.preset() == LightPreset::kHalf) return half;
    return light.preset() == LightPreset::kDay ? day : night;
  }
  const auto share = static_cast<float>(light.level());
  const auto between = [&](float dark, float bright) { return std::lerp(dark, bright, share); };
  LightSettings settings = night;
  for (std::size_t band = 0; band < 3; ++band) {
    settings.lamp_colour[band] = between(night.lamp_colour[band], day.lamp_colour[band]);
  }
  settings.lamp_intensity = between(night.lamp_intensity, day.lamp_intensity);
  settings.dimmed = share;  // at night every third is off, by day all burn
  settings.window_radiance = between(night.window_radiance, day.window_radiance);
  settings.window_shown = between(night.window_shown, day.window_shown);
  settings.noise_levels = between(night.noise_levels, day.noise_levels);
  settings.exposure = between(night.exposure, day.exposure);
  return settings;
}

LightSettings light_settings(const Light& light, const std::optional<Sky>& sky) {
  if (!sky) return light_settings(light);
  const float daylight = daylight_in(light);
  constexpr float kFirstLamps = 0.25F;
  constexpr float kAllLamps = 0.1F;
  constexpr float kDark = 0.02F;  // of the day: what the camera's exposure is set for where there is no light at all
  LightSettings settings;
  settings.lamp_colour = {1.0F, 0.82F, 0.58F};
  settings.lamp_intensity = 0.4F * std::clamp((kFirstLamps - daylight) / (kFirstLamps - kAllLamps), 0.0F, 1.0F);
  if (!light.is_between() && light.preset() == LightPreset::kHalf) settings.lamps_off_every = 2;
  settings.window_shown = 0.03F + daylight;
  settings.exposure = std::pow((1.0F + kDark) / (daylight + kDark), 0.7F);
  settings.noise_levels = 1.5F * std::pow(settings.exposure, 0.35F);
  settings.sky = sky_light(*sky, daylight);
  return settings;
}

float lamp_share(const LightSettings& settings, std::size_t index) {
  const bool burns =
      settings.lamps_off_every == 0 || (index + 1) % static_cast<std::size_t>(settings.lamps_off_every) != 0;
  return burns ? 1.0F : settings.dimmed;
}

float linear_from_srgb(std::uint8_t value) {
  const float level = static_cast<float>(value) / 255.0F;
  return level <= 0.04045F ? level / 12.92F : std::pow((level + 0.055F) / 1.055F, 2.4F);
}

std::vector<Eigen::Array3f> mean_albedos(const Scene& scene) {
  std::vector<Eigen::Array3f> texture_means;
  for (const Image& texture : scene.textures) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    constexpr std::size_t kStride = 7;  // a sample of the texels is enough for a mean
    std::size_t count = 0;
    const std::size_t texels = texture.data.size() / 3;
    for (std::size_t i = 0; i < texels; i += kStride, ++count) {
      for (std::size_t band = 0; band < 3; ++band) {
        sum[static_cast<Eigen::Index>(band)] += static_cast<double>(linear_from_srgb(texture.data[3 * i + band]));
      }
    }
    texture_means.emplace_back((sum / static_cast<double>(std::max<std::size_t>(1, count))).cast<float>());
  }
  std::vector<Eigen::Array3f> albedos;
  for (const Material& material : scene.materials) {
    Eigen::Array3f albedo(material.base_colour[0], material.base_colour[1], material.base_colour[2]);
    if (material.texture >= 0) albedo *= texture_means[static_cast<std::size_t>(material.texture)];
    albedos.push_back(albedo);
  }
  return albedos;
}

Irradiance compute_irradiance(const Scene& scene, const raycast::RayScene& rays, const std::vector<Lamp>& lamps,
                              const LightSettings& settings) {
  const Gatherer gatherer(scene, rays, lamps, settings);
  const Irradiance direct =
      gatherer.at_all_corners([&](std::size_t, const Eigen::Vector3f& point_m, const Eigen::Vector3f& normal) {
        return gatherer.direct(point_m, normal);
      });
  Irradiance total = direct;
  // Every bounce asks the same rays: what they met is kept from the first on, of as many sides as there is room for.
  const std::size_t rays_per_side = gatherer.rays_per_side();
  const std::size_t kept_sides = std::min(gatherer.sides(), kMostKeptBytes / (rays_per_side * sizeof(Met)));
  std::vector<Met> kept(kept_sides * rays_per_side);
  constexpr int kBounces = 2;
  for (int bounce = 0; bounce < kBounces; ++bounce) {
    const Irradiance bounced =
        gatherer.at_all_corners([&](std::size_t side, const Eigen::Vector3f& point_m, const Eigen::Vector3f& normal) {
          thread_local std::vector<Met> passing;
          passing.resize(rays_per_side);
          const bool keeps = side < kept_sides;
          const std::span<Met> met = keeps ? std::span(kept).subspan(side * rays_per_side, rays_per_side) : passing;
          if (bounce == 0 || !keeps) gatherer.trace(point_m, normal, met);
          return gatherer.indirect(normal, met, total);
        });
    total.corners = direct.corners + bounced.corners;
  }
  return total;
}

}  // namespace homeward::sim
