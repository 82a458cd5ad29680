// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/milliseconds.hpp"

namespace homeward::agent {

/// When what comes from a robot over one connection is too old to move it.
struct LinkLagConfig {
  driving::Milliseconds most_ms = 300;               // neither a ping nor what was sensed or steered may be older
  driving::Milliseconds most_of_pictures_ms = 1000;  // a picture bears the odometry of its moment, so it may be
  driving::Milliseconds remembered_ms = 500;         // a sign of lag speaks for so long against what bears no stamp
  driving::Milliseconds lasts_ms = 1500;             // a lag without a break that lasts longer is a lost connection
  double most_drift = 1e-3;                          // the robot's clock gains or loses at most this share of the time
};

/// What the rosbridge driver goes by. Times are by the machine's own clock.
struct RosbridgeConfig {
  LinkLagConfig lag = {};
  driving::Milliseconds publish_period_ms = 50;
  // Some cycles of the agent's: a loop above that hangs has the robot brake, long before the base does so by itself.
  driving::Milliseconds command_life_ms = 150;
  driving::Milliseconds zeros_after_motion_ms = 1000;  // said again and again: the bridge keeps no count
  int unheard_commands = 20;                           // after so many that did not come back it is said
  double at_rest_mps = 0.005;                          // of a joystick; what is less is no hand
  double at_rest_radps = 0.01;
  driving::Milliseconds odometry_silence_ms = 400;
  driving::Milliseconds odometry_period_ms = 100;  // of the slowest that is asked for
  driving::Milliseconds ring_life_ms = 400;        // of a ring's sweep beside a scanner's
  double blind_beyond_m = 0.05;                    // what is kept free beside the body anyway
  // Longer than the agent bears without sweeps: after a lost connection it stops for certain.
  driving::Milliseconds withheld_ms = 600;
  driving::Milliseconds topic_silence_ms =
      5000;  // a topic that is silent for so long is subscribed to again, and named
  driving::Milliseconds farewell_pause_ms = 300;  // a bridge drops what it has not taken up when a connection closes
  driving::Milliseconds farewell_limit_ms = 1000;
};

}  // namespace homeward::agent
