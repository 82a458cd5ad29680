// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/enum_names.hpp"
#include "core/ids.hpp"
#include "map/topological_map.hpp"

namespace homeward::map {

enum class DoubtKind {
  kSamePlace,   // two places may be one
  kMixedPlace,  // one place may be two
  kWay,         // a way may not exist
};

inline constexpr EnumNames<DoubtKind, 3> kDoubtKindNames({"same_place", "mixed_place", "way"});

/// A hypothesis near another one along both passes, and what it said of it (Goedemé 2006 §3.5).
struct DoubtNeighbour {
  PlaceId place_a;
  PlaceId place_b;
  bool speaks_for = false;
  double weight = 0.0;  // of its evidence, 0 to 1
};

/// Something of a map that a person should look at: two pictures to compare, and what to do with the answer.
struct Doubt {
  DoubtKind kind = DoubtKind::kSamePlace;
  ImageId image_a;
  ImageId image_b;
  PlaceId place_a;                         // of image_a, as the map stands
  PlaceId place_b;                         // the same of a mixed place
  Decision state = Decision::kUndecided;   // as the map stands: they are one place, or the way exists
  Decider by = Decider::kMethod;           // a person's: it is not asked any more
  std::string set_aside_by;                // who was not sure of it; empty: nobody
  double probability = 0.0;                // that the map is wrong here
  double effect = 0.0;                     // 0 to 1, how far ways of the map would change if it were decided otherwise
  std::optional<std::size_t> hypothesis;   // index into the map's, of the one that says it
  std::vector<DoubtNeighbour> neighbours;  // weightiest first
  std::vector<Edit> if_yes;                // what makes the map so that they are one place, or that the way exists
  std::vector<Edit> if_no;

  [[nodiscard]] double weight() const { return probability * effect; }
};

}  // namespace homeward::map
