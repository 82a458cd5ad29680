// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/range_sweep.hpp"
#include "core/result.hpp"

namespace homeward::exploration {

struct OpenDirectionsConfig {
  /// Nearer returns are dropped. §4.2 prints "any data smaller than 10m was filtered out" for a room of 10 m by 12 m: a
  /// misprint, as it would leave nearly nothing; the sentence before it speaks of ranges "very close to 0m".
  double least_range_m = 0.1;
  double most_range_m = 15.0;  // farther returns are dropped, as printed
  double spike_m = 0.5;        // a return that both its neighbours contradict by more is dropped (ours)
  /// What came back beside a ray that met nothing says that it went far when it lies beyond this share of the longest
  /// range that counts; else the ray went into glass, or nobody knows (ours).
  double far_share = 0.7;
  /// A segment's ranges lie within this share of the longest one below it. The thesis has such an interval and does not
  /// print its number.
  double interval_share = 0.5;
  double least_open_m = 0.0;   // and never below this: how far the robot means to drive (ours; 0: as printed)
  double least_width_m = 0.8;  // of the chord of a segment at its nearest range: what the body wants to pass
  /// Best directions that are kept. §4.2 says three, §4.1 and §5.2 say four, and node 3 of the first run (§5.2.2) has
  /// five; four is said twice, and of the runs as they were driven.
  std::size_t most = 4;
};

/// The middle of a stretch of free floor around the robot.
struct OpenDirection {
  double bearing_rad = 0.0;  // robot frame, counter-clockwise from forward, (-pi, pi]
  double width_rad = 0.0;    // how much of the circle is open, each ray standing for a whole step
  double range_m = 0.0;      // the nearest range in it, from the scanner: so far it is free all over
};

/// Where a robot that explores may drive: the contiguous segments of rays that reach nearly as far as the longest one
/// (Ferdaus 2008, §4.2, eq. 4.1), widest first; of equal width, the smallest bearing first. Segments go on across the
/// sweep's end where it covers the whole circle; one that covers all of the circle has no middle, and its direction is
/// that of its longest range.
///
/// A ray that met nothing is open where the return next to its run of such rays is far itself, as along a corridor, and
/// unknown elsewhere: a pane of glass gives nothing back either, and a doorway in a near wall is given up for it.
/// Unknown rays are never open. A single dropped ray counts as the nearer of the two beside it.
///
/// Empty when nothing is open, and when nothing is known. Errors: kEmptyInput (no rays), kInvalidInput (a step or
/// largest range that is not positive, or more rays than fit a circle).
Result<std::vector<OpenDirection>> open_directions(const RangeSweep& sweep, const OpenDirectionsConfig& config = {});

}  // namespace homeward::exploration
