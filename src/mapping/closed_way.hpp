// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mapping/track.hpp"

namespace homeward::mapping {

/// Image b seen from image a of the same tour, as if both were one spot: a loop that was closed. Lengths in the way's
/// own unit.
struct LoopTie {
  int a = 0;
  int b = 0;
  double x = 0.0;  // where b lies in the frame of a
  double y = 0.0;
  double sigma = 1.0;  // standard deviation of x and of y
  double turn_rad = 0.0;
  int group = 0;  // ties of one run of the tour along another; ascending
};

/// The way driven with its closed loops: headings and then positions that fit steps and ties best in the least squares
/// sense, each with the certainty that the steps and ties between two images leave it (the effective resistance of the
/// network that they make). A tie never speaks for itself: its own group can be taken out.
/// Lu & Milios (1997) for the network; Barooah & Hespanha, Estimation on graphs from relative measurements (2007), for
/// resistances as variances.
class ClosedWay {
 public:
  /// Ties whose ends the way does not join are left out. Precondition: groups ascend, 0 first, without gaps.
  ClosedWay(const TourTrack& track, std::vector<LoopTie> ties);
  ~ClosedWay();
  ClosedWay(ClosedWay&&) noexcept;
  ClosedWay& operator=(ClosedWay&&) noexcept;

  /// Image `b` seen from image `a` by the way and all closed loops.
  [[nodiscard]] TrackPrediction predict(int a, int b) const;

  /// What the way and all loops but these say about each of these.
  struct Without {
    TrackPrediction prediction;
    double miss_sigmas = 0.0;  // how far the tie is from that, in standard deviations of the difference
  };
  [[nodiscard]] std::vector<Without> without(std::span<const std::size_t> ties) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace homeward::mapping
