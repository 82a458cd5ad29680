// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/angles.hpp"

namespace homeward::mapping {

/// What two tour images say about each other. Directions as in geometry::PlanarMotion: the second image seen from the
/// first one's robot frame.
struct PairRelation {
  float distance = std::numeric_limits<float>::infinity();  // visual distance D (matching/visual_distance.hpp)
  int inliers = 0;                                          // matches that one planar motion explains
  float match_share = 0.0F;                                 // of the inliers in the smaller number of features
  float direction_rad = 0.0F;                               // where the second viewpoint lies
  float turn_rad = 0.0F;                                    // second heading minus first
  float parallax_rad = 0.0F;                                // median, after the turn is taken out
  float confidence = 0.0F;                                  // that the direction is right within 15 degrees

  [[nodiscard]] bool verified() const { return inliers > 0; }
};

/// Relations between n images: of those pairs that have one, so that memory follows them and not n². A pair that was
/// never set has the default relation: infinitely different.
class PairTable {
 public:
  explicit PairTable(int images)
      : partners_(static_cast<std::size_t>(images)), relations_(static_cast<std::size_t>(images)) {}

  [[nodiscard]] int images() const { return static_cast<int>(partners_.size()); }

  /// Visual distance of two images; 0 of an image to itself.
  [[nodiscard]] float distance(int a, int b) const { return a == b ? 0.0F : find(a, b).distance; }

  /// `b` seen from `a`. Precondition: a != b.
  [[nodiscard]] PairRelation relation(int a, int b) const {
    PairRelation relation = find(a, b);
    if (a > b) {
      relation.direction_rad = static_cast<float>(
          wrap_angle(static_cast<double>(relation.direction_rad) + kPi - static_cast<double>(relation.turn_rad)));
      relation.turn_rad = static_cast<float>(wrap_angle(-static_cast<double>(relation.turn_rad)));
    }
    return relation;
  }

  /// The images that have a relation to this one, ascending. Valid until the next set().
  [[nodiscard]] std::span<const int> partners(int image) const { return partners_[static_cast<std::size_t>(image)]; }

  /// Sets the relation of `b` seen from `a`. Precondition: a < b. Cheap where pairs come in ascending order of b.
  void set(int a, int b, const PairRelation& relation) {
    auto& of_b = partners_[static_cast<std::size_t>(b)];
    auto& relations = relations_[static_cast<std::size_t>(b)];
    const auto place = std::ranges::lower_bound(of_b, a);
    const auto offset = place - of_b.begin();
    if (place != of_b.end() && *place == a) {
      relations[static_cast<std::size_t>(offset)] = relation;
      return;
    }
    of_b.insert(place, a);
    relations.insert(relations.begin() + offset, relation);
    auto& of_a = partners_[static_cast<std::size_t>(a)];
    of_a.insert(std::ranges::lower_bound(of_a, b), b);
  }

 private:
  [[nodiscard]] PairRelation find(int a, int b) const {
    const int low = std::min(a, b);
    const auto high = static_cast<std::size_t>(std::max(a, b));
    const auto end = partners_[high].begin() + static_cast<std::ptrdiff_t>(relations_[high].size());
    const auto place = std::lower_bound(partners_[high].begin(), end, low);
    if (place == end || *place != low) return {};
    return relations_[high][static_cast<std::size_t>(place - partners_[high].begin())];
  }

  std::vector<std::vector<int>> partners_;            // of each image, ascending: the earlier ones first
  std::vector<std::vector<PairRelation>> relations_;  // of each image to its earlier partners, in their order
};

}  // namespace homeward::mapping
