// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "files/tour_tables.hpp"

namespace homeward::cli {

/// One picture of a simulated tour, with all that is known about it.
struct SimulatedPicture {
  std::vector<std::uint8_t> jpeg;
  Pose2 truth;
  std::string room;  // empty: none
  std::optional<Pose2> odometry;
  RangeSweep sweep;
  TimeUs t_us = 0;
};

/// Simulated tours begin at a fixed time: same seed, same files.
inline constexpr TimeUs kTourBegins_us = 1'700'000'000'000'000;

/// The files of a simulated tour: pictures as they come, the tables in the end.
class TourFiles {
 public:
  /// Errors: kConflict when the folder holds something already, kIo.
  static Result<TourFiles> open(const std::filesystem::path& folder, const camera::CameraConfig& camera);

  /// Writes the picture. Errors: kIo.
  Status add(const SimulatedPicture& picture);
  /// The name of the picture written last.
  [[nodiscard]] const std::string& last_name() const { return last_name_; }
  /// Writes poses.csv, odometry.csv, times.csv, scans.csv, scans.json, camera.json and, with marks, tour.json.
  Status finish(const std::vector<std::pair<std::string, std::string>>& marks) const;

 private:
  TourFiles(std::filesystem::path folder, camera::CameraConfig camera)
      : folder_(std::move(folder)), camera_(std::move(camera)) {}

  std::filesystem::path folder_;
  camera::CameraConfig camera_;
  int count_ = 0;
  std::string last_name_;
  std::string poses_ = "filename,x_m,y_m,theta_rad,room\n";
  files::TourTables tables_;
};

}  // namespace homeward::cli
