// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/topological_map.hpp"

namespace homeward::bench {

/// What a generated map is like.
struct MapSize {
  int places = 0;
  int features_of_place = 0;
};

inline constexpr MapSize kLargeMap{5000, 60};
inline constexpr MapSize kUsualMap{1000, 300};

/// Rooms (testing::room_picture) from 1 on that a map of localised robots has places of.
inline constexpr int kRooms = 8;

/// A building of parallel corridors, 1 m from place to place, which other corridors join now and then: each place has
/// one picture, random features and edges to its neighbours both ways. Where `with_rooms`, some places look like the
/// rooms instead, so that a robot that shows a picture of one is found. Every 100th place is a destination.
map::TopologicalMap corridor_map(const MapSize& size, bool with_rooms);

}  // namespace homeward::bench
