// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"

namespace homeward::bench {

/// A folder of pictures of a pinhole camera with camera.json and poses.csv (the truth), shrunk.
struct PerspectiveTour {
  std::vector<Image> grey;
  std::vector<Pose2> poses;
  camera::CameraConfig camera;  // of the shrunk pictures
};

/// Throws what cannot be read.
PerspectiveTour read_perspective_tour(const std::filesystem::path& folder, int width_px);

/// Processor time of this process.
double cpu_ms();

/// The value below which a share of the values lies; not a number without values.
double at_share(std::vector<double> values, double share);

/// A line: the median, in milliseconds, of each tenth of a drive's pictures, and pictures a second of all.
void print_tenths(const char* name, const std::vector<double>& ms);

}  // namespace homeward::bench
