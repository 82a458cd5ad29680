// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/drivers/folder_driver.hpp"
#include "agent/drivers/v4l2_driver.hpp"
#include "agent/drivers/video_driver.hpp"
#include "driving/driver.hpp"

namespace homeward::agent {

/// What the command line says about the robot.
struct DriverOptions {
  std::string driver;
  std::string camera;  // empty: the driver's usual one
  std::string rosbridge_file;
  FolderDriverConfig folder;
  VideoDriverConfig video;
  V4l2DriverConfig v4l2;
  std::optional<double> pictures_per_s;  // nothing: the driver's usual rate
  bool repeat = false;
};

/// A driver that a program offers beside those of this module.
struct FurtherDriver {
  std::string name;     // of --driver
  std::string summary;  // what --help says of it
  std::function<void(CLI::App& command)> add_options;
  /// `camera`: what --camera says, or empty. Errors: those of the driver.
  std::function<Result<std::unique_ptr<driving::Driver>>(const std::string& camera)> make;
};

/// Adds --driver and what the drivers need. --driver must be given, but where there is a further driver: the first of
/// them is the usual one then.
void add_driver_options(CLI::App& command, DriverOptions& options, const std::vector<FurtherDriver>& further);

/// The robot that was chosen. `log` is called with each line for a log. Errors: those of the driver; kInvalidInput when
/// an option that it needs is missing.
Result<std::unique_ptr<driving::Driver>> make_driver(const DriverOptions& options,
                                                     const std::vector<FurtherDriver>& further,
                                                     std::function<void(const std::string&)> log);

}  // namespace homeward::agent
