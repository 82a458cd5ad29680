// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "camera/camera_config.hpp"

namespace homeward::scenario {

/// The camera that a simulated robot carries by the name of its model ("hyperbolic_mirror", "equirectangular",
/// "pinhole", and "pinhole_320" of half its size), or nothing for another name.
std::optional<camera::CameraConfig> usual_camera(const std::string& model);

}  // namespace homeward::scenario
