// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/furniture.hpp"

#include <cmath>
#include <numbers>

#include "sim/generate/canvas.hpp"

namespace homeward::sim {
namespace {

using Eigen::Vector3d;

/// One piece in the making: the scene, where it stands and what it is made of.
struct Workshop : FramedBoxes {
  Random& random;
  PieceSize size;

  [[nodiscard]] int material(const char* name, Image texture) const {
    return scene.add_material(name, std::move(texture));
  }
  [[nodiscard]] Surface wood() const { return {material("wood", paint_wood(random, wood_colour())), 0.7}; }
  [[nodiscard]] Surface cloth(Weave weave) const {
    return {material("cloth", paint_fabric(random, rich_colour(random), weave)), 0.5};
  }
  [[nodiscard]] Rgb wood_colour() const {
    constexpr std::array<Rgb, 5> kWoods = {
        {{150, 105, 65}, {110, 72, 45}, {190, 150, 105}, {215, 205, 190}, {85, 58, 42}}};
    return varied(random, kWoods[static_cast<std::size_t>(pick(random, kWoods.size()))], 12);
  }
  void legs(double x0, double x1, double y0, double y1, double height, double thick, Surface surface) const {
    for (const double x : {x0, x1 - thick}) {
      for (const double y : {y0, y1 - thick}) box(x, x + thick, y, y + thick, 0, height, surface);
    }
  }
};

void chair(const Workshop& at, double x, double y, double facing_rad, Surface wood, Surface seat) {
  const Pose2 here = at.frame * Pose2{x, y, facing_rad};
  const Workshop own{{at.scene, here}, at.random, {}};
  own.legs(-0.21, 0.21, -0.21, 0.21, 0.44, 0.04, wood);
  own.box(-0.22, 0.22, -0.22, 0.22, 0.44, 0.49, seat);
  own.box(-0.22, 0.22, -0.22, -0.18, 0.49, 0.92, seat, wood);
}

void wardrobe(const Workshop& at) {
  const Rgb colour = at.wood_colour();
  const Surface front{at.material("wardrobe", paint_cabinet(at.random, colour, 3, 1)), 0.0};
  const Surface side{at.material("wood", paint_wood(at.random, colour)), 0.8};
  at.box(-0.5 * at.size.width_m, 0.5 * at.size.width_m, 0.01, at.size.depth_m, 0, at.size.height_m, front, side);
}

void bookshelf(const Workshop& at) {
  const Rgb colour = at.wood_colour();
  const Surface front{at.material("books", paint_books(at.random, 5, colour)), 0.0};
  const Surface side{at.material("wood", paint_wood(at.random, colour)), 0.8};
  at.box(-0.5 * at.size.width_m, 0.5 * at.size.width_m, 0.01, at.size.depth_m, 0, at.size.height_m, front, side);
}

void bed(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Surface wood = at.wood();
  const Surface blanket = at.cloth(pick(at.random, 2) == 0 ? Weave::kFlowers : Weave::kChecks);
  const Surface sheet{at.material("sheet", paint_fabric(at.random, {225, 222, 214}, Weave::kStripes)), 0.5};
  at.box(-half, half, 0.01, 0.07, 0, 1.05, wood);
  at.box(-half, half, 0.07, at.size.depth_m, 0.12, 0.32, wood);
  at.legs(-half, half, 0.07, at.size.depth_m, 0.12, 0.06, wood);
  at.box(-half + 0.02, half - 0.02, 0.07, at.size.depth_m - 0.02, 0.32, 0.5, sheet);
  at.box(-half, half, 0.65, at.size.depth_m, 0.3, 0.55, blanket);
  for (const double x : {-0.5 * half, 0.5 * half}) {
    at.box(x - 0.3, x + 0.3, 0.1, 0.5, 0.5, 0.62, at.cloth(Weave::kPlain));
  }
}

void nightstand(const Workshop& at) {
  const Rgb colour = at.wood_colour();
  at.box(-0.22, 0.22, 0.01, 0.4, 0, 0.5, {at.material("drawer", paint_cabinet(at.random, colour, 1, 1)), 0.0},
         {at.material("wood", paint_wood(at.random, colour)), 0.6});
  at.scene.cylinder(at.frame, {0, 0.2, 0.5}, 0.03, 0.2, at.wood());
  at.scene.cylinder(at.frame, {0, 0.2, 0.7}, 0.12, 0.2, at.cloth(Weave::kPlain));
}

void desk(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Surface wood = at.wood();
  at.box(-half, half, 0.01, 0.7, 0.7, 0.74, wood);
  at.legs(-half, half, 0.02, 0.7, 0.7, 0.05, wood);
  at.box(half - 0.42, half - 0.02, 0.05, 0.68, 0.1, 0.7,
         {at.material("drawers", paint_cabinet(at.random, at.wood_colour(), 1, 3)), 0.0}, wood);
  const Surface dark{at.scene.add_material("plastic", std::array<float, 3>{0.05F, 0.05F, 0.055F}), 0.0};
  at.box(-0.3, 0.3, 0.12, 0.16, 0.86, 1.22, {at.material("screen", paint_screen(at.random)), 0.0}, dark);
  at.box(-0.04, 0.04, 0.12, 0.16, 0.74, 0.86, dark);
  at.box(-0.24, 0.22, 0.4, 0.55, 0.74, 0.765, {at.material("keys", paint_notes(at.random, {210, 210, 212})), 0.0});
  at.box(-half + 0.05, -half + 0.33, 0.15, 0.4, 0.74, 0.92,
         {at.material("books", paint_books(at.random, 1, at.wood_colour())), 0.0}, wood);
  chair(at, -0.15, 0.78, std::numbers::pi, wood, at.cloth(Weave::kPlain));
}

void sofa(const Workshop& at, Weave weave) {
  const double half = 0.5 * at.size.width_m;
  const Surface cloth = at.cloth(weave);
  at.box(-half, half, 0.02, 0.25, 0.08, 0.82, cloth);
  at.box(-half, half, 0.25, at.size.depth_m, 0.08, 0.44, cloth);
  at.box(-half, -half + 0.18, 0.25, at.size.depth_m, 0.44, 0.62, cloth);
  at.box(half - 0.18, half, 0.25, at.size.depth_m, 0.44, 0.62, cloth);
  for (int cushion = 0; cushion < (at.size.width_m > 1.2 ? 3 : 1); ++cushion) {
    const double x = at.size.width_m > 1.2 ? -0.55 + 0.5 * cushion : -0.18;
    at.box(x, x + 0.38, 0.25, 0.38, 0.46, 0.8, at.cloth(static_cast<Weave>(pick(at.random, 4))));
  }
}

void television(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Rgb colour = at.wood_colour();
  at.box(-half, half, 0.01, at.size.depth_m, 0, 0.48,
         {at.material("cabinet", paint_cabinet(at.random, colour, 4, 1)), 0.0},
         {at.material("wood", paint_wood(at.random, colour)), 0.8});
  const Surface dark{at.scene.add_material("plastic", std::array<float, 3>{0.04F, 0.04F, 0.045F}), 0.0};
  at.box(-0.55, 0.55, 0.1, 0.15, 0.56, 1.2, {at.material("television", paint_screen(at.random)), 0.0}, dark);
  at.box(-0.2, 0.2, 0.08, 0.3, 0.48, 0.56, dark);
  at.scene.cylinder(at.frame, {-half + 0.15, 0.22, 0.48}, 0.07, 0.28, at.cloth(Weave::kStripes));
}

void sideboard(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Rgb colour = at.wood_colour();
  at.box(-half, half, 0.01, at.size.depth_m, 0, at.size.height_m,
         {at.material("cabinet", paint_cabinet(at.random, colour, 4, 2)), 0.0},
         {at.material("wood", paint_wood(at.random, colour)), 0.8});
  at.scene.cylinder(at.frame, {-0.5 * half, 0.2, at.size.height_m}, 0.09, 0.3, at.cloth(Weave::kFlowers));
  at.box(0.2 * half, 0.2 * half + 0.26, 0.12, 0.15, at.size.height_m, at.size.height_m + 0.22,
         {at.material("photo", paint_picture(at.random)), 0.0}, at.wood());
  at.box(-0.1 * half, 0.1 * half, 0.1, 0.26, at.size.height_m, at.size.height_m + 0.13,
         {at.material("books", paint_books(at.random, 1, colour)), 0.0}, at.wood());
}

void counter(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Rgb colour = varied(at.random, {205, 200, 190}, 40);
  const Surface front{at.material("kitchen", paint_cabinet(at.random, colour, 3, 1)), 0.0};
  const Surface side{at.material("wood", paint_wood(at.random, colour)), 0.8};
  const Surface slab{at.material("slab", paint_tiles(at.random, {90, 88, 85}, {100, 98, 95})), 0.9};
  at.box(-half, half - 0.6, 0.01, 0.58, 0.05, 0.86, front, side);
  at.box(half - 0.6, half, 0.01, 0.58, 0.05, 0.86, {at.material("oven", paint_oven(at.random)), 0.0}, side);
  at.box(-half, half, 0.01, 0.62, 0.86, 0.91, slab);
  at.scene.quad(at.frame,
                {Vector3d(half, 0.012, 1.45), {-half, 0.012, 1.45}, {-half, 0.012, 0.91}, {half, 0.012, 0.91}},
                {at.material("splash", paint_tiles(at.random, rich_colour(at.random), {225, 225, 220})), 0.6});
  at.box(-half, half, 0.01, 0.34, 1.45, 2.1, {at.material("kitchen", paint_cabinet(at.random, colour, 4, 1)), 0.0},
         side);
  for (int jar = 0; jar < 4; ++jar) {
    at.scene.cylinder(at.frame, {-half + 0.2 + 0.17 * jar, 0.2, 0.91}, 0.055, uniform(at.random, 0.12, 0.26),
                      at.cloth(static_cast<Weave>(pick(at.random, 4))));
  }
}

void fridge(const Workshop& at) {
  const Surface white{at.material("enamel", paint_wood(at.random, {222, 222, 224})), 1.2};
  at.box(-0.31, 0.31, 0.02, 0.64, 0.02, at.size.height_m, white);
  const Surface note{at.material("notes", paint_notes(at.random, {240, 235, 200})), 0.0};
  const double y = 0.642;
  at.scene.quad(at.frame, {Vector3d(0.2, y, 1.6), {-0.05, y, 1.6}, {-0.05, y, 1.3}, {0.2, y, 1.3}}, note);
  at.scene.quad(at.frame, {Vector3d(-0.08, y, 1.5), {-0.26, y, 1.5}, {-0.26, y, 1.25}, {-0.08, y, 1.25}},
                {at.material("postcard", paint_picture(at.random)), 0.0});
  const Surface steel{at.scene.add_material("steel", std::array<float, 3>{0.4F, 0.4F, 0.42F}), 0.0};
  at.box(-0.28, -0.25, 0.64, 0.68, 0.7, 1.15, steel);
  at.box(-0.3, 0.3, 0.64, 0.645, 1.18, 1.19, steel);
}

void console(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Surface wood = at.wood();
  at.box(-half, half, 0.01, at.size.depth_m, 0.74, 0.79, wood);
  at.legs(-half, half, 0.02, at.size.depth_m, 0.74, 0.04, wood);
  at.box(-half + 0.04, half - 0.04, 0.02, at.size.depth_m - 0.02, 0.55, 0.74,
         {at.material("drawers", paint_cabinet(at.random, at.wood_colour(), 3, 1)), 0.0}, wood);
  at.scene.cylinder(at.frame, {-0.6 * half, 0.15, 0.79}, 0.06, 0.27, at.cloth(static_cast<Weave>(pick(at.random, 4))));
  at.box(0.1 * half, 0.8 * half, 0.06, 0.2, 0.79, 0.93,
         {at.material("books", paint_books(at.random, 1, {120, 90, 60})), 0.0}, wood);
}

void coats(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  at.box(-half, half, 0.005, 0.03, 1.62, 1.74, at.wood());
  for (int coat = 0; coat < 4; ++coat) {
    const double x = -half + 0.08 + 0.26 * coat;
    at.box(x, x + 0.2, 0.03, 0.11, uniform(at.random, 0.7, 1.0), 1.66,
           at.cloth(static_cast<Weave>(pick(at.random, 4))));
  }
}

void bath(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Surface white{at.material("enamel", paint_wood(at.random, {228, 228, 230})), 1.5};
  const Surface tiles{at.material("tiles", paint_tiles(at.random, rich_colour(at.random), {215, 220, 222})), 0.7};
  at.box(-half, half, 0.01, at.size.depth_m, 0, 0.5, tiles);
  at.box(-half, half, 0.01, 0.1, 0.5, 0.56, white);
  at.box(-half, half, at.size.depth_m - 0.09, at.size.depth_m, 0.5, 0.56, white);
  at.scene.quad(at.frame,
                {Vector3d(half, 0.02, 1.9), {half - 0.8, 0.02, 1.9}, {half - 0.8, 0.02, 0.5}, {half, 0.02, 0.5}},
                at.cloth(Weave::kStripes));
}

void basin(const Workshop& at) {
  const Rgb colour = at.wood_colour();
  const Surface white{at.material("enamel", paint_wood(at.random, {228, 228, 230})), 1.5};
  at.box(-0.3, 0.3, 0.01, 0.45, 0.1, 0.72, {at.material("cabinet", paint_cabinet(at.random, colour, 2, 1)), 0.0},
         {at.material("wood", paint_wood(at.random, colour)), 0.7});
  at.box(-0.33, 0.33, 0.01, 0.5, 0.72, 0.86, white);
  at.box(-0.28, 0.28, 0.01, 0.03, 1.15, 1.75, {at.material("poster", paint_notes(at.random, {205, 222, 230})), 0.0},
         white);
  at.box(-0.75, -0.45, 0.01, 0.05, 0.9, 1.5, at.cloth(Weave::kStripes));
}

void washing_machine(const Workshop& at) {
  const Surface white{at.material("enamel", paint_wood(at.random, {222, 222, 226})), 1.2};
  at.box(-0.3, 0.3, 0.02, 0.58, 0.02, 0.86, {at.material("washer", paint_oven(at.random)), 0.0}, white);
  at.box(-0.25, 0.1, 0.1, 0.45, 0.86, 1.06, at.cloth(Weave::kChecks));
}

void piano(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Surface black{at.material("lacquer", paint_wood(at.random, {52, 34, 28})), 0.9};
  at.box(-half, half, 0.02, 0.35, 0, 1.2, {at.material("panels", paint_cabinet(at.random, {60, 40, 32}, 3, 1)), 0.0},
         black);
  at.box(-half, half, 0.35, 0.6, 0.62, 0.72, {at.material("keys", paint_books(at.random, 1, {235, 232, 225})), 0.0},
         black);
  at.box(-0.3, 0.3, 0.3, 0.33, 1.2, 1.45, {at.material("music", paint_notes(at.random, {240, 236, 222})), 0.0}, black);
}

void table_with_chairs(const Workshop& at) {
  const Surface wood = at.wood();
  const Surface seat = at.cloth(static_cast<Weave>(pick(at.random, 4)));
  const double y = 0.5 * at.size.depth_m;
  at.box(-0.75, 0.75, y - 0.4, y + 0.4, 0.7, 0.75, wood);
  at.legs(-0.7, 0.7, y - 0.36, y + 0.36, 0.7, 0.06, wood);
  at.box(-0.5, 0.5, y - 0.2, y + 0.2, 0.75, 0.755, at.cloth(Weave::kChecks));
  at.scene.cylinder(at.frame, {0, y, 0.755}, 0.1, 0.14, at.cloth(Weave::kFlowers));
  for (const double x : {-0.4, 0.4}) {
    chair(at, x, y - 0.5, 0.0, wood, seat);
    chair(at, x, y + 0.5, std::numbers::pi, wood, seat);
  }
}

void whiteboard(const Workshop& at) {
  at.box(-0.7, 0.7, 0.005, 0.03, 1.0, 1.9, {at.material("whiteboard", paint_notes(at.random, {238, 240, 242})), 0.0},
         {at.scene.add_material("steel", std::array<float, 3>{0.5F, 0.5F, 0.52F}), 0.0});
}

void file_cabinets(const Workshop& at) {
  const double half = 0.5 * at.size.width_m;
  const Rgb colour = varied(at.random, {150, 152, 148}, 35);
  at.box(-half, half, 0.01, at.size.depth_m, 0, at.size.height_m,
         {at.material("files", paint_cabinet(at.random, colour, 3, 4)), 0.0},
         {at.material("enamel", paint_wood(at.random, colour)), 0.9});
}

}  // namespace

PieceSize size_of(Piece piece) {
  switch (piece) {
    case Piece::kWardrobe:
      return {1.5, 0.6, 2.0};
    case Piece::kBookshelf:
      return {1.1, 0.32, 1.9};
    case Piece::kBed:
      return {1.5, 2.05, 1.05};
    case Piece::kNightstand:
      return {0.45, 0.42, 0.9};
    case Piece::kDesk:
      return {1.4, 1.0, 1.22};
    case Piece::kSofa:
      return {1.95, 0.88, 0.82};
    case Piece::kArmchair:
      return {0.85, 0.85, 0.82};
    case Piece::kTelevision:
      return {1.6, 0.42, 1.2};
    case Piece::kSideboard:
      return {1.5, 0.42, 0.85};
    case Piece::kCounter:
      return {2.4, 0.62, 2.1};
    case Piece::kFridge:
      return {0.65, 0.68, 1.85};
    case Piece::kPlant:
      return {0.45, 0.45, 1.3};
    case Piece::kConsole:
      return {0.95, 0.3, 1.06};
    case Piece::kCoats:
      return {1.1, 0.12, 1.74};
    case Piece::kBath:
      return {1.7, 0.75, 1.9};
    case Piece::kBasin:
      return {1.5, 0.5, 1.75};
    case Piece::kWashingMachine:
      return {0.62, 0.6, 1.06};
    case Piece::kPiano:
      return {1.5, 0.62, 1.45};
    case Piece::kTableWithChairs:
      return {1.6, 1.5, 0.92};
    case Piece::kWhiteboard:
      return {1.4, 0.04, 1.9};
    case Piece::kFileCabinets:
      return {1.4, 0.5, 1.32};
  }
  return {};
}

void build_plant(SceneBuilder& scene, const Pose2& frame, double height_m, Random& random) {
  const int pot = scene.add_material("pot", paint_fabric(random, rich_colour(random), Weave::kStripes));
  const int leaves = scene.add_material("leaves", paint_leaves(random));
  scene.cylinder(frame, {0, 0, 0}, 0.16, 0.3, {pot, 0.0});
  for (int tuft = 0; tuft < 7; ++tuft) {
    const double x = uniform(random, -0.1, 0.1);
    const double y = uniform(random, -0.1, 0.1);
    const double z = 0.3 + (height_m - 0.6) * tuft / 6.0;
    const Pose2 turned = frame * Pose2{x, y, uniform(random, 0.0, 3.1)};
    const double half = uniform(random, 0.08, 0.17);
    scene.box(turned, {-half, -half, z}, {half, half, z + 0.25}, {{leaves, 0.0}, {leaves, 0.0}});
  }
}

void hang_picture(SceneBuilder& scene, const Pose2& frame, double width_m, double height_m, Image picture) {
  const double aspect = static_cast<double>(picture.height_px) / picture.width_px;
  const double half = 0.5 * width_m;
  const int canvas = scene.add_material("picture", std::move(picture));
  const int edge = scene.add_material("frame", std::array<float, 3>{0.12F, 0.08F, 0.05F});
  scene.box(frame, {-half, 0.004, height_m - half * aspect}, {half, 0.03, height_m + half * aspect},
            {{canvas, 0.0}, {edge, 0.0}});
}

void build_piece(SceneBuilder& scene, Piece piece, const Pose2& frame, Random& random) {
  const Workshop at{{scene, frame}, random, size_of(piece)};
  switch (piece) {
    case Piece::kWardrobe:
      return wardrobe(at);
    case Piece::kBookshelf:
      return bookshelf(at);
    case Piece::kBed:
      return bed(at);
    case Piece::kNightstand:
      return nightstand(at);
    case Piece::kDesk:
      return desk(at);
    case Piece::kSofa:
      return sofa(at, pick(random, 2) == 0 ? Weave::kPlain : Weave::kStripes);
    case Piece::kArmchair:
      return sofa(at, Weave::kChecks);
    case Piece::kTelevision:
      return television(at);
    case Piece::kSideboard:
      return sideboard(at);
    case Piece::kCounter:
      return counter(at);
    case Piece::kFridge:
      return fridge(at);
    case Piece::kPlant:
      return build_plant(scene, frame * Pose2{0.0, 0.22, 0.0}, uniform(random, 1.0, 1.5), random);
    case Piece::kConsole:
      return console(at);
    case Piece::kCoats:
      return coats(at);
    case Piece::kBath:
      return bath(at);
    case Piece::kBasin:
      return basin(at);
    case Piece::kWashingMachine:
      return washing_machine(at);
    case Piece::kPiano:
      return piano(at);
    case Piece::kTableWithChairs:
      return table_with_chairs(at);
    case Piece::kWhiteboard:
      return whiteboard(at);
    case Piece::kFileCabinets:
      return file_cabinets(at);
  }
}

}  // namespace homeward::sim
