// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::camera {

/// The ring of a picture in which a mirror shows the world, and how sure that is.
struct MirrorRing {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  // of the rim
  double radius_min_px = 0.0;                           // of the dark middle, 0 where none is found
  double radius_max_px = 0.0;                           // of the rim
  double spread_px = 0.0;                               // standard deviation of the rim's edge from the circle (robust)
  double centre_deviation_px = 0.0;  // one standard deviation of the centre: by the spread, or by single pictures
  double rim_share = 0.0;            // of the directions in which the rim lies in the picture: where its edge was found
  double middle_share = 0.0;         // the same of the dark middle
};

/// Finds the mirror without a board, from the edge between its bright picture and its dark rim. Pictures of one camera;
/// several of different surroundings make the rim bright in more directions (their brightest values are taken). Edges
/// vote along their gradients for the centre (Kimme, Ballard & Sklansky 1975), then a circle is fitted robustly to the
/// steepest point in each direction (Cauchy weights).
/// Errors: kEmptyInput (no pictures), kWrongImageSize (sizes differ), kInvalidInput (below 64 pixels a side),
/// kTooLittleSupport (no rim goes round).
Result<MirrorRing> find_mirror_ring(const std::vector<Image>& pictures);

}  // namespace homeward::camera
