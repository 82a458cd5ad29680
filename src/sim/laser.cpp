// SPDX-License-Identifier: Apache-2.0
#include "sim/laser.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"
#include "sim/nearest.hpp"

namespace homeward::sim {

std::vector<float> scan(const RayScene& rays, const Pose2& robot, const std::vector<Person>& people,
                        const LaserConfig& config, std::uint64_t noise_seed, const std::vector<Box>& boxes) {
  std::mt19937_64 random(noise_seed);
  std::normal_distribution<float> noise_m(0.0F, static_cast<float>(config.noise_m));
  std::vector<float> ranges_m(static_cast<std::size_t>(config.rays), std::numeric_limits<float>::infinity());
  for (int i = 0; i < config.rays; ++i) {
    const double angle_rad = robot.theta_rad + 2.0 * kPi * i / config.rays;
    const Eigen::Vector3f direction(static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)),
                                    0.0F);
    float range_m = std::numeric_limits<float>::infinity();
    for (const double height_m : config.heights_m) {
      const Eigen::Vector3f origin_m(static_cast<float>(robot.x_m), static_cast<float>(robot.y_m),
                                     static_cast<float>(height_m));
      const float far_m = std::min(static_cast<float>(config.range_max_m), range_m);
      range_m = std::min(range_m, nearest_m(rays, people, boxes, origin_m, direction, far_m));
    }
    const float error_m = noise_m(random);  // drawn always: a ray's noise does not depend on what others meet
    if (static_cast<double>(range_m) <= config.range_max_m) {
      ranges_m[static_cast<std::size_t>(i)] = std::max(0.0F, range_m + error_m);
    }
  }
  return ranges_m;
}

}  // namespace homeward::sim
