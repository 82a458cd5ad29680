// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "repeat/node_scale.hpp"
#include "repeat/taught_path.hpp"

namespace homeward::testing {

/// A taught path straight ahead with exact geometry, without pictures: every key image sees the same points, whose
/// numbers are their places in the list.
struct StraightPath {
  /// Key images at these places along x.
  explicit StraightPath(std::vector<double> along_x_m) : places_m(std::move(along_x_m)) {
    for (int i = 0; i < 40; ++i) points_m.emplace_back(6.0 + 0.1 * i, 3.0 * std::sin(1.7 * i), std::cos(2.3 * i));
    headings_rad.assign(places_m.size(), 0.0);
    make();
  }

  /// From an arc on the path goes on in another direction.
  void turn_at(int arc, double turn_rad) {
    for (std::size_t key = at(arc) + 1; key < headings_rad.size(); ++key) headings_rad[key] += turn_rad;
    make();
  }

  std::vector<double> places_m;
  std::vector<double> headings_rad;
  std::vector<Eigen::Vector3d> points_m;
  repeat::TaughtPath path;

 private:
  [[nodiscard]] Eigen::Vector3d in_key(std::size_t key, const Eigen::Vector3d& point_m) const {
    return Eigen::AngleAxisd(-headings_rad[key], Eigen::Vector3d::UnitZ()) *
           (point_m - Eigen::Vector3d(places_m[key], 0.0, 0.0));
  }
  void make() {
    path = {};
    for (std::size_t key = 0; key < places_m.size(); ++key) {
      repeat::KeyImage image;
      image.picture = static_cast<int>(key);
      path.key_images.push_back(image);
      if (key + 1 == places_m.size()) break;
      const double length_m = places_m[key + 1] - places_m[key];
      repeat::Arc arc;
      arc.from = static_cast<int>(key);
      arc.has_baseline = length_m > 0.0;
      arc.lead = 100.0;
      arc.motion.current_from_target =
          Eigen::AngleAxisd(headings_rad[key + 1] - headings_rad[key], Eigen::Vector3d::UnitZ()).toRotationMatrix();
      arc.motion.target_in_current =
          Eigen::AngleAxisd(-headings_rad[key], Eigen::Vector3d::UnitZ()) * Eigen::Vector3d::UnitX();
      for (std::size_t i = 0; i < points_m.size(); ++i) {
        const Eigen::Vector3d from = in_key(key, points_m[i]);
        const Eigen::Vector3d to = in_key(key + 1, points_m[i]);
        repeat::ArcMatch match;
        match.feature = static_cast<int>(i);
        match.from_bearing = from.normalized();
        match.to_bearing = to.normalized();
        if (arc.has_baseline) {
          match.from_nearness = length_m / from.norm();
          match.to_nearness = length_m / to.norm();
          match.distance_spread = 0.02;
        }
        arc.matches.push_back(match);
      }
      path.arcs.push_back(arc);
    }
    for (std::size_t arc = 1; arc < path.arcs.size(); ++arc) {
      path.key_images[arc].scale = repeat::node_scale(path.arcs[arc - 1], path.arcs[arc], 3);
    }
  }
};

}  // namespace homeward::testing
