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

void add_driver_options(CLI::App& command, DriverOptions& options, const std::vector<FurtherDriver>& further) {
  std::vector<std::string> names = {"rosbridge", "folder", "video", "v4l2"};
  std::string summary = "rosbridge (a ROS robot), or without wheels: v4l2 (a USB camera), folder, video";
  for (const FurtherDriver& driver : further) {
    names.push_back(driver.name);
    summary = driver.name + " (" + driver.summary + "), " + summary;
  }
  CLI::Option* choice = command.add_option("--driver", options.driver, summary)->check(CLI::IsMember(names));
  if (further.empty()) {
    choice->required();
  } else {
    options.driver = further.front().name;
    choice->capture_default_str();
  }
  command.add_option(
      "--camera", options.camera,
      "V4l2, folder, video: camera.json (folder and video: else the one beside the pictures)" +
          std::string(further.empty() ? "" : ". Simulator: a model (hyperbolic_mirror) or a camera.json"));
  for (const FurtherDriver& driver : further) driver.add_options(command);
  command.add_option("--rosbridge", options.rosbridge_file,
                     "Rosbridge: the robot's description (JSON, format homeward-rosbridge)");
  command.add_option("--images", options.folder.folder, "Folder: where the pictures are");
  command.add_option("--video", options.video.file, "Video: the file; its pictures come at its own times");
  command.add_option("--device", options.v4l2.device, "V4l2: the camera's device")->capture_default_str();
  command.add_option("--rate", options.pictures_per_s, "Folder, v4l2: pictures a second (2; 10)");
  command.add_flag("--repeat", options.repeat, "Folder, video: begin again after the last picture");
}

Result<std::unique_ptr<driving::Driver>> make_driver(const DriverOptions& options,
                                                     const std::vector<FurtherDriver>& further,
                                                     std::function<void(const std::string&)> log) {
  for (const FurtherDriver& driver : further) {
    if (driver.name == options.driver) return driver.make(options.camera);
  }
  if (options.driver == "rosbridge") {
    if (const auto error = missing(options, "--rosbridge", options.rosbridge_file)) return tl::unexpected(*error);
    return make_rosbridge_driver(options.rosbridge_file, std::move(log));
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
  return fail(ErrorCode::kInvalidInput, "There is no driver of this name.", options.driver);
}

}  // namespace homeward::agent
