// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/seen_floor.hpp"
#include "support/landmarks.hpp"
#include "support/sample_map.hpp"
#include "support/walled_floor.hpp"

namespace homeward::testing {

/// A tour in the shape of a horseshoe through one room: east along y = 0, north, back west along y = 2.4; its two ends
/// lie 2.4 m apart, 12 m by the way driven. Each picture is a place, p1 to p11, and has odometry and a sweep.
struct Horseshoe {
  explicit Horseshoe(std::vector<Wall> inside = {}) {
    std::vector<Wall> walls = walls_around({-1.2, -1.2}, {6.0, 3.6});
    walls.insert(walls.end(), inside.begin(), inside.end());
    for (const double x_m : {0.0, 1.2, 2.4, 3.6, 4.8}) poses.push_back({x_m, 0.0, 0.0});
    poses.push_back({4.8, 1.2, kPi / 2.0});
    for (const double x_m : {4.8, 3.6, 2.4, 1.2, 0.0}) poses.push_back({x_m, 2.4, kPi});
    const Landmarks landmarks = landmarks_around(poses, 220, 5, 1.0, 5.0);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const ImageId image("tour/" + std::to_string(100 + i));
      map.images.push_back({image, std::nullopt, poses[i]});
      map.places.push_back(place_of_image("p" + std::to_string(i + 1), image, seen_from(landmarks, poses[i], 70 + i)));
      sweeps.push_back({image, sweep_at(poses[i], walls)});
    }
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
      join(i, i + 1);
      join(i + 1, i);
    }
    map.next_place_number = 12;
  }

  void join(std::size_t from, std::size_t to) {
    const Pose2 seen = inverse(poses[from]) * poses[to];
    map::Edge edge;
    edge.from = map.places[from].id;
    edge.to = map.places[to].id;
    edge.bearing_rad = std::atan2(seen.y_m, seen.x_m);
    edge.turn_rad = seen.theta_rad;
    edge.length_m = std::hypot(seen.x_m, seen.y_m);
    edge.length_from = map::LengthSource::kOdometry;
    edge.confidence = 0.95;
    map.edges.push_back(edge);
  }

  std::vector<Pose2> poses;
  map::TopologicalMap map;
  std::vector<mapping::TourSweep> sweeps;
};

}  // namespace homeward::testing
