// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "linemodel/plan.hpp"
#include "linemodel/plan_builder.hpp"

namespace homeward::linemodel {

struct ReadPlanConfig {
  std::optional<PlanUp> up;               // of the file; not given: y of glTF, z of the others
  std::optional<double> metres_per_unit;  // of the file; not given: 1, of SVG as it says itself
  double wall_height_m = 2.5;             // of floor plans
};

/// A plan from a file's bytes; `extension` tells the format, `where` names the file in errors:
/// - wrl: a VRML97 wire-frame (read_vrml); one of faces alone gets its feature edges;
/// - svg: a floor plan whose walls are stood up (read_svg);
/// - glb, gltf, obj, ply, stl: a mesh, through assimp, with its feature edges. Nothing beside the file is read, so what
///   it needs has to be in it.
/// Errors: those of read_vrml and read_svg; kUnsupportedFormat (another extension, a mesh that assimp cannot read),
/// kEmptyInput, kTooLarge (64 MiB, 2,000,000 triangles), kInvalidInput (a scale that is not above zero, a point more
/// than 10 km away).
Result<Plan> read_plan(std::string_view bytes, const std::string& extension, const ReadPlanConfig& config,
                       const std::string& where);

}  // namespace homeward::linemodel
