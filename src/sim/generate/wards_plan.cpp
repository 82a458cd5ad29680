// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/wards_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace homeward::sim {
namespace {

constexpr double kDoor_m = 1.15;
constexpr double kFront_m = 1.6;  // open front of a bay
constexpr double kPanel_m = 2.0;
constexpr double kParapet_m = 1.0;

/// Whole numbers of tiles, each about `wanted_m` long, along `length_m`.
double fitting_m(double length_m, double wanted_m) { return length_m / std::max(1.0, std::round(length_m / wanted_m)); }

/// The half's own rectangle from `least` to `most` in a module, as a space of the world.
Space space_in(const WardsPlan& plan, bool north, int index, const Eigen::Vector2d& least, const Eigen::Vector2d& most,
               const WardsSurfaces& surfaces) {
  const Pose2 frame = plan.module_frame(north, index);
  const Pose2 a = frame * Pose2{least.x(), least.y(), 0.0};
  const Pose2 b = frame * Pose2{most.x(), most.y(), 0.0};
  return {.name = "",
          .least_m = {std::min(a.x_m, b.x_m), std::min(a.y_m, b.y_m)},
          .most_m = {std::max(a.x_m, b.x_m), std::max(a.y_m, b.y_m)},
          .floor = surfaces.floor,
          .wall = surfaces.wall,
          .ceiling = surfaces.ceiling,
          .windows = {},
          .rail = surfaces.rail,
          .turned = north};
}

Space ward(const WardsPlan& plan, bool north, int index, const WardsSurfaces& surfaces) {
  Space space = space_in(plan, north, index, {0.0, 0.0}, {plan.module_m, plan.ward_m}, surfaces);
  for (const double share : {0.26, 0.74}) {
    space.windows.push_back({north ? Side::kNorth : Side::kSouth, share * plan.module_m - kHalfWall_m, 1.7});
  }
  return space;
}

Space corridor(const WardsPlan& plan, bool north, const WardsSurfaces& surfaces) {
  Space space =
      space_in(plan, north, 0, {0.0, plan.ward_m}, {plan.length_m(), plan.ward_m + plan.corridor_m}, surfaces);
  const double middle_m = 0.5 * plan.corridor_m - kHalfWall_m;
  space.windows = {{Side::kWest, middle_m, 1.0}, {Side::kEast, middle_m, 1.0}};
  return space;
}

}  // namespace

Pose2 WardsPlan::module_frame(bool north, int index) const {
  if (!north) return {index * module_m, 0.0, 0.0};
  return {(modules - index) * module_m, width_m, std::numbers::pi};
}

bool WardsPlan::has_cross(bool north, int index) const {
  return crosses[static_cast<std::size_t>(north ? modules - 1 - index : index)];
}

bool WardsPlan::has_hall_door(bool north, int index) const {
  const int from_west = north ? modules - 1 - index : index;
  return north == (2 * from_west >= modules);
}

WardsPlan plan_wards(Random& random) {
  WardsPlan plan;
  plan.modules = 5 + pick(random, 2);
  plan.module_m = plan.modules == 5 ? uniform(random, 8.1, 10.0) : uniform(random, 8.1, 9.2);
  // Every module has a whole number of tiles, so that what stands at one place of it stands on the same pattern in all.
  const auto along = [&] { return plan.module_m / (2 + pick(random, 3)); };
  plan.wall_tile_m = along();
  const double floor_m = along();
  const double ceiling_m = along();
  plan.width_m = plan.wall_tile_m * std::ceil(20.5 / plan.wall_tile_m);
  plan.floor_tile_m = {floor_m, fitting_m(plan.width_m, floor_m)};
  plan.ceiling_tile_m = {ceiling_m, fitting_m(plan.width_m, ceiling_m)};
  plan.corridor_m = uniform(random, 2.3, 2.6);
  plan.ward_m = uniform(random, 0.335, 0.35) * (plan.width_m - 2.0 * plan.corridor_m);
  const int wanted = 2 + pick(random, plan.modules == 5 ? 3 : 2);
  plan.crosses.assign(static_cast<std::size_t>(plan.modules), false);
  plan.crosses.front() = plan.crosses.back() = true;
  if (wanted == 3) plan.crosses[2] = true;
  if (wanted == 4) plan.crosses[1] = plan.crosses[3] = true;
  return plan;
}

