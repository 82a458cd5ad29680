// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/pose2.hpp"

namespace homeward::agent {

/// The last seconds of a robot's odometry by the robot's own clock: where it was when a picture was taken.
class OdometryTrack {
 public:
  /// A reading; without stamp it only becomes the newest. A stamp before the newest begins a new track.
  void add(std::optional<std::int64_t> stamp_us, const Pose2& pose);
  /// Between the readings around the stamp; the nearest a little outside of them, and the newest for what bears no
  /// stamp or one of another clock.
  [[nodiscard]] Pose2 at(std::optional<std::int64_t> stamp_us) const;
  void clear() { stamped_.clear(); }

 private:
  struct Stamped {
    std::int64_t stamp_us = 0;
    Pose2 pose;
  };
  std::deque<Stamped> stamped_;  // stamps rise
  Pose2 newest_;
};

}  // namespace homeward::agent
