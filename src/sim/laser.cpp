// SPDX-License-Identifier: Apache-2.0
#include "sim/laser.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"
#include "sim/hash.hpp"
#include "sim/nearest.hpp"
#include "sim/random.hpp"

namespace homeward::sim {
namespace {

constexpr double kSpuriousLeast_m = 0.02;
constexpr double kSpuriousMost_m = 32.0;

}  // namespace

std::vector<float> scan(const raycast::RayScene& rays, const Pose2& robot, const std::vector<Person>& people,
                        const LaserConfig& config, std::uint64_t noise_seed, const std::vector<Box>& boxes) {
  std::mt19937_64 random(noise_seed);
  std::normal_distribution<float> noise_m(0.0F, static_cast<float>(config.noise_m));
  Random faults(mix(noise_seed + 1));  // apart from the noise, which so is the same with faults and without
  std::vector<float> ranges_m(static_cast<std::size_t>(config.rays), std::numeric_limits<float>::infinity());
  for (int i = 0; i < config.rays; ++i) {
    const double angle_rad = robot.theta_rad + 2.0 * kPi * i / config.rays;
    const Eigen::Vector3f direction(static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)),
                                    0.0F);
    // Drawn always, like the noise: a ray's faults do not depend on what others meet.
    const bool through_panes = uniform(faults, 0.0, 1.0) < config.glass_share;
    const bool spurious = uniform(faults, 0.0, 1.0) < config.spurious_share;
    const double spurious_m = uniform(faults, kSpuriousLeast_m, kSpuriousMost_m);
    float range_m = std::numeric_limits<float>::infinity();
    for (const double height_m : config.heights_m) {
      const Eigen::Vector3f origin_m(static_cast<float>(robot.x_m), static_cast<float>(robot.y_m),
                                     static_cast<float>(height_m));
      const float far_m = std::min(static_cast<float>(config.range_max_m), range_m);
      const auto nearest = through_panes ? nearest_through_panes_m : nearest_m;
      range_m = std::min(range_m, nearest(rays, people, boxes, origin_m, direction, far_m));
    }
    const float error_m = noise_m(random);  // drawn always: a ray's noise does not depend on what others meet
    if (static_cast<double>(range_m) <= config.range_max_m) {
      ranges_m[static_cast<std::size_t>(i)] = std::max(0.0F, range_m + error_m);
    }
    if (spurious) ranges_m[static_cast<std::size_t>(i)] = static_cast<float>(spurious_m);
  }
  return ranges_m;
}

}  // namespace homeward::sim
