// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/generate/canvas.hpp"
#include "sim/generate/finish.hpp"
#include "sim/generate/furniture.hpp"
#include "sim/generate/ward_things.hpp"
#include "sim/generate/wards_plan.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

WardsSurfaces surfaces_of(SceneBuilder& scene, const WardsPlan& plan, Random& random) {
  constexpr std::array<Rgb, 4> kWalls = {{{214, 222, 208}, {208, 218, 224}, {226, 218, 200}, {220, 212, 214}}};
  constexpr std::array<Rgb, 4> kFloors = {{{140, 150, 152}, {150, 142, 128}, {126, 144, 130}, {134, 138, 158}}};
  const Rgb wall = varied(random, kWalls[static_cast<std::size_t>(pick(random, kWalls.size()))], 8);
  const Rgb floor = varied(random, kFloors[static_cast<std::size_t>(pick(random, kFloors.size()))], 10);
  const auto laid = [&](const char* name, Image texture, double tile_m, double tile_down_m) {
    return Surface{scene.add_material(name, std::move(texture)), tile_m, tile_down_m, true};
  };
  const Eigen::Vector2d& floor_m = plan.floor_tile_m;
  const Eigen::Vector2d& ceiling_m = plan.ceiling_tile_m;
  WardsSurfaces surfaces;
  surfaces.wall =
      laid("ward wall", paint_ward_wall(random, plan.wall_tile_m, kCeiling_m, wall), plan.wall_tile_m, kCeiling_m);
  surfaces.floor = laid("vinyl", paint_vinyl(random, floor_m.x(), floor_m.y(), floor), floor_m.x(), floor_m.y());
  surfaces.ceiling = laid("ceiling panels", paint_ceiling_panels(random, ceiling_m.x(), ceiling_m.y(), {226, 227, 225}),
                          ceiling_m.x(), ceiling_m.y());
  surfaces.rail = laid("rail", paint_wood(random, {172, 132, 90}), plan.wall_tile_m, 0.4);
  return surfaces;
}

/// Builds what stands in the modules, each in its own frame, so that all are alike.
class Fitter {
 public:
  Fitter(SceneBuilder& scene, const WardsPlan& plan, std::uint64_t seed) : scene_(scene), plan_(plan), seed_(seed) {
    Random random(seed * 37 + 7);
    materials_ = ward_materials(scene, random);
  }

  /// Beds, bedside cabinets and chairs along both side walls, and the door beside the ward's that is always shut.
  void fit_ward(bool north, int index) {
    const Pose2 module = plan_.module_frame(north, index);
    for (const bool right : {false, true}) {
      for (const double y_m : {1.25, 3.4}) {
        // Seen from the pillow the next bed is on the left at one wall and on the right at the other.
        const double up = right ? 1.0 : -1.0;
        const Pose2 head = at_side_wall(module, right, y_m);
        build_bed_wall(scene_, head, materials_);
        put(WardThing::kBed, head);
        put(WardThing::kCabinet, head * Pose2{up * 0.74, 0.0, 0.0});
        put(WardThing::kChair, head * Pose2{-up * 0.76, 0.0, 0.0});
      }
    }
    Random same(seed_ * 17 + 2);
    build_shut_door(scene_, corridor_wall(module, shut_door_m(plan_)), same);
  }

  /// A bed, a cabinet and a chair on either side of the cross corridor.
  void fit_bays(bool north, int index) {
    const Pose2 module = plan_.module_frame(north, index);
    const double back_m = 0.5 * plan_.width_m - kHalfWall_m;
    for (const double side : {1.0, -1.0}) {
      const auto at = [&](double from_end_m) {
        const double x_m = side > 0.0 ? from_end_m : plan_.module_m - from_end_m;
        return module * Pose2{x_m, back_m, 2.0 * kQuarter_rad};
      };
      build_bed_wall(scene_, at(0.65), materials_);
      put(WardThing::kBed, at(0.65));
      put(WardThing::kCabinet, at(1.38));
    }
  }

  /// A row of chairs at each end of a hall, and a desk in between.
  void fit_hall(int index) {
    const Pose2 module = plan_.module_frame(false, index);
    const double middle_m = 0.5 * plan_.width_m;
    for (const bool right : {false, true}) {
      for (const double y_m : {-1.2, -0.65, 0.65, 1.2})
        put(WardThing::kChair, at_side_wall(module, right, middle_m + y_m));
    }
    put(WardThing::kDesk, module * Pose2{0.5 * plan_.module_m, middle_m - 0.4, 0.0}, false);
  }

  /// Things that are there once, two of each of four kinds; one of the two stands a second time, where it would be in
  /// the other half.
  void scatter(Random& random) {
    constexpr int kThings = 8;
    const int first = pick(random, plan_.modules);
    for (int thing = 0; thing < kThings; ++thing) {
      // No two at one place: each kind has places of its own, and the two are in different modules.
      const bool north = pick(random, 2) == 0;
      const int index = (first + 2 * thing + thing / plan_.modules) % plan_.modules;
      const std::uint64_t looks = random();
      place(thing, north, index, looks);
      if (thing < kThings / 2) place(thing, !north, index, looks);
    }
  }

