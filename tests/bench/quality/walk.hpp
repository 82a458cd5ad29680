// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "files/tour_folder.hpp"
#include "map/topological_map.hpp"
#include "mapping/parallel.hpp"
#include "truth.hpp"

/// Walks with true poses, seen as a map's camera and features have it.
namespace homeward {

inline std::string file_of(const ImageId& id) { return id.str().substr(id.str().rfind('/') + 1); }

inline Pose2 pose2_of(const Pose& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }

inline double apart_m(const Pose2& a, const Pose2& b) { return (position_m(a) - position_m(b)).norm(); }

struct Walk {
  std::string name;
  std::vector<Image> pictures;  // empty where nobody asked for them
  std::vector<features::Appearance> seen;
  std::vector<std::optional<Pose2>> odometry;
  std::vector<Pose2> truth;
};

/// The pictures of a folder with poses.csv, in name order.
inline Walk see(const std::filesystem::path& folder, const map::TopologicalMap& map, int threads, bool keep_pictures) {
  const files::TourFolder source = or_die(files::TourFolder::open(folder));
  const auto poses = read_poses(folder / "poses.csv");
  const auto eye = or_die(pipeline::Eye::create(map.camera, map.feature_config));
  Walk walk;
  walk.name = folder.filename().string();
  for (const TourImage& image : source.images()) {
    walk.odometry.push_back(image.odometry);
    walk.truth.push_back(pose2_of(poses.at(file_of(image.id))));
  }
  walk.seen.resize(source.images().size());
  if (keep_pictures) walk.pictures.resize(source.images().size());
  const auto look = [&](std::size_t i) {
    Image picture = or_die(source.read(i));
    walk.seen[i] = or_die(eye.look(picture));
    if (keep_pictures) walk.pictures[i] = std::move(picture);
  };
  mapping::parallel_for(walk.seen.size(), threads, look, [](std::size_t) {}, {});
  return walk;
}

}  // namespace homeward
