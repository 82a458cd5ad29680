// SPDX-License-Identifier: Apache-2.0
#include "sim/nearest.hpp"

#include <limits>
#include <optional>

namespace homeward::sim {

namespace {

float nearest_of(const std::optional<raycast::Hit>& world, const std::vector<Person>& people,
                 const std::vector<Box>& boxes, const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction,
                 float far_m) {
  float nearest = std::numeric_limits<float>::infinity();
  const auto take = [&](const auto& met) {
    if (met && met->distance_m < nearest && met->distance_m <= far_m) nearest = met->distance_m;
  };
  take(world);
  for (const Person& person : people) take(hit_person(person, origin_m, direction));
  for (const Box& box : boxes) take(hit_box(box, origin_m, direction));
  return nearest;
}

}  // namespace

float nearest_m(const raycast::RayScene& rays, const std::vector<Person>& people, const std::vector<Box>& boxes,
                const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction, float far_m) {
  return nearest_of(rays.first_hit(origin_m, direction, far_m), people, boxes, origin_m, direction, far_m);
}

float nearest_through_panes_m(const raycast::RayScene& rays, const std::vector<Person>& people,
                              const std::vector<Box>& boxes, const Eigen::Vector3f& origin_m,
                              const Eigen::Vector3f& direction, float far_m) {
  std::optional<raycast::Hit> world = rays.first_hit(origin_m, direction, far_m);
  if (world && rays.is_pane(world->triangle)) world.reset();
  return nearest_of(world, people, boxes, origin_m, direction, far_m);
}

}  // namespace homeward::sim
