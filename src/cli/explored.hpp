// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "camera/camera_config.hpp"
#include "cli/explore.hpp"
#include "core/ids.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "exploration/explorer.hpp"
#include "map/topological_map.hpp"
#include "scenario/exploration_run.hpp"

namespace homeward::cli {

// What explorations by survey, of one robot or of two, begin with and come to.

/// The machine's time, from any moment on.
double now_ms();

/// What the options say, for a robot where it stands now. Errors: kInvalidInput (a fence that is none).
Result<scenario::ExplorationPlan> plan_of(const ExploreOptions& options, const ExploringRobot& explorer);

/// How much of the floor that it has seen so far pictures cover.
double covered_share(const exploration::Explorer& explorer);

/// Why it did not see all, in words; empty: it did.
std::string reason_of(const scenario::ExplorationResult& explored);

/// Errors: kIo.
Status write_png(const std::filesystem::path& file, const Image& drawn);

/// The pictures with what the robot took itself to be in the end, as a tour. Errors: those of TourFiles.
Status write_tour(const std::filesystem::path& folder, const camera::CameraConfig& camera, const sim::World& world,
                  const scenario::ExplorationResult& explored);

/// The id in the map of a picture of the tour in a folder of that name.
ImageId image_of(const std::string& tour, std::size_t picture);

/// Where the pictures were truly taken, by their names in a map of the tour's folder of that name.
void add_taken(const std::string& tour, const scenario::ExplorationResult& explored,
               std::unordered_map<ImageId, Pose2>& taken);

/// The map of these tours, which it writes. Errors: those of pipeline::build_map, kIo.
Result<map::TopologicalMap> build_map_of(const std::vector<std::filesystem::path>& tours_made,
                                         const std::filesystem::path& out, const camera::CameraConfig& camera,
                                         const ExploreOptions& options);

/// 0 of none.
double median(std::vector<double> values);

}  // namespace homeward::cli
