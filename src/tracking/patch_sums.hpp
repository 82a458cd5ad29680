// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tracking/image_pyramid.hpp"

namespace homeward::tracking {

constexpr int kPatchStride = 16;          // numbers from one row of a patch to the next
constexpr int kLargestPatchSide_px = 15;  // odd
constexpr double kLargestStep_px = 1.5;   // between neighbours of a patch, in the level that is sampled

/// A square reference patch: `side` rows of kPatchStride numbers each, of which those from `side` on are zero.
struct PatchView {
  int side = 0;
  float mean = 0.0F;            // of its grey levels
  const float* grey = nullptr;  // grey levels less their mean
  const float* du = nullptr;    // their gradient, along rows and
  const float* dv = nullptr;    // down columns
};

/// Where the pixels of a patch lie in a level: its first one, and how far apart neighbours are.
struct PatchPlace {
  double first_u_px = 0.0;
  double first_v_px = 0.0;
  double step_px = 1.0;
};

/// Whether a patch lies in the level or reaches out of it by at most `outside_px` (0 to kMostOutside_px).
constexpr double kMostOutside_px = GreyLevel::kBorder_px - 1;
[[nodiscard]] bool inside(const GreyLevel& level, int side, const PatchPlace& place, double outside_px);

/// Sums over a patch of what a level shows there, less the patch's mean (called I below): alone, squared, and times
/// what the reference has (T grey, Tu and Tv gradient, x and y columns and rows from the patch's middle).
struct PatchSums {
  double one = 0.0;     // I
  double square = 0.0;  // I I
  double grey = 0.0;    // I T
  double du = 0.0;      // I Tu
  double dv = 0.0;      // I Tv
  double zoom = 0.0;    // I (x Tu + y Tv)
};

/// Bilinear samples of a level at a place, and their sums with a patch. Preconditions: inside() with kMostOutside_px,
/// step_px from 0 to kLargestStep_px, side odd, to kLargestPatchSide_px. The same numbers on every processor: every
/// column is summed for itself by plain products and sums, and the columns are added in one order.
[[nodiscard]] PatchSums patch_sums(const GreyLevel& level, const PatchView& patch, const PatchPlace& place);

/// Bilinear samples themselves, `side` rows of `stride` numbers. Precondition: inside() with
/// kMostOutside_px.
void sample_patch(const GreyLevel& level, int side, const PatchPlace& place, float* to, int stride);

}  // namespace homeward::tracking
