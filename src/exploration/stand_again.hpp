// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/pose2.hpp"
#include "exploration/explorer.hpp"

namespace homeward::exploration {

struct StandAgainConfig {
  double within_m = 1.2;           // of where it was last,
  double step_m = 0.3;             // it is tried at points so far apart,
  int headings = 36;               // with so many headings each
  int worked_out = 8;              // of them, those that look best
  double sees_m = 6.0;             // sweeps from so far around are what a sweep is put onto
  double agreement = 0.6;          // of the sweep with those, at least
  double pictured_within_m = 1.5;  // so near a picture must be for the new one to be compared with
  double same_turn_rad = 0.12;     // so far the turn between the two may be from that of the sweeps
};

/// Where the robot stands on an exploration's floor that stands about where it was last, with an odometry that says
/// nothing of it: by its sweep, which must fit, and its picture, which must agree on the heading with the nearest ones;
/// a room that looks alike from two sides is told apart by those. Nothing: it stands elsewhere, or cannot tell. Ours.
std::optional<Pose2> stand_again(const Explorer& explorer, const RangeSweep& sweep,
                                 const features::Appearance& appearance, const StandAgainConfig& config = {});

/// The same about any pose of the floor, in place of where it was last.
std::optional<Pose2> stand_about(const Explorer& explorer, const Pose2& about, const RangeSweep& sweep,
                                 const features::Appearance& appearance, const StandAgainConfig& config = {});

}  // namespace homeward::exploration
