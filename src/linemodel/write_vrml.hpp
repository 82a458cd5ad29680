// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "linemodel/plan.hpp"

namespace homeward::linemodel {

/// A plan as a VRML97 text: an IndexedLineSet of its lines and an IndexedFaceSet of its triangles, metres, z up.
/// `read_vrml` with PlanUp::kZ gives the same lines and triangles back, to the last bit.
std::string write_vrml(const Plan& plan);

}  // namespace homeward::linemodel
