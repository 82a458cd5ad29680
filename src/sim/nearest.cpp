// SPDX-License-Identifier: Apache-2.0
#include "sim/nearest.hpp"

#include <limits>

namespace homeward::sim {

float nearest_m(const RayScene& rays, const std::vector<Person>& people, const std::vector<Box>& boxes,
                const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction, float far_m) {
  float nearest = std::numeric_limits<float>::infinity();
  const auto take = [&](const auto& met) {
    if (met && met->distance_m < nearest && met->distance_m <= far_m) nearest = met->distance_m;
  };
  take(rays.first_hit(origin_m, direction, far_m));
  for (const Person& person : people) take(hit_person(person, origin_m, direction));
  for (const Box& box : boxes) take(hit_box(box, origin_m, direction));
  return nearest;
}

}  // namespace homeward::sim
