// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/pose2.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// How much two sweeps contradict each other: the share of directions in which one meets something where the other
/// looked through, the lesser of either way round. Who comes or goes contradicts one way alone, and what was hidden
/// before contradicts nothing; who walks by comes and goes within a quarter of the view, so that what does both in the
/// quarter in which most does is left out. `before_from_now`: the robot's pose now in its frame then, by odometry.
/// Nothing where fewer than half of the directions are in both sweeps. The method is ours.
std::optional<double> contradiction(const Scan& before, const Scan& now, const Pose2& before_from_now);

/// Whether sweeps go on from each other as the wheels say that the robot moved.
struct SweepContinuity {
  std::optional<Scan> before;           // what the latest was compared with
  Pose2 odometry;                       // of that
  std::int64_t before_ms = 0;           // when that was taken,
  std::int64_t latest_ms = 0;           // and when the latest
  std::optional<double> contradiction;  // of the latest
  double usual = 0.0;                   // of it, by a mean that forgets
  std::optional<std::int64_t> broken_since_ms;
};

/// Takes one more sweep. True: for a while the sweeps contradict the one before, so that the robot was moved without
/// its wheels, at once or bit by bit.
bool breaks_off(SweepContinuity& continuity, const Scan& now, const Pose2& odometry, std::int64_t taken_ms);

}  // namespace homeward::driving
