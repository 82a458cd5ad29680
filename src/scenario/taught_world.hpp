// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"
#include "pipeline/eye.hpp"
#include "scenario/kept_tour.hpp"
#include "sim/renderer.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// A world, the map that a tour of it gave, and where each destination's picture was truly taken.
struct TaughtWorld {
  std::unique_ptr<sim::LitWorld> world;
  camera::CameraConfig camera;
  std::shared_ptr<const map::TopologicalMap> map;
  map::MetricLayout layout;                        // map::metric_layout of it
  std::map<std::string, Pose2> destination_poses;  // by room; for judging only
  std::map<ImageId, Pose2> picture_poses;          // of the tour; for judging and putting things in the way only
  std::shared_ptr<const KeptTour> tour;            // what it showed
};

/// The world that a scenario in `folder` names. Errors: those of load_world.
Result<sim::World> world_of(const wire::ScenarioFile& scenario, const std::string& folder);

/// Renders the scenario's tour of its world and builds the map, or the map of the path that it taught. Errors: those of
/// read_camera, plan_tour, build_map and teach_path.
Result<TaughtWorld> teach(const wire::ScenarioFile& scenario, const std::string& folder, sim::World world);

}  // namespace homeward::scenario
