// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/ward_things.hpp"

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

/// Boxes of one thing.
struct Bench : FramedBoxes {
  void legs(double half_m, double y0, double y1, double height_m, Surface surface) const {
    constexpr double kThick_m = 0.04;
    for (const double x : {-half_m, half_m - kThick_m}) {
      for (const double y : {y0, y1 - kThick_m}) box(x, x + kThick_m, y, y + kThick_m, 0.0, height_m, surface);
    }
  }
};

void bed(const Bench& at, const WardMaterials& of) {
  constexpr double kHalf_m = 0.46;
  constexpr double kLong_m = 2.08;
  at.legs(kHalf_m - 0.04, 0.12, kLong_m - 0.1, 0.36, of.steel);
  at.box(-kHalf_m, kHalf_m, 0.08, kLong_m, 0.36, 0.44, of.steel);
  at.box(-kHalf_m, kHalf_m, 0.06, 0.1, 0.36, 1.02, of.headboard, of.enamel);
  at.box(-kHalf_m, kHalf_m, kLong_m - 0.04, kLong_m, 0.36, 0.86, of.headboard, of.enamel);
  at.box(-kHalf_m + 0.02, kHalf_m - 0.02, 0.1, kLong_m - 0.04, 0.44, 0.58, of.sheet);
  at.box(-kHalf_m + 0.01, kHalf_m - 0.01, 0.75, kLong_m - 0.05, 0.5, 0.61, of.blanket);
  at.box(-0.3, 0.3, 0.14, 0.52, 0.58, 0.68, of.sheet);
  // Side rails.
  for (const double x : {-kHalf_m, kHalf_m - 0.02}) {
    at.box(x, x + 0.02, 0.5, 1.3, 0.74, 0.78, of.steel);
    at.box(x, x + 0.02, 0.5, 0.54, 0.44, 0.78, of.steel);
    at.box(x, x + 0.02, 1.26, 1.3, 0.44, 0.78, of.steel);
  }
}

void cabinet(const Bench& at, const WardMaterials& of) {
  at.box(-0.22, 0.22, 0.06, 0.48, 0.08, 0.82, of.drawers, of.enamel);
  at.box(-0.24, 0.24, 0.06, 0.5, 0.82, 0.85, of.headboard);
  at.scene.cylinder(at.frame, {0.08, 0.22, 0.85}, 0.04, 0.14, of.enamel);
}

void chair(const Bench& at, const WardMaterials& of) {
  at.legs(0.22, 0.08, 0.5, 0.44, of.steel);
  at.box(-0.23, 0.23, 0.08, 0.5, 0.42, 0.48, of.seat);
  at.box(-0.23, 0.23, 0.08, 0.12, 0.5, 0.9, of.seat);
}

void trolley(const Bench& at, const WardMaterials& of) {
  at.legs(0.42, 0.08, 0.52, 0.98, of.steel);
  for (const double z : {0.2, 0.55, 0.86}) at.box(-0.42, 0.42, 0.08, 0.52, z, z + 0.03, of.steel);
  at.box(-0.38, 0.05, 0.12, 0.48, 0.23, 0.45, of.supplies, of.sheet);
  at.box(-0.3, 0.34, 0.14, 0.46, 0.58, 0.74, of.supplies, of.blanket);
  at.box(-0.36, 0.0, 0.14, 0.44, 0.89, 1.12, of.supplies, of.sheet);
}

void desk(const Bench& at, const WardMaterials& of) {
  at.box(-1.0, 1.0, 0.1, 0.18, 0.0, 1.05, of.headboard);
  at.box(-1.0, 1.0, 0.18, 0.75, 0.72, 0.76, of.enamel);
  at.box(-1.0, -0.55, 0.18, 0.7, 0.05, 0.72, of.drawers, of.enamel);
  at.box(0.55, 1.0, 0.18, 0.7, 0.05, 0.72, of.drawers, of.enamel);
  at.box(-1.05, 1.05, 0.05, 0.3, 1.05, 1.09, of.enamel);
}

}  // namespace

WardMaterials ward_materials(SceneBuilder& scene, Random& random) {
  const auto painted = [&](const char* name, Image texture, double tile_m) {
    return Surface{scene.add_material(name, std::move(texture)), tile_m};
  };
  const Rgb calm = scaled(rich_colour(random), 1.25);
  WardMaterials of;
  of.steel = {scene.add_material("steel", std::array<float, 3>{0.45F, 0.46F, 0.48F}), 0.0};
  of.enamel = painted("enamel", paint_wood(random, {222, 224, 224}), 1.2);
  of.blanket = painted("blanket", paint_fabric(random, calm, Weave::kChecks), 0.7);
  of.sheet = painted("sheet", paint_fabric(random, {230, 231, 228}, Weave::kStripes), 0.6);
  of.drawers = painted("drawers", paint_cabinet(random, {214, 206, 188}, 1, 2), 0.0);
  of.headboard = painted("beech", paint_wood(random, {198, 164, 118}), 0.8);
  of.seat = painted("seat", paint_fabric(random, scaled(calm, 0.8), Weave::kPlain), 0.5);
  of.supplies = painted("supplies", paint_books(random, 1, {190, 192, 194}), 0.0);
  of.notes = painted("bed board", paint_notes(random, {238, 240, 240}), 0.0);
  of.outlets = painted("outlets", paint_oven(random), 0.0);
  return of;
}

void build_ward_thing(SceneBuilder& scene, WardThing thing, const Pose2& frame, const WardMaterials& materials) {
  const Bench at{{scene, frame}};
  switch (thing) {
    case WardThing::kBed:
      return bed(at, materials);
    case WardThing::kCabinet:
      return cabinet(at, materials);
    case WardThing::kChair:
      return chair(at, materials);
    case WardThing::kTrolley:
      return trolley(at, materials);
    case WardThing::kDesk:
      return desk(at, materials);
  }
}

void build_bed_wall(SceneBuilder& scene, const Pose2& frame, const WardMaterials& materials) {
  const Bench at{{scene, frame}};
  at.box(-0.75, 0.75, 0.0, 0.05, 1.22, 1.36, materials.enamel);
  for (const double x : {-0.5, 0.38}) at.box(x, x + 0.12, 0.05, 0.055, 1.23, 1.35, materials.outlets, materials.steel);
  at.box(-0.2, 0.2, 0.0, 0.02, 1.62, 1.9, materials.notes, materials.steel);
}

}  // namespace homeward::sim
