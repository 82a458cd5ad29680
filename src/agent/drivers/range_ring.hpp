// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "agent/drivers/ros_messages.hpp"
#include "core/pose2.hpp"
#include "driving/scan.hpp"
#include "driving/sonar_map.hpp"
#include "driving/step.hpp"

namespace homeward::agent {

/// A sweep, and when the oldest of what it is made of was received.
struct RingSweep {
  driving::Scan scan;
  driving::Milliseconds taken_ms = 0;
  Pose2 odometry;  // where the robot was when it was made
};

/// The single readings of a ring of ultrasound sensors, put together to sweeps by driving::SonarMap. There is a sweep
/// once every sensor has sent since the one before, and nothing of it is older than 0.4 s: with one sensor silent
/// there is none. Directions within 60 degrees of straight back belong to the sweep only where the ring covers them all
/// (gaps of up to 10 degrees between cones count as covered). Holds no clock. Not for several threads.
class RangeRing {
 public:
  explicit RangeRing(std::vector<wire::RosRangeSensor> sensors);

  [[nodiscard]] bool empty() const { return sensors_.empty(); }
  /// Directions around the robot that no sensor covers, of 360; gaps of up to 10 degrees count as covered.
  [[nodiscard]] int uncovered_deg() const;
  /// Whether it covers everything within 30 degrees of straight ahead.
  [[nodiscard]] bool covers_ahead() const;

  /// One sensor's reading, received at `now`, with the odometry of the moment that it is of.
  void add(const RosRange& range, driving::Milliseconds now, const Pose2& odometry);
  /// The next sweep, if it is whole. `odometry`: where the robot is now.
  std::optional<RingSweep> sweep(driving::Milliseconds now, const Pose2& odometry);
  /// Nothing that was received counts any more.
  void forget();

 private:
  struct Reading {
    RosRange range;
    driving::Milliseconds at_ms = 0;
    Pose2 odometry;
  };
  std::vector<wire::RosRangeSensor> sensors_;
  driving::SonarMap map_;
  std::vector<std::optional<Reading>> latest_;  // since the latest sweep, by sensor
  bool covers_behind_ = false;
};

/// What a scanner and a ring say, as one sweep about the robot's turning point: of each half degree the nearest.
/// `robot`: odometry now. It looks behind where either does.
driving::Scan with_ring(const driving::Scan& scan, const RingSweep& ring, const Pose2& robot);

}  // namespace homeward::agent
