// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/pose2.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// The sweeps of the last half second as one, less noisy than any of them: each range of the newest sweep is the mean
/// of those that the sweeps before it show in the same direction, moved by odometry, where they agree with it to within
/// the noise. What is new, or moves, is as the newest sweep alone shows it. A body that must keep centimetres away from
/// jambs would otherwise go by the lucky ones among many sweeps, a little nearer each time.
/// Ours: docs/experiments/wheelchair.md.
class SteadySweep {
 public:
  /// Takes up a new sweep, taken at this pose of the robot; time by the sensors' clock.
  void observe(const Scan& scan, const Pose2& odometry, std::int64_t taken_ms);
  /// The points that were hit, robot frame when the newest sweep was observed, metres.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points_m() const { return points_m_; }

 private:
  struct Sweep {
    std::int64_t taken_ms = 0;
    std::vector<Eigen::Vector2d> points_m;  // odometry's frame
  };
  std::deque<Sweep> before_;
  std::vector<Eigen::Vector2d> points_m_;
};

}  // namespace homeward::driving
