// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "agent/drivers/driver.hpp"
#include "agent/drivers/folder_driver.hpp"
#include "agent/drivers/simulator_driver.hpp"
#include "agent/drivers/v4l2_driver.hpp"
#include "agent/drivers/video_driver.hpp"

namespace homeward::agent {

/// What the command line says about the robot.
struct DriverOptions {
  std::string driver = "simulator";
  std::string camera;  // empty: the driver's usual one
  SimulatorDriverConfig simulator;
  std::string rosbridge_file;
  FolderDriverConfig folder;
  VideoDriverConfig video;
  V4l2DriverConfig v4l2;
  std::optional<double> pictures_per_s;  // nothing: the driver's usual rate
  bool repeat = false;
};

void add_driver_options(CLI::App& command, DriverOptions& options);

/// The robot that was chosen. `told` hears of what happens, for a log. Errors: those of the driver; kInvalidInput when
/// an option that it needs is missing.
Result<std::unique_ptr<Driver>> make_driver(const DriverOptions& options, std::function<void(const std::string&)> told);

}  // namespace homeward::agent
