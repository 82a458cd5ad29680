// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.hpp"
#include "core/tour.hpp"

namespace homeward::files {

/// Pictures (.jpg, .jpeg, .png) of a folder in name order. Errors: kNotFound, kEmptyInput.
Result<std::vector<std::filesystem::path>> pictures_in(const std::filesystem::path& folder);

/// A tour as a folder of pictures in name order, with optional
///   tour.json      {"marks":[{"image","label"}]}: destinations
///   times.csv      filename,t_us
///   odometry.csv   t_us,x_m,y_m,theta_rad: interpolated to the times of the pictures; without times.csv it has one row
///                  for each picture
///   scans.csv      filename,r0,r1,...: a sweep of a range sensor for each picture, with scans.json beside it
///                  (tour_scans.hpp); pictures that it does not name have none
/// poses.csv is truth for evaluation and never read.
class TourFolder final : public TourSource {
 public:
  /// Errors: kNotFound, kEmptyInput, kInvalidInput (file and line of what is wrong).
  static Result<TourFolder> open(const std::filesystem::path& folder);

  /// Takes the odometry of another file: t_us,x_m,y_m,theta_rad as above, or filename,x_m,y_m,theta_rad. Errors:
  /// kNotFound and those of `open`.
  Status use_odometry(const std::filesystem::path& file);
  /// Takes the sweeps of another file (read_scans_table).
  Status use_scans(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
};

}  // namespace homeward::files
