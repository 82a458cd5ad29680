// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "agent/drivers/driver.hpp"
#include "agent/drivers/folder_driver.hpp"
#include "agent/drivers/simulator_driver.hpp"

namespace homeward::agent {

/// What the command line says about the robot.
struct DriverOptions {
  std::string driver = "simulator";
  std::string camera;  // empty: the driver's usual one
  SimulatorDriverConfig simulator;
  FolderDriverConfig folder;
  std::string rosbridge_file;
};

void add_driver_options(CLI::App& command, DriverOptions& options);

/// The robot that was chosen. `told` hears of what happens, for a log. Errors: those of the driver; kInvalidInput when
/// an option that it needs is missing.
Result<std::unique_ptr<Driver>> make_driver(const DriverOptions& options, std::function<void(const std::string&)> told);

}  // namespace homeward::agent
