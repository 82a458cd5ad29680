// SPDX-License-Identifier: Apache-2.0
#include "files/tour_folder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "files/read_file.hpp"
#include "files/tour_scans.hpp"

namespace homeward::files {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png";
}

template <class Number>
std::optional<Number> number(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

struct Row {
  std::vector<std::string> cells;
  std::string where;  // file and line
};

/// Rows of a CSV file with exactly this header. A missing file has no rows.
Result<std::vector<Row>> read_rows(const fs::path& file, const std::string& header) {
  std::vector<Row> rows;
  std::error_code error;
  if (!fs::exists(file, error)) return rows;
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  std::istringstream lines(*text);
  const auto columns = std::ranges::count(header, ',') + 1;
  std::string line;
  for (int count = 1; std::getline(lines, line); ++count) {
    const std::string where = file.string() + ":" + std::to_string(count);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (count == 1) {
      if (line != header) return fail(ErrorCode::kInvalidInput, "The first line has to be \"" + header + "\".", where);
      continue;
    }
    if (line.empty()) continue;
    Row row{{}, where};
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.cells.push_back(cell);
    if (std::ssize(row.cells) != columns) {
      return fail(ErrorCode::kInvalidInput, "The line has to have " + std::to_string(columns) + " columns.", where);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Status read_times(const fs::path& folder, std::vector<TourImage>& images, const std::vector<fs::path>& files) {
  const auto rows = read_rows(folder / "times.csv", "filename,t_us");
  if (!rows) return pass_on(rows);
  std::map<std::string, TimeUs> times;
  for (const Row& row : *rows) {
    const auto t_us = number<TimeUs>(row.cells[1]);
    if (!t_us) return fail(ErrorCode::kInvalidInput, "t_us has to be an integer.", row.where);
    times[row.cells[0]] = *t_us;
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto found = times.find(files[i].filename().string());
    if (found != times.end()) images[i].t_us = found->second;
  }
  return {};
}

struct OdometrySample {
  TimeUs t_us = 0;
  Pose2 pose;
};

Result<std::vector<OdometrySample>> read_odometry_samples(const fs::path& file) {
  const auto rows = read_rows(file, "t_us,x_m,y_m,theta_rad");
  if (!rows) return pass_on(rows);
  std::vector<OdometrySample> samples;
  for (const Row& row : *rows) {
    const auto t_us = number<TimeUs>(row.cells[0]);
    const auto x_m = number<double>(row.cells[1]);
    const auto y_m = number<double>(row.cells[2]);
    const auto theta_rad = number<double>(row.cells[3]);
    if (!t_us || !x_m || !y_m || !theta_rad) {
      return fail(ErrorCode::kInvalidInput, "The line has to hold an integer and three finite numbers.", row.where);
    }
    samples.push_back({*t_us, {*x_m, *y_m, wrap_angle(*theta_rad)}});
  }
  return samples;
}

/// The pose at a time, between the two samples around it; nothing outside the recording.
std::optional<Pose2> pose_at(const std::vector<OdometrySample>& samples, TimeUs t_us) {
  const auto after = std::ranges::lower_bound(samples, t_us, {}, &OdometrySample::t_us);
  if (after == samples.end()) return std::nullopt;
  if (after->t_us == t_us) return after->pose;
  if (after == samples.begin()) return std::nullopt;
  const OdometrySample& a = *(after - 1);
  const OdometrySample& b = *after;
  // As doubles: the difference of two wild times would not fit an integer.
  const auto first_us = static_cast<double>(a.t_us);
  const auto last_us = static_cast<double>(b.t_us);
  const double share = (static_cast<double>(t_us) - first_us) / (last_us - first_us);
  return Pose2{a.pose.x_m + share * (b.pose.x_m - a.pose.x_m), a.pose.y_m + share * (b.pose.y_m - a.pose.y_m),
               wrap_angle(a.pose.theta_rad + share * wrap_angle(b.pose.theta_rad - a.pose.theta_rad))};
}

Status read_odometry(const fs::path& file, std::vector<TourImage>& images) {
  auto samples = read_odometry_samples(file);
  if (!samples) return pass_on(samples);
  if (samples->empty()) return {};
  const bool timed = std::ranges::all_of(images, [](const TourImage& image) { return image.t_us.has_value(); });
  if (!timed) {
    if (samples->size() != images.size()) {
      return fail(ErrorCode::kInvalidInput,
                  "Without times.csv the file has to have one row for each of the " + std::to_string(images.size()) +
                      " pictures; it has " + std::to_string(samples->size()) + ".",
                  file.string());
    }
    for (std::size_t i = 0; i < images.size(); ++i) images[i].odometry = (*samples)[i].pose;
    return {};
  }
  std::ranges::stable_sort(*samples, {}, &OdometrySample::t_us);
  for (TourImage& image : images) image.odometry = pose_at(*samples, *image.t_us);
  return {};
}

/// Odometry by the names of pictures.
Status read_named_odometry(const fs::path& file, std::vector<TourImage>& images, const std::vector<fs::path>& files) {
  const auto rows = read_rows(file, "filename,x_m,y_m,theta_rad");
  if (!rows) return pass_on(rows);
  std::map<std::string, Pose2> poses;
  for (const Row& row : *rows) {
    const auto x_m = number<double>(row.cells[1]);
    const auto y_m = number<double>(row.cells[2]);
    const auto theta_rad = number<double>(row.cells[3]);
    if (!x_m || !y_m || !theta_rad) {
      return fail(ErrorCode::kInvalidInput, "The line has to hold a name and three finite numbers.", row.where);
    }
    poses[row.cells[0]] = {*x_m, *y_m, wrap_angle(*theta_rad)};
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto found = poses.find(files[i].filename().string());
    if (found != poses.end()) images[i].odometry = found->second;
  }
  return {};
}

Status keep_sweeps(Result<std::map<std::string, RangeSweep>> sweeps, std::vector<TourImage>& images,
                   const std::vector<fs::path>& files) {
  if (!sweeps) return pass_on(sweeps);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto found = sweeps->find(files[i].filename().string());
    if (found != sweeps->end()) images[i].sweep = std::move(found->second);
  }
  return {};
}

Result<std::vector<TourMark>> read_marks(const fs::path& folder) {
  std::vector<TourMark> marks;
  const fs::path file = folder / "tour.json";
  std::error_code error;
  if (!fs::exists(file, error)) return marks;
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  const auto broken = [&](const std::string& what) { return fail(ErrorCode::kInvalidInput, what, file.string()); };
  if (!json.is_object()) return broken("The file is not a JSON object.");
  if (!json.contains("marks")) return marks;
  if (!json["marks"].is_array()) return broken("\"marks\" has to be a list.");
  for (const auto& mark : json["marks"]) {
    const bool valid = mark.is_object() && mark.contains("image") && mark["image"].is_string() &&
                       mark.contains("label") && mark["label"].is_string();
    if (!valid) return broken("Each mark has to be an object with the texts \"image\" and \"label\".");
    marks.push_back({mark["image"].get<std::string>(), mark["label"].get<std::string>()});
  }
  return marks;
}

}  // namespace

Result<std::vector<fs::path>> pictures_in(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return fail(ErrorCode::kNotFound, "There is no such folder.", folder.string());
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (is_picture(entry.path())) files.push_back(entry.path());
  }
  if (error) return fail(ErrorCode::kIo, "The folder cannot be read: " + error.message() + ".", folder.string());
  if (files.empty()) {
    return fail(ErrorCode::kEmptyInput, "The folder has no pictures (.jpg, .jpeg or .png).", folder.string());
  }
  std::ranges::sort(files);
  return files;
}

Result<TourFolder> TourFolder::open(const fs::path& folder) {
  auto files = pictures_in(folder);
  if (!files) return pass_on(files);
  TourFolder tour;
  tour.files_ = std::move(*files);
  const std::string name = fs::weakly_canonical(folder).filename().string();
  for (const fs::path& file : tour.files_) {
    tour.images_.push_back({ImageId(name + "/" + file.filename().string()), std::nullopt, std::nullopt});
  }
  if (const Status read = read_times(folder, tour.images_, tour.files_); !read) return pass_on(read);
  if (const Status read = read_odometry(folder / "odometry.csv", tour.images_); !read) return pass_on(read);
  if (const Status read = keep_sweeps(read_scans(folder), tour.images_, tour.files_); !read) return pass_on(read);
  auto marks = read_marks(folder);
  if (!marks) return pass_on(marks);
  tour.marks_ = std::move(*marks);
  return tour;
}

Status TourFolder::use_odometry(const fs::path& file) {
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  for (TourImage& image : images_) image.odometry.reset();
  if (text->rfind("filename,", 0) == 0) return read_named_odometry(file, images_, files_);
  return read_odometry(file, images_);
}

Status TourFolder::use_scans(const fs::path& file) {
  for (TourImage& image : images_) image.sweep.reset();
  return keep_sweeps(read_scans_table(file), images_, files_);
}

Result<Image> TourFolder::read(std::size_t index) const { return read_picture(files_[index]); }

}  // namespace homeward::files
