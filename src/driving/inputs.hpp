// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "driving/body.hpp"
#include "driving/milliseconds.hpp"
#include "driving/path_sight.hpp"
#include "driving/scan.hpp"
#include "features/appearance.hpp"
#include "tracking/tracking_frame.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// A picture that was looked at. `taken_ms`: by the sensors' clock, which is the machine's own on a robot and simulated
/// time in a simulator.
struct SeenPicture {
  Milliseconds taken_ms = 0;
  std::shared_ptr<const features::Appearance> appearance;  // null: only tracked, not recognised
  tracking::TrackingFrame frame;
  Pose2 odometry;  // when it was taken
};

/// One sweep of the range sensors. `taken_ms`: by the sensors' clock.
struct SeenScan {
  Milliseconds taken_ms = 0;
  Scan scan;
};

/// What the rider's own joystick says. A deflected one may want no motion of the agent: the base obeys it by itself, or
/// it has not been at rest yet.
struct JoystickReading {
  Milliseconds said_ms = 0;  // by the sensors' clock
  bool deflected = false;
  Motion wanted;
};

/// Where an exploration drives next: straight to a point that is near and in sight, round what stands in the way.
struct Leg {
  Eigen::Vector2d goal_m = Eigen::Vector2d::Zero();  // odometry's frame
  double within_m = 0.1;                             // so near it is reached
};

/// That an exploration is over by itself: it has seen all or kept to its limits, or (`failed`) it does not get on.
struct ExplorationOver {
  bool failed = false;
  std::optional<wire::Reason> reason;
};

/// What is new since the last step.
struct Inputs {
  std::optional<SeenPicture> picture;
  std::optional<SeenScan> scan;
  Pose2 odometry;
  std::vector<wire::ServerMessage> messages;  // in the order of their arrival
  bool link_up = false;
  std::optional<Milliseconds> sensors_now_ms;  // by the sensors' clock; nothing: it is the machine's own
  std::optional<JoystickReading> rider;        // the newest reading of the joystick, when there is one
  std::optional<Leg> leg = {};                 // of an exploration; nothing: it stands and thinks
  std::optional<ExplorationOver> exploration_over = {};
  std::optional<wire::Reason> why_not_exploring = {};  // orders to explore are refused for that; nothing: they are not
  std::optional<PathSight> path_sight = {};            // of the newest picture that was held against the path, once
  std::optional<wire::Reason> why_not_repeating = {};  // orders to repeat are refused, or end, for that
  bool robot_link_up = true;  // false: the connection to the robot is lost or too slow for its sensors
};

}  // namespace homeward::driving
