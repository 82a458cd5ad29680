// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "wire/kept_exploration_json.hpp"

namespace homeward::agent {

/// One exploration on the robot's disk: a folder of its id with exploration.json, camera.json, its pictures in tour/
/// and for each picture a file in views/. What was added is there after a kill at any moment, what was being added is
/// not.
class KeptFiles {
 public:
  /// A new one in a folder of explorations. Errors: kInvalidInput (an id that can name no folder), kConflict (there is
  /// one of this id), kIo.
  static Result<KeptFiles> create(const std::filesystem::path& root, const wire::KeptExploration& kept,
                                  const camera::CameraConfig& camera);
  /// One that is there. Errors: kNotFound, kInvalidInput, kUnsupportedFormat, kIo.
  static Result<KeptFiles> open(const std::filesystem::path& folder);
  /// Those of a folder of explorations whose pictures are not on the server yet, the oldest first; what cannot be read
  /// is passed over, and said in `unread`.
  static std::vector<KeptFiles> not_uploaded(const std::filesystem::path& root, std::vector<Error>& unread);

  [[nodiscard]] const wire::KeptExploration& kept() const { return kept_; }
  [[nodiscard]] std::filesystem::path tour_folder() const { return folder_ / "tour"; }
  /// How many pictures there are.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Only the first ones count from now on, after a restart too; the next is written over what stands there. Errors:
  /// kIo.
  Status forget_from(std::size_t size);
  /// All of it leaves the disk. Errors: kIo.
  [[nodiscard]] Status remove() const;
  /// The sweeps of all pictures. Errors: those of `view`.
  [[nodiscard]] Result<std::vector<RangeSweep>> sweeps() const;
  /// The next picture with its view. Errors: kIo.
  Status add(std::span<const std::uint8_t> jpeg, const wire::KeptView& view);
  /// Errors: kIo; then what was kept before stays.
  Status keep(const wire::KeptExploration& kept);
  [[nodiscard]] Result<wire::KeptView> view(std::size_t index) const;
  [[nodiscard]] std::filesystem::path picture(std::size_t index) const;
  /// The tables that make the pictures a tour, with what the robot took its poses to be in the end, one for each
  /// picture; but for the sweeps, each of which has a scanner's pose of its own. What is no whole picture leaves the
  /// folder. Errors: kIo, and those of `view`.
  [[nodiscard]] Status write_tables(std::span<const Pose2> poses) const;

 private:
  KeptFiles(std::filesystem::path folder, wire::KeptExploration kept)
      : folder_(std::move(folder)), kept_(std::move(kept)) {}
  [[nodiscard]] std::filesystem::path view_file(std::size_t index) const;

  std::filesystem::path folder_;
  wire::KeptExploration kept_;
  std::size_t size_ = 0;
};

}  // namespace homeward::agent
