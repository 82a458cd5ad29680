// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/panorama.hpp"
#include "features/appearance.hpp"
#include "features/columns.hpp"

namespace homeward::features {

/// What features are before they are rounded to bytes, a row for each: to measure what the bytes cost.
struct Unrounded {
  Eigen::Matrix<float, Eigen::Dynamic, 128, Eigen::RowMajor>
      sift;  // descriptors of the first window, not turned or cut yet
  UnroundedColumns columns;
};

/// The features of one panorama: upright SIFT with colour invariants, spread over azimuth, and the colour moments.
/// A picture without texture gives few or none. Seam-safe: turning the robot moves features and changes nothing else.
/// Method: Lowe 2004; fixed orientation after Ledwich & Williams 2004; Goedemé 2007 §3.2 (colour invariants);
/// Arandjelović & Zisserman 2012 (square roots of descriptors).
/// `unrounded`, where asked for, is filled with as many rows as there are features of each kind.
Appearance extract(const camera::Panorama& panorama, const FeatureConfig& config, Unrounded* unrounded = nullptr);

}  // namespace homeward::features
