// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"
#include "linemodel/plan.hpp"
#include "linemodel/plan_builder.hpp"

namespace homeward::linemodel {

/// A plan drawn as a VRML97 wire-frame (ISO/IEC 14772-1:1997), from memory. Lines are its IndexedLineSets and the edges
/// of its Boxes, surfaces its IndexedFaceSets and Boxes, wherever Group, Transform, Anchor, Billboard, Collision,
/// Switch (the choice it names), LOD (its finest level) and DEF/USE put them. What has no edges (lights, views, looks,
/// texts, points, sounds, sensors, scripts, routes) is stepped over. Nothing is fetched and nothing is run. Units are
/// metres. VRML's own convention is y up; what `write_vrml` writes is z up: `up` says which. `where` names the file in
/// errors. Errors, with the line of the file: kTooLarge (64 MiB, 2,000,000 lines or triangles, nodes used over and
/// over), kUnsupportedFormat (no VRML97; a node that would have edges but is not read: Inline, prototypes, Sphere,
/// Cylinder, Cone, Extrusion, ElevationGrid), kInvalidInput (what does not follow the grammar, an index without a
/// point, a point more than 10 km away), kEmptyInput (neither line nor face). A reader of our own: Coin 4.0 was tried,
/// and crashes on what anybody can write (an index out of range, a group that uses itself, deep nesting), and opens the
/// files that an Inline names.
Result<Plan> read_vrml(std::string_view text, PlanUp up, const std::string& where);

}  // namespace homeward::linemodel
