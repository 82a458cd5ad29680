// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "support/ascii_map.hpp"
#include "support/planar_scene.hpp"
#include "support/sample_map.hpp"

namespace homeward::testing {

inline constexpr int kCorridorPlaces = 10;
inline constexpr int kCorridorLandmarks = 40;

/// Landmarks of place `scene`, each with its own descriptor, seen by a robot `offset_m` ahead of the place's centre.
inline features::Appearance seen_at(int scene, double offset_m, double heading_rad) {
  std::mt19937_64 random(static_cast<std::uint64_t>(scene) + 50);
  const auto points = room_points(kCorridorLandmarks, random);
  auto seen = random_appearance(kCorridorLandmarks, static_cast<unsigned>(scene) + 500);
  for (int i = 0; i < kCorridorLandmarks; ++i) {
    seen.sift.bearings.row(i) =
        bearing_from({offset_m, 0.0, heading_rad}, points[static_cast<std::size_t>(i)]).cast<float>().transpose();
  }
  return seen;
}

/// A corridor of places A to J in a row. Places in `alike` look like the first of them.
inline map::TopologicalMap corridor(const std::vector<int>& alike = {}) {
  map::TopologicalMap map = ascii_map("A-B-C-D-E-F-G-H-I-J");
  for (int i = 0; i < kCorridorPlaces; ++i) {
    const bool copy = std::ranges::find(alike, i) != alike.end();
    map.places[static_cast<std::size_t>(i)].appearances = {seen_at(copy ? alike.front() : i, 0.0, 0.0)};
  }
  map.motion.hop_spread = 0.6;
  map.motion.distance_scale = 0.05;
  return map;
}

}  // namespace homeward::testing
