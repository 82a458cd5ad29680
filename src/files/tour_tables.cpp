// SPDX-License-Identifier: Apache-2.0
#include "files/tour_tables.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "files/write_file.hpp"
#include "wire/camera_json.hpp"
#include "wire/scans_json.hpp"

namespace homeward::files {
namespace {

std::string scans_row(const RangeSweep& sweep) {
  std::string row;
  for (const float range_m : sweep.ranges_m) {
    char text[24];
    std::snprintf(text, sizeof text, ",%.3f", std::min(static_cast<double>(range_m), sweep.range_max_m));
    row += text;
  }
  return row + "\n";
}

}  // namespace

void TourTables::add(const std::string& picture, TimeUs t_us, const std::optional<Pose2>& odometry,
                     const std::optional<RangeSweep>& sweep) {
  times_ += picture + "," + std::to_string(t_us) + "\n";
  if (odometry) {
    char text[120];
    std::snprintf(text, sizeof text, ",%.4f,%.4f,%.5f\n", odometry->x_m, odometry->y_m, odometry->theta_rad);
    odometry_ += std::to_string(t_us) + text;
  }
  if (!sweep) return;
  if (scans_.empty()) {
    scanner_ = *sweep;
    scanner_.ranges_m.clear();
    scans_ = "filename";
    for (std::size_t i = 0; i < sweep->ranges_m.size(); ++i) scans_ += ",r" + std::to_string(i);
    scans_ += "\n";
  }
  scans_ += picture + scans_row(*sweep);
}

Status TourTables::write(const std::filesystem::path& folder, const camera::CameraConfig& camera) const {
  std::vector<std::pair<std::string, std::string>> files = {
      {"times.csv", times_}, {"camera.json", wire::camera_to_json(camera).dump(2) + "\n"}};
  if (!scans_.empty()) {
    files.emplace_back("scans.csv", scans_);
    files.emplace_back("scans.json", wire::scans_to_json(scanner_).dump(2) + "\n");
  }
  if (odometry_.find('\n') + 1 < odometry_.size()) files.emplace_back("odometry.csv", odometry_);
  for (const auto& [name, text] : files) {
    if (Status written = write_file(folder / name, text); !written) return written;
  }
  return {};
}

}  // namespace homeward::files
