// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"
#include "linemodel/plan.hpp"
#include "linemodel/plan_builder.hpp"

namespace homeward::linemodel {

/// The triangles of a mesh in a format that assimp reads, from memory, as a plan without lines. No other file is
/// opened. `where` names the mesh in errors. Errors: kUnsupportedFormat (assimp cannot read it, with its reason),
/// kEmptyInput (no triangle), and those of PlanBuilder.
Result<Plan> read_mesh(std::string_view bytes, const std::string& extension, double metres_per_unit, PlanUp up,
                       const std::string& where);

}  // namespace homeward::linemodel
