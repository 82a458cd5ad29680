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
  void add(const std::string& picture, TimeUs t_us, const std::optional<Pose2>& odometry, const RangeSweep& sweep);
  /// Writes times.csv, scans.csv, scans.json, camera.json and, where there is any, odometry.csv. Errors: kIo.
  [[nodiscard]] Status write(const std::filesystem::path& folder, const camera::CameraConfig& camera) const;

 private:
  std::string odometry_ = "t_us,x_m,y_m,theta_rad\n";
  std::string times_ = "filename,t_us\n";
  std::string scans_;
  RangeSweep scanner_;  // how its sweeps are to be read
};

}  // namespace homeward::files
