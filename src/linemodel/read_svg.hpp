// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "linemodel/plan.hpp"

namespace homeward::linemodel {

struct SvgPlanConfig {
  std::optional<double> metres_per_unit;  // of the drawing's user units; not given: as its width and viewBox say
  double wall_height_m = 2.5;
};

/// A floor plan drawn as SVG (1.1, as far as straight lines go): every `line`, `polyline`, `polygon`, `rect` and the
/// straight parts of every `path` are walls (extrude_walls), moved by `transform`. Curves (doors that swing), circles,
/// texts and pictures are stepped over, and so is what is not drawn where it stands (`defs`, `symbol`, `clipPath`,
/// `marker`, `mask`, `pattern`, display="none"). Nothing is fetched.
/// The plan's x points to the drawing's right, y up; the origin is the viewBox's lower left corner, or without one the
/// drawing's own.
/// `where` names the file in errors. Errors, with the line of the file: kTooLarge (64 MiB, 200,000 walls),
/// kUnsupportedFormat (no SVG; `use`), kInvalidInput (XML that is not well-formed, a number, path or transform that
/// cannot be read, no scale, and those of extrude_walls), kEmptyInput (no straight line).
Result<Plan> read_svg(std::string_view text, const SvgPlanConfig& config, const std::string& where);

}  // namespace homeward::linemodel
