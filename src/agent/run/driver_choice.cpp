// SPDX-License-Identifier: Apache-2.0
#include "agent/run/driver_choice.hpp"

#include "agent/drivers/rosbridge_driver.hpp"

namespace homeward::agent {
namespace {

/// The driver needs an option that was not given.
std::optional<Error> missing(const DriverOptions& options, const std::string& option, const std::string& value) {
  if (!value.empty()) return std::nullopt;
  return Error{ErrorCode::kInvalidInput, "The driver " + options.driver + " needs " + option + ".", option};
}

}  // namespace

void add_driver_options(CLI::App& command, DriverOptions& options) {
  command.add_option("--driver", options.driver, "simulator, rosbridge or folder")
      ->check(CLI::IsMember({"simulator", "rosbridge", "folder"}))
      ->capture_default_str();
  command.add_option("--camera", options.camera,
                     "A camera.json; or, for the simulator, a model's name (hyperbolic_mirror). Left out: the folder's "
                     "own");
  command.add_option("--world", options.simulator.world, "Simulator: house:SEED, offices:SEED or a world.json")
      ->capture_default_str();
  command.add_option("--light", options.simulator.light, "Simulator: day, night or half")->capture_default_str();
  command.add_option("--profile", options.simulator.robot, "Simulator: disc or chair")
      ->check(CLI::IsMember({"disc", "chair"}))
      ->capture_default_str();
  command.add_option("--start-room", options.simulator.start_room, "Simulator: room to start in");
  command.add_option("--people", options.simulator.people, "Simulator: people who walk about")
      ->check(CLI::Range(0, 50));
  command.add_option("--seed", options.simulator.seed, "Simulator: seed of noise and people");
  command.add_option("--truth-file", options.simulator.truth_file, "Simulator: append true poses to this file");
  command.add_option("--rosbridge", options.rosbridge_file,
                     "Rosbridge: the robot's description (JSON, format homeward-rosbridge)");
  command.add_option("--images", options.folder.folder, "Folder: where the pictures are");
  command.add_option("--rate", options.folder.pictures_per_s, "Folder: pictures a second")->capture_default_str();
  command.add_flag("--repeat", options.folder.repeat, "Folder: begin again after the last picture");
}

Result<std::unique_ptr<Driver>> make_driver(const DriverOptions& options,
                                            std::function<void(const std::string&)> told) {
  if (options.driver == "rosbridge") {
    if (const auto error = missing(options, "--rosbridge", options.rosbridge_file)) return tl::unexpected(*error);
    return make_rosbridge_driver(options.rosbridge_file, std::move(told));
  }
  if (options.driver == "folder") {
    if (const auto error = missing(options, "--images", options.folder.folder)) return tl::unexpected(*error);
    FolderDriverConfig folder = options.folder;
    folder.camera = options.camera;
    return make_folder_driver(folder);
  }
  SimulatorDriverConfig simulator = options.simulator;
  if (!options.camera.empty()) simulator.camera = options.camera;
  return make_simulator_driver(simulator);
}

}  // namespace homeward::agent