  [[nodiscard]] std::vector<Furniture> take() { return std::move(furniture_); }

 private:
  [[nodiscard]] Pose2 at_side_wall(const Pose2& module, bool right, double y_m) const {
    if (right) return module * Pose2{plan_.module_m - kHalfWall_m, y_m, kQuarter_rad};
    return module * Pose2{kHalfWall_m, y_m, -kQuarter_rad};
  }
  /// On the corridor's side of the wards' wall.
  [[nodiscard]] Pose2 corridor_wall(const Pose2& module, double x_m) const {
    return module * Pose2{x_m, plan_.ward_m + kHalfWall_m, 0.0};
  }

  /// Notes the triangles that `build` adds as one piece of furniture.
  template <class Build>
  void note(bool movable, const Build& build) {
    const Eigen::Index first = scene_.triangles();
    build();
    furniture_.push_back({"", first, scene_.triangles() - first, movable});
  }
  void put(WardThing thing, const Pose2& frame, bool movable = true) {
    note(movable, [&] { build_ward_thing(scene_, thing, frame, materials_); });
  }

  void place(int thing, bool north, int index, std::uint64_t looks) {
    Random random(looks);
    const Pose2 module = plan_.module_frame(north, index);
    constexpr double kEye_m = 1.55;
    switch (thing % 4) {
      case 0:
        return hang_picture(scene_, corridor_wall(module, 0.135 * plan_.module_m), 0.66, kEye_m, paint_picture(random));
      case 1:
        return hang_picture(scene_, module * Pose2{0.5 * plan_.module_m, kHalfWall_m, 0.0}, 0.62, kEye_m,
                            paint_picture(random));
      case 2:
        return note(true, [&] {
          build_plant(scene_, corridor_wall(module, 0.05 * plan_.module_m) * Pose2{0.0, 0.26, 0.0}, 1.25, random);
        });
      default:
        return put(WardThing::kTrolley, corridor_wall(module, ward_panel_m(plan_)));
    }
  }

  SceneBuilder& scene_;
  const WardsPlan& plan_;
  std::uint64_t seed_;
  WardMaterials materials_;
  std::vector<Furniture> furniture_;
};

std::vector<Lamp> light(SceneBuilder& scene, const WardsPlan& plan, std::uint64_t seed) {
  std::vector<Lamp> lamps;
  const double inner_m = plan.ward_m + plan.corridor_m;
  const double half_middle_m = 0.5 * plan.middle_m();
  for (const bool north : {false, true}) {
    for (int i = 0; i < plan.modules; ++i) {
      const auto add = [&](double x_share, double y_m) {
        const Pose2 at = plan.module_frame(north, i) * Pose2{x_share * plan.module_m, y_m, 0.0};
        Random same(seed * 19 + 3);
        lamps.push_back(build_lamp(scene, {at.x_m, at.y_m}, 1.0, same));
      };
      for (const double share : {0.25, 0.75}) add(share, 0.5 * plan.ward_m);
      for (const double share : {0.25, 0.75}) add(share, plan.ward_m + 0.5 * plan.corridor_m);
      if (!plan.has_cross(north, i)) {
        add(0.5, inner_m + 0.5 * half_middle_m);
        continue;
      }
      const double bay_share = 0.25 * (1.0 - plan.cross_m / plan.module_m);
      for (const double share : {bay_share, 0.5, 1.0 - bay_share}) add(share, inner_m + 0.5 * half_middle_m);
    }
  }
  return lamps;
}

}  // namespace

World generate_wards(std::uint64_t seed) {
  Random random(seed * 7541 + 19);
  SceneBuilder scene;
  const WardsPlan plan = plan_wards(random);
  const std::vector<Space> spaces = spaces_of(plan, surfaces_of(scene, plan, random));
  const std::vector<Doorway> doorways = doorways_of(plan);
  World world;
  world.doors = build_like_shells(scene, spaces, doorways, seed);
  Fitter fitter(scene, plan, seed);
  for (int i = 0; i < plan.modules; ++i) {
    for (const bool north : {false, true}) {
      fitter.fit_ward(north, i);
      if (plan.has_cross(north, i)) fitter.fit_bays(north, i);
    }
    if (!plan.has_cross(false, i)) fitter.fit_hall(i);
  }
  fitter.scatter(random);
  world.lamps = light(scene, plan, seed);
  world.name = "wards:" + std::to_string(seed);
  world.scene = scene.take();
  world.furniture = fitter.take();
  finish_world(world, spaces);
  name_rooms_of(world);
  return world;
}

}  // namespace homeward::sim
