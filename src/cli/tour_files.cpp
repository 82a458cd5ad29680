// SPDX-License-Identifier: Apache-2.0
#include "cli/tour_files.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "files/write_file.hpp"

namespace homeward::cli {

namespace fs = std::filesystem;

namespace {

std::string formatted(const char* format, double a, double b, double c) {
  char text[120];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
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
  tables_.add(last_name_, picture.t_us, picture.odometry, picture.sweep);
  ++count_;
  return {};
}

Status TourFiles::finish(const std::vector<std::pair<std::string, std::string>>& marks) const {
  if (Status written = tables_.write(folder_, camera_); !written) return written;
  std::vector<std::pair<std::string, std::string>> files = {{"poses.csv", poses_}};
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
