// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "driving/driver.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::scenario {

struct SimulatorDriverConfig {
  std::string world = "house:1";
  std::string light = "day";
  std::string robot = "disc";    // or "chair"
  std::string ranges = "laser";  // or "ultrasound"
  std::string start_room;        // empty: the world's start
  std::optional<Pose2> start;    // where it stands at first, in place of both
  std::string camera = "hyperbolic_mirror";
  std::string truth_file;    // empty: none. Else JSON lines with the true pose, the command, collisions so far
  std::string shared_world;  // empty: it is alone. Else a folder: those who name the same one see each other
  int people = 0;
  std::uint64_t seed = 1;
  std::function<std::optional<driving::JoystickReading>(driving::Milliseconds)> rider =
      {};  // the joystick at a simulated time; empty: none
};

/// A simulated robot whose time is the machine's own; when the machine is too slow, simulated time falls behind.
/// Errors: those of load_world and of SharedWorld::join; kNotFound for a room.
Result<std::unique_ptr<driving::Driver>> make_simulator_driver(const SimulatorDriverConfig& config);

}  // namespace homeward::scenario
