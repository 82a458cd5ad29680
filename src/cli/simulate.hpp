// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "sim/renderer.hpp"
#include "sim/tour_people.hpp"

namespace homeward::cli {

// The parts of `homeward simulate`, one file each.
void register_simulate_tour(CLI::App& simulate);
void register_simulate_grid(CLI::App& simulate);
void register_simulate_run(CLI::App& simulate);
void register_simulate_plan(CLI::App& simulate);

/// What tours and grids have in common on the command line.
struct StageOptions {
  std::string world;
  std::string light = "day";
  std::string camera = "hyperbolic_mirror";
  std::string out;
  std::uint64_t seed = 1;
};
void add_stage_options(CLI::App& command, StageOptions& options);

/// Writes one picture after another, with all that is known about them, into a folder of a tour.
class TourWriter {
 public:
  /// Errors: kConflict when the folder holds something already, kNotFound, kIo.
  static Result<TourWriter> open(const StageOptions& options);
  TourWriter(TourWriter&&) noexcept;
  TourWriter& operator=(TourWriter&&) noexcept;
  ~TourWriter();

  [[nodiscard]] const sim::World& world() const;
  /// Renders and writes the picture at a pose. `odometry`: what the wheels said there. `moment`: who is about, in
  /// picture and sweep, and how long the way there took; without it nobody, and as long as it takes alone. Errors: kIo.
  Status add(const Pose2& pose, const std::string& room, const Pose2* odometry,
             const sim::TourMoment* moment = nullptr);
  /// The name of the picture written last.
  [[nodiscard]] const std::string& last_name() const;
  /// Writes poses.csv, odometry.csv, times.csv, scans.csv, scans.json, camera.json and, with marks, tour.json.
  Status finish(const std::vector<std::pair<std::string, std::string>>& marks);

 private:
  struct Parts;
  explicit TourWriter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// A camera by the name of its model with this project's usual settings, or from a camera.json.
Result<camera::CameraConfig> camera_named(const std::string& name_or_file);

}  // namespace homeward::cli
