// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/generate/builder.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {

enum class Piece {
  kWardrobe,
  kBookshelf,
  kBed,
  kNightstand,
  kDesk,
  kSofa,
  kArmchair,
  kTelevision,
  kSideboard,
  kCounter,
  kFridge,
  kPlant,
  kConsole,
  kCoats,
  kBath,
  kBasin,
  kWashingMachine,
  kPiano,
  kTableWithChairs,
  kWhiteboard,
  kFileCabinets,
};

/// Along its wall, out of the wall, and upwards, metres.
struct PieceSize {
  double width_m = 1.0;
  double depth_m = 0.5;
  double height_m = 1.0;
};
PieceSize size_of(Piece piece);

/// Builds one piece of furniture: it stands at y = 0 of `frame` (the wall), centred in x, and looks along +y. Each
/// piece has its own wood, cloth and contents, drawn from `random`.
void build_piece(SceneBuilder& scene, Piece piece, const Pose2& frame, Random& random);

/// A picture of the given width, hanging on the wall with its centre at `height_m`.
void hang_picture(SceneBuilder& scene, const Pose2& frame, double width_m, double height_m, Image picture);

/// A plant in a pot around the frame's origin.
void build_plant(SceneBuilder& scene, const Pose2& frame, double height_m, Random& random);

}  // namespace homeward::sim
