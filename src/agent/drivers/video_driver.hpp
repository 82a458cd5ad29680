// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "driving/driver.hpp"

namespace homeward::agent {

struct VideoDriverConfig {
  std::string file;
  std::string camera;   // camera.json; empty: the one beside the file
  bool repeat = false;  // from the first picture again after the last
};

/// A video as if a camera took it now: pictures come at the times that the file gives them, and those are left out for
/// which there was no time. It has no wheels and no range sensor, so that no mission can drive it.
/// Errors: kNotFound, kUnsupportedFormat, kWrongImageSize, those of read_camera.
Result<std::unique_ptr<driving::Driver>> make_video_driver(const VideoDriverConfig& config);

}  // namespace homeward::agent
