// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "exploration/explored_floor.hpp"
#include "exploration/next_view.hpp"
#include "exploration/reach.hpp"

namespace homeward::exploration {

// Two robots explore one building: each leaves some of it to the other, its companion.

/// What a robot tells its companion, all in its own floor's frame. Plain data: it may come over a link, and be late.
struct CompanionReport {
  SharedFloor floor;
  Pose2 floor_from_robot;
  std::optional<Eigen::Vector2d> target_m;  // driven to; nothing: none
  bool drives = true;                       // it has not ended
};

/// A companion, and how its floor lies in ours (FrameJoin finds that).
struct Companion {
  CompanionReport report;
  Pose2 floor_from_theirs;
};

struct CompanionConfig {
  double around_target_m = 2.5;  // so near to its target, and in sight from there, is left to it
  double clearly_m = 1.0;        // what it gets to for so much less is left to it
};

/// How much of the building is left to a companion; each of them leaves it what the one before does.
enum class LeftToCompanion : std::uint8_t {
  kCovered,  // what its pictures cover
  kTarget,   // and what lies around its target, unless we get there for clearly less
  kNearer,   // and what it gets to for clearly less than we
};

SharedFloor shared_floor(const ExploredFloor& floor, const Coverage& coverage);

/// Our floor with what only the companion has seen.
ExploredFloor joint_floor(const ExploredFloor& floor, const Companion& companion);

/// Marks the cells of a joint floor that are left to the companion; one that does not drive is left what it has
/// covered. `ours`: what we reach on it.
/// That what lies around another's target is worth less, and that each goes where it is nearer: Burgard, Moors,
/// Stachniss & Schneider, Coordinated multi-robot exploration (IEEE T-RO 2005, III). There utility falls with the
/// chance to see it from the target; that it is gone in sight of it, and the margins, are ours.
void mark_left(const Companion& companion, LeftToCompanion share, const ExploredFloor& joint, const Reach& ours,
               const ReachConfig& reach, const CompanionConfig& config, std::vector<std::uint8_t>& cells);

}  // namespace homeward::exploration
