// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// How a plan differs from the building that it was drawn of: shares of the objects that stand there.
struct ObjectChanges {
  double missing_share = 0.0;  // left out
  double moved_share = 0.0;    // drawn elsewhere
  std::uint64_t seed = 1;
};

struct ChangedScene {
  Scene scene;
  int objects = 0;  // that stand in the building (objects_of)
  int missing = 0;  // of them left out
  int moved = 0;    // of them drawn elsewhere; fewer than asked for where there is no room
};

/// The scene of a world as an old plan has it: some objects are not there, and some that could be moved stand 0.2 m to
/// 1 m away, turned by up to 45 degrees, in free room: not in what is built in, behind a wall, or in another object.
/// Same seed, same scene. Errors: kInvalidInput for shares that are none or more than all together, kEmptyInput for
/// shares of a world without objects.
Result<ChangedScene> change_objects(const World& world, const ObjectChanges& changes);

}  // namespace homeward::sim
