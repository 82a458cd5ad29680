// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"
#include "map/taught_path.hpp"
#include "repeat/arc_surroundings.hpp"

namespace homeward::repeat {

/// Where points of a key image are, as the arc that ends in it has them: frame of the key image, units of that arc.
class KnownStructure {
 public:
  /// Nothing of an arc that is a turn on the spot, or doubtful.
  static KnownStructure of(const map::PathArc& arc);

  /// None of a feature whose distance is not known.
  [[nodiscard]] const Landmark* landmark(int feature) const;
  [[nodiscard]] bool is_empty() const { return landmarks_.empty(); }

 private:
  std::vector<Landmark> landmarks_;  // rising by feature
};

/// A known point as it is seen from the key image and from another view.
struct KnownPair {
  Landmark landmark;
  geometry::PointPair pair;
};

/// The motion from the key image to a view in which known points are seen (three views, by the structure that they
/// share), from the best of some starts. Nothing where fewer than half of them agree with one, or it has no way.
std::optional<geometry::ViewMotion> motion_by_structure(std::span<const KnownPair> seen,
                                                        std::span<const geometry::ViewMotion> starts);

/// How likely known points are seen where they are after a motion whose length is not known (natural logarithm, up to a
/// constant; each point counts for so little that wrong ones decide nothing). Two views of points that lie on one
/// plane, or of corners that slide along an edge, fit more than one motion; points that were seen from a third place do
/// not fit the wrong one. Ours.
double structure_log_likelihood(std::span<const KnownPair> seen, const geometry::ViewMotion& motion);

}  // namespace homeward::repeat
