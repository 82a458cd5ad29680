// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "camera/panorama.hpp"
#include "features/appearance.hpp"
#include "features/column_segment.hpp"

namespace homeward::features {

/// Of many segments, a row for each.
using UnroundedColumns = Eigen::Matrix<float, Eigen::Dynamic, kColumnInvariants, Eigen::RowMajor>;

/// The three colour invariants of the segment and the first seven coefficients after the constant one of the cosine
/// transform of its intensity profile, as shares of the profile's spread. Both look at the segment widened by 0.2 of
/// its length: sideways, as in the paper, and beyond its ends, because what lies between two edges is often plain. A
/// band that varies by less than a grey level gives 0; a camera without colour gives 1 for all three, always, so that
/// they then tell nothing apart. Brightness times a factor plus an offset changes none of the ten.
ColumnInvariants column_invariants(const camera::Panorama& panorama, const ColumnSegment& segment);

/// The invariant column segments of a panorama (Goedemé 2007 §3.3): one prototype for each run of alike segments in
/// neighbouring columns, at most `config.max_columns`, those of most contrast at each azimuth first. `bearings` point
/// to their middles, `scales_rad` are their lengths in elevation, `colours` the colour invariants times 127 and
/// `descriptors` 128 plus 127 times the profile's coefficients. Turning the robot changes azimuths and nothing else.
/// `unrounded`, where asked for, gets the invariants before they become bytes.
FeatureSet extract_columns(const camera::Panorama& panorama, const FeatureConfig& config,
                           UnroundedColumns* unrounded = nullptr);

/// The upper and lower end of segment `index` as unit vectors in the robot frame.
struct ColumnEnds {
  Eigen::Vector3d top;
  Eigen::Vector3d bottom;
};
ColumnEnds column_ends(const FeatureSet& columns, int index);

}  // namespace homeward::features
