// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/result.hpp"
#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "pipeline/eye.hpp"

/// Pictures whose true places or directions are known, as the programs of this folder read them.
namespace homeward {

/// The value; an error ends the program.
template <typename T>
T or_die(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().where + ": " + result.error().message);
  return std::move(*result);
}

struct Pose {
  double x_m, y_m, theta_rad;
};

inline double distance_m(const Pose& a, const Pose& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// Columns filename, x_m, y_m, theta_rad.
inline std::map<std::string, Pose> read_poses(const std::filesystem::path& file) {
  const files::CsvTable table = or_die(files::read_csv(file));
  std::map<std::string, Pose> poses;
  const auto at = [&](const char* name) { return table.column(name).value(); };
  for (const auto& row : table.rows) {
    poses[row[at("filename")]] = {std::stod(row[at("x_m")]), std::stod(row[at("y_m")]),
                                  std::stod(row[at("theta_rad")])};
  }
  return poses;
}

struct KnownPair {
  std::string current;
  std::string target;
  bool same = true;
  double distance_m = 0.0;  // 0: not known
  double bearing_rad = 0.0;
  double turn_rad = std::numeric_limits<double>::quiet_NaN();  // NaN: not known
};

/// Pairs of a table; a row with same=0, or, with poses, one whose pictures are further than `same_m` apart, is of
/// different places.
inline std::vector<KnownPair> read_pairs(const std::filesystem::path& list, const std::filesystem::path& poses_file,
                                         double same_m) {
  const files::CsvTable table = or_die(files::read_csv(list));
  const std::map<std::string, Pose> poses = poses_file.empty() ? std::map<std::string, Pose>{} : read_poses(poses_file);
  const auto cell = [&](const std::vector<std::string>& row, const char* name) {
    const auto column = table.column(name);
    return column ? row[*column] : std::string();
  };
  std::vector<KnownPair> pairs;
  for (const auto& row : table.rows) {
    KnownPair pair;
    pair.current = row[table.column("current").value()];
    pair.target = row[table.column("target").value()];
    pair.same = cell(row, "same") != "0";
    if (!poses.empty()) {
      const Pose& here = poses.at(pair.current);
      const Pose& there = poses.at(pair.target);
      pair.distance_m = distance_m(here, there);
      pair.bearing_rad = wrap_angle(std::atan2(there.y_m - here.y_m, there.x_m - here.x_m) - here.theta_rad);
      pair.turn_rad = wrap_angle(there.theta_rad - here.theta_rad);
      constexpr double kOneSpot_m = 0.05;
      if (pair.distance_m < kOneSpot_m) continue;
      if (pair.distance_m > same_m) pair.same = false;
    } else if (pair.same) {
      pair.bearing_rad = std::stod(cell(row, "bearing_rad"));
      if (const std::string turn = cell(row, "turn_rad"); !turn.empty()) pair.turn_rad = std::stod(turn);
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// What the program would use for this camera, unless told otherwise.
inline features::FeatureConfig usual_features(const camera::CameraConfig& config) {
  return pipeline::suited_feature_config(*or_die(camera::Camera::create(config)));
}

}  // namespace homeward
