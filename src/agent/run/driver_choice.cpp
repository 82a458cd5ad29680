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
  command
      .add_option("--driver", options.driver,
                  "simulator, rosbridge (a ROS robot), or without wheels: v4l2 (a USB camera), folder, video")
      ->check(CLI::IsMember({"simulator", "rosbridge", "folder", "video", "v4l2"}))
      ->capture_default_str();
  command.add_option("--camera", options.camera,
                     "V4l2, folder, video: camera.json (folder and video: else the one beside the pictures). "
                     "Simulator: a model (hyperbolic_mirror) or a camera.json");
  command
      .add_option("--world", options.simulator.world,
                  "Simulator: house:SEED, narrow_house:SEED, offices:SEED, wards:SEED or a world.json")
      ->capture_default_str();
  command.add_option("--light", options.simulator.light, "Simulator: day, night or half")->capture_default_str();
  command.add_option("--profile", options.simulator.robot, "Simulator: disc or chair")
      ->check(CLI::IsMember({"disc", "chair"}))
      ->capture_default_str();
  command.add_option("--ranges", options.simulator.ranges, "Simulator: laser or ultrasound")
      ->check(CLI::IsMember({"laser", "ultrasound"}))
      ->capture_default_str();
  command.add_option("--start-room", options.simulator.start_room, "Simulator: room to start in");
  command.add_option("--people", options.simulator.people, "Simulator: people who walk about")
      ->check(CLI::Range(0, 50));
  command.add_option("--seed", options.simulator.seed, "Simulator: seed of noise and people");
  command.add_option("--truth-file", options.simulator.truth_file, "Simulator: append true poses to this file");
  command.add_option("--rosbridge", options.rosbridge_file,
                     "Rosbridge: the robot's description (JSON, format homeward-rosbridge)");
  command.add_option("--images", options.folder.folder, "Folder: where the pictures are");
  command.add_option("--video", options.video.file, "Video: the file; its pictures come at its own times");
  command.add_option("--device", options.v4l2.device, "V4l2: the camera's device")->capture_default_str();
  command.add_option("--rate", options.pictures_per_s, "Folder, v4l2: pictures a second (2; 10)");
  command.add_flag("--repeat", options.repeat, "Folder, video: begin again after the last picture");
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
    folder.repeat = options.repeat;
    folder.pictures_per_s = options.pictures_per_s.value_or(folder.pictures_per_s);
    return make_folder_driver(folder);
  }
  if (options.driver == "video") {
    if (const auto error = missing(options, "--video", options.video.file)) return tl::unexpected(*error);
    VideoDriverConfig video = options.video;
    video.camera = options.camera;
    video.repeat = options.repeat;
    return make_video_driver(video);
  }
  if (options.driver == "v4l2") {
    if (const auto error = missing(options, "--camera", options.camera)) return tl::unexpected(*error);
    V4l2DriverConfig v4l2 = options.v4l2;
    v4l2.camera = options.camera;
    v4l2.pictures_per_s = options.pictures_per_s.value_or(v4l2.pictures_per_s);
    return make_v4l2_driver(v4l2);
  }
  SimulatorDriverConfig simulator = options.simulator;
  if (!options.camera.empty()) simulator.camera = options.camera;
  return make_simulator_driver(simulator);
}

}  // namespace homeward::agent
