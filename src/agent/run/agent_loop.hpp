// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "agent/link/address.hpp"
#include "core/ids.hpp"
#include "core/result.hpp"
#include "driving/driver.hpp"
#include "recording/recording_thread.hpp"

namespace homeward::agent {

struct AgentOptions {
  ServerAddress server;
  RobotId robot;
  std::string token;
  std::string robot_name;
  std::function<void(const std::string&)> log;        // what happens; called from any thread
  std::optional<recording::RecordingOptions> record;  // each mission in a file of its own
  std::string joystick = {};                          // the rider's, at this machine (/dev/input/js0); empty: none
  /// Where explorations are kept until they are on the server; nothing: it does not explore.
  std::optional<std::filesystem::path> explorations = {};
};

/// Runs a robot until `stop` is asked for: one thread looks at pictures, one (the caller's) decides 25 times a second
/// and commands the driver, one speaks with the server. The driver is commanded to zero at the end, however it ends.
/// Errors: those of the eye and of pictures, of Recorder::create, of Exploring::create and of Joystick::open. A
/// recording that cannot go on is given up, and the robot drives on.
Status run_agent(driving::Driver& driver, const AgentOptions& options, const std::stop_token& stop);

}  // namespace homeward::agent
