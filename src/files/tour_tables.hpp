// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "camera/camera_config.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace homeward::files {

/// The tables that stand beside the pictures of a tour, as TourFolder reads them: gathered picture by picture.
class TourTables {
 public:
  /// All sweeps are of one scanner: their geometry is that of the first.
  void add(const std::string& picture, TimeUs t_us, const std::optional<Pose2>& odometry,
           const std::optional<RangeSweep>& sweep);
  /// Writes times.csv, camera.json and, where there are any, odometry.csv, scans.csv and scans.json. Errors: kIo.
  [[nodiscard]] Status write(const std::filesystem::path& folder, const camera::CameraConfig& camera) const;

 private:
  std::string odometry_ = "t_us,x_m,y_m,theta_rad\n";
  std::string times_ = "filename,t_us\n";
  std::string scans_;
  RangeSweep scanner_;  // how its sweeps are to be read
};

}  // namespace homeward::files
