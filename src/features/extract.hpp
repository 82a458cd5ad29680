// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/panorama.hpp"
#include "features/appearance.hpp"

namespace homeward::features {

/// The features of one panorama: upright SIFT with colour invariants, spread over azimuth, and the colour moments.
/// A picture without texture gives few or none. Seam-safe: turning the robot moves features and changes nothing else.
/// Method: Lowe 2004; fixed orientation after Ledwich & Williams 2004; Goedemé 2007 §3 (colour invariants);
/// Arandjelović & Zisserman 2012 (square roots of descriptors).
Appearance extract(const camera::Panorama& panorama, const FeatureConfig& config);

}  // namespace homeward::features
