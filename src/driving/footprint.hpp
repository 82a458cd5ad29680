// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/outline.hpp"
#include "driving/distance_field.hpp"

namespace homeward::driving {

/// A body for many quick questions to a distance field: as discs inside its outline, large ones along the middle and
/// smaller ones towards the corners. Off by a cell of the field, and by 2 cm at the tips of a wheelchair's corners.
/// Discs for a body: Ziegler & Stiller, Fast collision checking for intelligent vehicle motion planning (2010).
class Footprint {
 public:
  /// For that many headings all round, the first of them given.
  Footprint(const Outline& outline, double first_heading_rad, int headings);

  /// From the outline, at a place and in one of the headings, to the nearest point: exact no further than it has to be,
  /// beyond `enough_m` no more than that it is beyond, and no more than too near below `least_m`.
  [[nodiscard]] float clearance_m(const DistanceField& field, float x_m, float y_m, int heading, float least_m,
                                  float enough_m) const;

  /// Up to where a field has to know distances for these questions.
  [[nodiscard]] double reach_m() const { return double{turned_.front().radius_m}; }

 private:
  struct Disc {
    float x_m;
    float y_m;
    float radius_m;
  };
  std::size_t count_;         // of discs for each heading; the first of them holds the whole body
  std::vector<Disc> turned_;  // heading by heading
};

}  // namespace homeward::driving
