// SPDX-License-Identifier: Apache-2.0
#include "sim/ultrasound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/angles.hpp"
#include "sim/nearest.hpp"

namespace homeward::sim {

std::vector<Pose2> ultrasound_ring(const Outline& outline, const UltrasoundConfig& config) {
  const double middle_m = 0.5 * (outline.front_m - outline.back_m);
  std::vector<Pose2> ring;
  for (int i = 0; i < config.sensors; ++i) {
    const double angle_rad = wrap_angle(2.0 * kPi * i / config.sensors);
    const Eigen::Vector2d outwards(std::cos(angle_rad), std::sin(angle_rad));
    // Out from the middle as far as the body leaves the sensor's least range; distance grows all the way.
    double inside_m = 0.0;
    double outside_m = 10.0;
    for (int halving = 0; halving < 40; ++halving) {
      const double along_m = 0.5 * (inside_m + outside_m);
      const Eigen::Vector2d at_m = Eigen::Vector2d(middle_m, 0.0) + along_m * outwards;
      (distance_m(outline, at_m) < 0.0 ? inside_m : outside_m) = along_m;
    }
    const double at_m = std::max(0.0, inside_m - config.range_min_m);
    ring.push_back({middle_m + at_m * outwards.x(), at_m * outwards.y(), angle_rad});
  }
  return ring;
}

std::vector<float> ultrasound(const raycast::RayScene& rays, const Pose2& robot, const std::vector<Pose2>& ring,
                              const std::vector<Person>& people, const UltrasoundConfig& config,
                              std::uint64_t noise_seed, const std::vector<Box>& boxes) {
  std::mt19937_64 random(noise_seed);
  std::normal_distribution<float> noise_m(0.0F, static_cast<float>(config.noise_m));
  std::vector<float> ranges_m;
  for (const Pose2& mount : ring) {
    const Pose2 sensor = robot * mount;
    float range_m = std::numeric_limits<float>::infinity();
    for (int ray = 0; ray < config.rays; ++ray) {
      const double angle_rad =
          sensor.theta_rad + config.cone_rad * (static_cast<double>(ray) / (config.rays - 1) - 0.5);
      const Eigen::Vector3f direction(static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)),
                                      0.0F);
      for (const double height_m : config.heights_m) {
        const Eigen::Vector3f origin_m(static_cast<float>(sensor.x_m), static_cast<float>(sensor.y_m),
                                       static_cast<float>(height_m));
        const float far_m = std::min(static_cast<float>(config.range_max_m), range_m);
        range_m = std::min(range_m, nearest_m(rays, people, boxes, origin_m, direction, far_m));
      }
    }
    const float error_m = noise_m(random);
    const bool echoes = static_cast<double>(range_m) <= config.range_max_m;
    ranges_m.push_back(echoes ? std::max(static_cast<float>(config.range_min_m), range_m + error_m)
                              : std::numeric_limits<float>::infinity());
  }
  return ranges_m;
}

}  // namespace homeward::sim
