// SPDX-License-Identifier: Apache-2.0
#include "recording/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "db/recording.hpp"
#include "files/write_file.hpp"
#include "imageio/decode.hpp"
#include "wire/scans_json.hpp"

namespace homeward::recording {
namespace {

/// The tables of a tour, row by row.
class TourTables {
 public:
  explicit TourTables(const db::RecordingHeader& header) : header_(header) {}

  /// A picture and the newest sweep when it came.
  Status add(const db::RecordedPicture& picture, const std::optional<db::RecordedSweep>& sweep,
             const std::filesystem::path& folder) {
    const auto about = imageio::read_header(*picture.bytes);
    if (!about) return pass_on(about);
    if (!first_ms_) first_ms_ = picture.taken_ms;
    char name[32];
    std::snprintf(name, sizeof name, "%05d.%s", count_++, about->format == imageio::ImageFormat::kPng ? "png" : "jpg");
    const std::string t_us = std::to_string(header_.started_us + 1000 * (picture.taken_ms - *first_ms_));
    times_ += std::string(name) + "," + t_us + "\n";
    char pose[100];
    std::snprintf(pose, sizeof pose, ",%.6f,%.6f,%.6f\n", picture.odometry.x_m, picture.odometry.y_m,
                  picture.odometry.theta_rad);
    odometry_ += t_us + pose;
    if (sweep) add_sweep(name, *sweep);
    return files::write_file(folder / name,
                             {reinterpret_cast<const char*>(picture.bytes->data()), picture.bytes->size()});
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }

  Status write(const std::filesystem::path& folder) const {
    const std::pair<const char*, const std::string*> files[] = {{"camera.json", &header_.camera_json},
                                                                {"times.csv", &times_},
                                                                {"odometry.csv", &odometry_},
                                                                {"scans.csv", &scans_},
                                                                {"scans.json", &about_}};
    for (const auto& [name, text] : files) {
      if (text->empty()) continue;
      if (const Status written = files::write_file(folder / name, *text); !written) return written;
    }
    return {};
  }

 private:
  void add_sweep(const std::string& name, const db::RecordedSweep& sweep) {
    RangeSweep geometry{{}, sweep.angle_min_rad, sweep.angle_step_rad, sweep.range_max_m, sweep.robot_from_scan};
    const std::string about = wire::scans_to_json(geometry).dump(2) + "\n";
    if (scans_.empty()) {
      about_ = about;
      rays_ = sweep.ranges_m.size();
      scans_ = "filename";
      for (std::size_t i = 0; i < rays_; ++i) scans_ += ",r" + std::to_string(i);
      scans_ += "\n";
    }
    if (sweep.ranges_m.size() != rays_ || about != about_) return;  // the table has one width and one geometry
    scans_ += name;
    for (const float range_m : sweep.ranges_m) {
      char text[24];
      const bool hit = std::isfinite(range_m) && range_m >= 0.0F;
      const double shown_m = hit ? std::min<double>(range_m, sweep.range_max_m) : sweep.range_max_m;
      std::snprintf(text, sizeof text, ",%.3f", shown_m);
      scans_ += text;
    }
    scans_ += "\n";
  }

  const db::RecordingHeader& header_;
  std::optional<std::int64_t> first_ms_;
  int count_ = 0;
  std::size_t rays_ = 0;
  std::string times_ = "filename,t_us\n";
  std::string odometry_ = "t_us,x_m,y_m,theta_rad\n";
  std::string scans_;
  std::string about_;  // scans.json
};

}  // namespace

Status export_recording(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto recording = db::RecordingReader::open(file);
  if (!recording) return pass_on(recording);
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
    return fail(ErrorCode::kConflict, "The folder holds something already; name a new or empty one.", folder.string());
  }
  if (const Status made = files::make_folder(folder); !made) return made;
  TourTables tables((*recording)->header());
  std::optional<db::RecordedSweep> sweep = (*recording)->sweep_before();
  while (true) {
    auto step = (*recording)->next();
    if (!step) return pass_on(step);
    if (!*step) break;
    if ((*step)->sweep) sweep = std::move((*step)->sweep);
    if (!(*step)->picture || !(*step)->picture->bytes) continue;
    if (const Status added = tables.add(*(*step)->picture, sweep, folder); !added) return added;
  }
  if (tables.empty()) return fail(ErrorCode::kEmptyInput, "The recording has no pictures.", file.string());
  return tables.write(folder);
}

}  // namespace homeward::recording
