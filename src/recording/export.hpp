// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace homeward::recording {

/// Writes what a recording's camera, wheels and range sensor said as a tour: pictures, camera.json, times.csv,
/// odometry.csv and scans.csv with scans.json. Errors: those of db::RecordingReader; kConflict (the folder holds
/// something already), kEmptyInput (no pictures), kIo.
Status export_recording(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace homeward::recording
