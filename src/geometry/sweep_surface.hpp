// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/range_sweep.hpp"

namespace homeward::geometry {

/// Which returns of a sweep are believed (Ferdaus 2008 §4.2).
struct SweepFilter {
  double nearest_m = 0.1;      // nearer returns are none: nothing may come so near to the scanner
  double farthest_m = 15.0;    // and farther ones neither (32 m were returned in a room of 12 m)
  double joined_m = 0.12;      // a neighbour's point no farther off is of the same surface,
  double joined_per_m = 0.08;  // and so much farther for each metre of range
};

/// A point of a surface that a sweep hit, and the surface's normal there, towards the scanner.
struct SurfacePoint {
  Eigen::Vector2d at_m;
  Eigen::Vector2d normal;
};

/// The surfaces that a sweep hit, robot frame, in the order of its rays. A return that neither neighbour shares is left
/// out: glass, dust and mixed edges give such, surfaces do not.
std::vector<SurfacePoint> surface_of(const RangeSweep& sweep, const SweepFilter& filter = {});

}  // namespace homeward::geometry
