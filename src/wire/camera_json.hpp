// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "camera/camera_config.hpp"
#include "core/result.hpp"

namespace homeward::wire {

/// camera.json (proto/schemas/camera.schema.json), format "homeward-camera", version 1.
nlohmann::json camera_to_json(const camera::CameraConfig& config);

/// Strict: unknown and missing keys are errors, and so is a camera with camera::problems. `path` starts the JSON paths
/// of errors. Errors: kInvalidInput, kUnsupportedFormat.
Result<camera::CameraConfig> camera_from_json(const nlohmann::json& value, const std::string& path = "camera");

/// The same from text. Errors: also kInvalidInput when it is no JSON.
Result<camera::CameraConfig> parse_camera(const std::string& text, const std::string& where);

}  // namespace homeward::wire
