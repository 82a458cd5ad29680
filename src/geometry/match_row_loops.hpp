// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// The loops of MatchRows over matches, in the vector instructions that the processor has. Every number is made by the
/// same operations in the same order on all of them.
namespace homeward::geometry::match_row_loops {

/// Numbers of matches, each in a row: of the current bearing u, v, w, of the target's x, y, z.
struct Rows {
  const double* u;
  const double* v;
  const double* w;
  const double* x;
  const double* y;
  const double* z;
  const double* log_scale_ratio;
  const double* odds;
  const double* size_known;  // 1 or 0
  std::size_t count;
};

using Nine = std::array<double, 9>;  // of a matrix, row by row
using Slopes = std::array<Nine, 5>;  // of the essential matrix, column by column

struct GazeNumbers {
  std::array<double, 3> here;   // the direction of the motion in the current frame
  std::array<double, 3> there;  // ... in the target's
  double spread;
  double share;
};

struct SeenNumbers {
  const double* error;
  const double* chance;
  const double* possible;
  double* share;
  double* belief;
  double* gain;
  double* pull;
  double* telling;
};

/// Signed epipolar errors by the essential matrix `e`: radians.
void errors(const Rows& r, const Nine& e, double* errors);

/// The same with their five slopes, `r.count` numbers of each one after the other.
void errors_and_slopes(const Rows& r, const Nine& e, const Slopes& s, double* errors, double* slopes);

/// The larger share of azimuths, of both bearings of a match, at which one lies within `window` (a sine) of the plane
/// of the other's line; at least `least`.
void chances(const Rows& r, const Nine& e, double window, double least, double* into);

/// See MatchRows::judge.
void judge(const Rows& r, const GazeNumbers& g, const SeenNumbers& s);

}  // namespace homeward::geometry::match_row_loops
