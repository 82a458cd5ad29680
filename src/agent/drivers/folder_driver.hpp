// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "driving/driver.hpp"

namespace homeward::agent {

struct FolderDriverConfig {
  std::string folder;
  std::string camera;  // camera.json; empty: the one in the folder
  double pictures_per_s = 2.0;
  bool repeat = false;  // from the first picture again after the last
};

/// Pictures of a folder in name order as if a camera took them now; for localising without a robot. It has no wheels
/// and no range sensor, so that no mission can drive it. Errors: kNotFound, kEmptyInput, those of read_camera.
Result<std::unique_ptr<driving::Driver>> make_folder_driver(const FolderDriverConfig& config);

}  // namespace homeward::agent