double ward_door_m(const WardsPlan& plan) { return 0.3 * plan.module_m; }
double ward_panel_m(const WardsPlan& plan) { return 0.53 * plan.module_m + 0.5 * kPanel_m; }
double shut_door_m(const WardsPlan& plan) { return 0.9 * plan.module_m; }

std::vector<Space> spaces_of(const WardsPlan& plan, const WardsSurfaces& surfaces) {
  std::vector<Space> corridors, crosses, wards, halls, bays;
  const auto add = [](std::vector<Space>& to, const char* kind, Space space) {
    space.name = kind + std::to_string(to.size() + 1);
    to.push_back(std::move(space));
  };
  const double inner_m = plan.ward_m + plan.corridor_m;
  const double bay_m = 0.5 * (plan.module_m - plan.cross_m);
  for (const bool north : {false, true}) {
    add(corridors, "corridor_", corridor(plan, north, surfaces));
    for (int i = 0; i < plan.modules; ++i) {
      add(wards, "ward_", ward(plan, north, i, surfaces));
      const double middle_m = inner_m + plan.middle_m();
      if (!plan.has_cross(north, i)) {
        if (!north) {
          add(halls, "hall_", space_in(plan, north, i, {0.0, inner_m}, {plan.module_m, middle_m}, surfaces));
        }
        continue;
      }
      if (!north) {
        add(crosses, "cross_", space_in(plan, north, i, {bay_m, inner_m}, {bay_m + plan.cross_m, middle_m}, surfaces));
      }
      const double half_m = 0.5 * plan.width_m;
      add(bays, "bay_", space_in(plan, north, i, {0.0, inner_m}, {bay_m, half_m}, surfaces));
      add(bays, "bay_", space_in(plan, north, i, {bay_m + plan.cross_m, inner_m}, {plan.module_m, half_m}, surfaces));
    }
  }
  std::vector<Space> all;
  for (const auto* kind : {&corridors, &crosses, &wards, &halls, &bays})
    all.insert(all.end(), kind->begin(), kind->end());
  return all;
}

std::vector<Doorway> doorways_of(const WardsPlan& plan) {
  std::vector<Doorway> doorways;
  const double bay_m = 0.5 * (plan.module_m - plan.cross_m);
  const double inner_m = plan.ward_m + plan.corridor_m;
  for (const bool north : {false, true}) {
    for (int i = 0; i < plan.modules; ++i) {
      const auto add = [&](double x_m, double y_m, double opening_m, bool leaf, double sill_m) {
        const Pose2 at = plan.module_frame(north, i) * Pose2{x_m, y_m, 0.0};
        doorways.push_back({.centre_m = {at.x_m, at.y_m},
                            .in_x_wall = true,
                            .width_m = opening_m,
                            .height_m = 2.1,
                            .leaf = leaf,
                            .sill_m = sill_m,
                            .turned = north});
      };
      add(ward_door_m(plan), plan.ward_m, kDoor_m, true, 0.0);
      if (i % 2 == 0) add(ward_panel_m(plan), plan.ward_m, kPanel_m, false, kParapet_m);
      if (plan.has_cross(north, i)) {
        // A bay's bed stands away from the cross corridor, and its front is open on the other side.
        add(0.58 * bay_m, inner_m, kFront_m, false, 0.0);
        add(0.5 * plan.module_m, inner_m, 1.7, false, 0.0);
        add(plan.module_m - 0.58 * bay_m, inner_m, kFront_m, false, 0.0);
      } else if (plan.has_hall_door(north, i)) {
        add(0.3 * plan.module_m, inner_m, kDoor_m, true, 0.0);
        add(0.7 * plan.module_m, inner_m, kPanel_m, false, kParapet_m);
      } else {
        add(0.3 * plan.module_m, inner_m, kPanel_m, false, kParapet_m);
        add(0.7 * plan.module_m, inner_m, kPanel_m, false, kParapet_m);
      }
    }
  }
  return doorways;
}

}  // namespace homeward::sim
