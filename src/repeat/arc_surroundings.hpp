// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "repeat/taught_path.hpp"

namespace homeward::repeat {

/// A landmark around an arc, seen from the first key image of the arc, in that one's frame. The point is at bearing /
/// nearness.
struct Landmark {
  int feature = 0;
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitX();  // unit
  double nearness = 0.0;                               // 1 / distance, in units of the surroundings; 0: as the sky
  double nearness_spread = 0.0;                        // its standard deviation, about
  bool has_distance = false;  // without: it is about as far as the others, which the spread says
  bool in_arc = false;        // one of M_i of the arc itself
};

/// A key image in the frame of the surroundings.
struct KeyPose {
  int key = 0;
  Eigen::Matrix3d local_from_key = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // in units of the surroundings
  bool is_placed = true;                               // without: units on the way there are not joined
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();  // unit, where the way goes on; zero before a turn on the spot and
                                                    // at the last of the surroundings
};

/// An arc with those before and after it in one frame, that of its first key image, and one unit: its length, or where
/// it has no baseline that of the nearest arc before it that has one, else of the one after it. Local, and made anew
/// for every arc: nothing of it is common to the path.
struct ArcSurroundings {
  int arc = 0;                               // index in the path
  std::vector<int> arcs;                     // all of them, in the order of the way
  std::vector<KeyPose> keys;                 // in the order of the way, one more than arcs; each once
  std::vector<Landmark> landmarks;           // rising by feature
  std::optional<int> unit_arc;               // whose length is the unit; none: no arc around has a baseline
  std::vector<std::optional<double>> units;  // length of each of `arcs`, in the unit
  double nearness = 0.0;                     // the median of the landmarks with a distance; 0 where there are none

  /// Where a key image is in `keys`; nothing where it is not.
  [[nodiscard]] std::optional<int> position_of(int key) const;
  /// Precondition: the key image is one of them.
  [[nodiscard]] const KeyPose& key(int number) const { return keys[static_cast<std::size_t>(*position_of(number))]; }
  [[nodiscard]] bool has_key(int number) const { return position_of(number).has_value(); }
  /// The key image after another one on the way; null at the end of the surroundings and for what is not in them.
  [[nodiscard]] const KeyPose* next_key(int number) const;
};

/// Whether something warns of an arc that may be far off (docs/experiments/teaching_a_path.md).
bool is_doubtful(const Arc& arc);

/// The surroundings of an arc, up to `reach` arcs before and after it as far as the path is in one piece; where it is
/// closed they go on round it, but never to the same key image again, and without the landmarks from beyond. Units are
/// joined by the nodes' scales, and past a turn on the spot by the landmarks that the arcs on both sides have in
/// common, at least `fewest_scaled`. Precondition: the arc is one of the path's.
ArcSurroundings surroundings_of(const TaughtPath& path, int arc, int reach, int fewest_scaled);

}  // namespace homeward::repeat
