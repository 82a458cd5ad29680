// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "core/result.hpp"
#include "geometry/correspondence.hpp"
#include "geometry/motion_fit.hpp"
#include "geometry/planar_estimate.hpp"

namespace homeward::geometry {

/// A fit with its direction's sign settled, as an estimate; the evidence is left to the caller, who knows the search.
/// Errors: kTooLittleSupport when fewer than three matches are within the bound.
/// No method of its own: what motion_fit.hpp and direction_sign.hpp found, in one struct.
Result<PlanarEstimate> summarise(std::span<const Correspondence> correspondences, MotionFit fit, double max_error_rad);

/// What `estimate` makes of the matches whose numbers all are numbers; inliers index all the same.
Result<PlanarEstimate> with_finite_only(
    std::span<const Correspondence> correspondences,
    const std::function<Result<PlanarEstimate>(std::span<const Correspondence>)>& estimate);

}  // namespace homeward::geometry
