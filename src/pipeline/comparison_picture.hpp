// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "camera/panorama.hpp"
#include "core/image.hpp"
#include "features/appearance.hpp"
#include "matching/match.hpp"
#include "matching/verify.hpp"

namespace homeward::pipeline {

/// One side of a comparison: the panorama and what was found in it.
struct ComparedView {
  const camera::Panorama& panorama;
  const features::Appearance& appearance;
};

/// What of a comparison is drawn.
struct ComparisonStyle {
  bool words = true;         // strips with a summary, a legend and the ways home and back
  bool unmatched = true;     // features and columns without a match, and matches that do not agree
  int most_lines = 1 << 20;  // of matches that agree: more would hide the views
  bool cut = false;          // what neither view shows left and right is cut off: for lenses that see little
};

/// For people: the present view above, the target's below, turned so that the same direction of the world stands under
/// itself. Features are dots; matches that one motion explains are green lines, those that it does not are red; marks
/// point the way home and, from the target, the way back. `verified` is nothing where no motion is common. Column
/// segments are upright strokes of their length, matches of them violet where the motion explains them, pink where it
/// does not. The panoramas need one geometry.
Image draw_comparison(const ComparedView& current, const ComparedView& target,
                      const std::optional<matching::VerifiedMatch>& verified, const ComparisonStyle& style = {});

}  // namespace homeward::pipeline
