// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/angles.hpp"

namespace homeward::mapping {

/// What two tour images say about each other. Directions as in geometry::PlanarMotion: the second image seen from the
/// first one's robot frame.
struct PairRelation {
  float distance = std::numeric_limits<float>::infinity();  // visual distance D (design: features, section 3.2)
  int inliers = 0;                                          // matches that one planar motion explains
  float match_share = 0.0F;                                 // of the inliers in the smaller number of features
  float direction_rad = 0.0F;                               // where the second viewpoint lies
  float turn_rad = 0.0F;                                    // second heading minus first
  float parallax_rad = 0.0F;                                // median, after the turn is taken out
  float confidence = 0.0F;                                  // that the direction is right within 15 degrees

  [[nodiscard]] bool verified() const { return inliers > 0; }
};

/// Relations of all pairs of n images. A pair that was never compared has the default relation: infinitely different.
class PairTable {
 public:
  explicit PairTable(int images)
      : images_(images),
        pairs_(static_cast<std::size_t>(images) * static_cast<std::size_t>(images > 0 ? images - 1 : 0) / 2) {}

  [[nodiscard]] int images() const { return images_; }

  /// Visual distance of two images; 0 of an image to itself.
  [[nodiscard]] float distance(int a, int b) const { return a == b ? 0.0F : pairs_[slot(a, b)].distance; }

  /// `b` seen from `a`. Precondition: a != b.
  [[nodiscard]] PairRelation relation(int a, int b) const {
    PairRelation relation = pairs_[slot(a, b)];
    if (a > b) {
      relation.direction_rad = static_cast<float>(
          wrap_angle(static_cast<double>(relation.direction_rad) + kPi - static_cast<double>(relation.turn_rad)));
      relation.turn_rad = static_cast<float>(wrap_angle(-static_cast<double>(relation.turn_rad)));
    }
    return relation;
  }

  /// Sets the relation of `b` seen from `a`. Precondition: a < b. Different pairs may be set from different threads.
  void set(int a, int b, const PairRelation& relation) { pairs_[slot(a, b)] = relation; }

 private:
  [[nodiscard]] std::size_t slot(int a, int b) const {
    const auto low = static_cast<std::size_t>(a < b ? a : b);
    const auto high = static_cast<std::size_t>(a < b ? b : a);
    return high * (high - 1) / 2 + low;
  }

  int images_ = 0;
  std::vector<PairRelation> pairs_;
};

}  // namespace homeward::mapping
