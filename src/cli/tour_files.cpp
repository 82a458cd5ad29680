// SPDX-License-Identifier: Apache-2.0
#include "cli/tour_files.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "files/write_file.hpp"
#include "wire/camera_json.hpp"
#include "wire/scans_json.hpp"

namespace homeward::cli {

namespace fs = std::filesystem;

namespace {

std::string formatted(const char* format, double a, double b, double c) {
  char text[120];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

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

Result<TourFiles> TourFiles::open(const fs::path& folder, const camera::CameraConfig& camera) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", folder.string());
  }
  if (const Status made = files::make_folder(folder); !made) return pass_on(made);
  return TourFiles(folder, camera);
}

Status TourFiles::add(const SimulatedPicture& picture) {
  char name[32];
  std::snprintf(name, sizeof name, "%05d.jpg", count_);
  last_name_ = name;
  const std::string_view bytes(reinterpret_cast<const char*>(picture.jpeg.data()), picture.jpeg.size());
  if (Status written = files::write_file(folder_ / name, bytes); !written) return written;
  const Pose2& truth = picture.truth;
  poses_ += last_name_ + formatted(",%.4f,%.4f,%.5f,", truth.x_m, truth.y_m, truth.theta_rad) + picture.room + "\n";
  times_ += last_name_ + "," + std::to_string(picture.t_us) + "\n";
  if (picture.odometry) {
    const Pose2& said = *picture.odometry;
    odometry_ += std::to_string(picture.t_us) + formatted(",%.4f,%.4f,%.5f\n", said.x_m, said.y_m, said.theta_rad);
  }
  if (scans_.empty()) {
    scanner_ = picture.sweep;
    scanner_.ranges_m.clear();
    scans_ = "filename";
    for (std::size_t i = 0; i < picture.sweep.ranges_m.size(); ++i) scans_ += ",r" + std::to_string(i);
    scans_ += "\n";
  }
  scans_ += last_name_ + scans_row(picture.sweep);
  ++count_;
  return {};
}

Status TourFiles::finish(const std::vector<std::pair<std::string, std::string>>& marks) const {
  std::vector<std::pair<std::string, std::string>> files = {
      {"poses.csv", poses_},
      {"times.csv", times_},
      {"scans.csv", scans_},
      {"scans.json", wire::scans_to_json(scanner_).dump(2) + "\n"},
      {"camera.json", wire::camera_to_json(camera_).dump(2) + "\n"}};
  if (odometry_.find('\n') + 1 < odometry_.size()) files.emplace_back("odometry.csv", odometry_);
  if (!marks.empty()) {
    nlohmann::json tour = {{"format", "homeward-tour"}, {"version", 1}, {"marks", nlohmann::json::array()}};
    for (const auto& [image, label] : marks) tour["marks"].push_back({{"image", image}, {"label", label}});
    files.emplace_back("tour.json", tour.dump(2) + "\n");
  }
  for (const auto& [name, text] : files) {
    if (Status written = files::write_file(folder_ / name, text); !written) return written;
  }
  return {};
}

}  // namespace homeward::cli
