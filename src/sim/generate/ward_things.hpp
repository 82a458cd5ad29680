// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/generate/builder.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {

/// What a hospital's furniture is made of: the same everywhere, painted once.
struct WardMaterials {
  Surface steel;
  Surface enamel;
  Surface blanket;
  Surface sheet;
  Surface drawers;
  Surface headboard;
  Surface seat;
  Surface supplies;  // what lies on a trolley
  Surface notes;     // the board above a bed
  Surface outlets;   // the strip along a wall behind the beds
};
WardMaterials ward_materials(SceneBuilder& scene, Random& random);

enum class WardThing { kBed, kCabinet, kChair, kTrolley, kDesk };

/// Builds one thing at the wall: it stands at y = 0 of `frame`, centred in x, and looks along +y.
void build_ward_thing(SceneBuilder& scene, WardThing thing, const Pose2& frame, const WardMaterials& materials);

/// The strip with sockets and lamps on the wall behind a bed, and the board above it.
void build_bed_wall(SceneBuilder& scene, const Pose2& frame, const WardMaterials& materials);

}  // namespace homeward::sim
