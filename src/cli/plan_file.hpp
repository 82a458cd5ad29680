// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "linemodel/plan.hpp"
#include "map/topological_map.hpp"
#include "pipeline/plan_witness.hpp"

namespace homeward::cli {

/// A file with a drawn plan.
struct PlanFile {
  std::string path;
  double metres_per_unit = 0.0;  // 0: as the file says
  double wall_height_m = 2.5;    // of a flat drawing
};

/// Errors: those of files::read_text and linemodel::read_plan.
Result<linemodel::Plan> read_plan_file(const PlanFile& file);

/// The witness for beliefs in a map that lies on a plan where pins say (proto/schemas/plan_tie.schema.json, in a file).
/// Errors: those of read_plan_file, of reading the pins, map::check_pins, and PlanWitness::create.
Result<pipeline::PlanWitness> witness_on_plan(const map::TopologicalMap& map, const camera::CameraConfig& camera,
                                              const PlanFile& file, const std::string& pins);

}  // namespace homeward::cli
