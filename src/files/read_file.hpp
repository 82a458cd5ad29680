// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::files {

/// The whole file. Errors: kNotFound, kTooLarge (over 256 MiB), kIo; each names the file.
Result<std::string> read_text(const std::filesystem::path& file);

/// A JPEG or PNG picture. Errors: those of read_text and of imageio::decode, naming the file.
Result<Image> read_picture(const std::filesystem::path& file);

/// A camera.json. Errors: those of read_text and of wire::parse_camera, naming the file.
Result<camera::CameraConfig> read_camera(const std::filesystem::path& file);

}  // namespace homeward::files
