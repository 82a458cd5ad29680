// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "homing/home_vector.hpp"

namespace homeward::homing {

struct ScaleSpaceConfig {
  int fewest_matches = 12;     // with a change of scale that shows
  double least_change = 0.03;  // of the logarithm of a feature's size
};

/// Homing in scale space (Churchill & Vardy 2008; Ferdaus 2008 §4.3, eq. 4.3-4.5): features that are smaller here than
/// in the target lie where the target is, those that are larger lie away from it. With mean directions of both kinds,
/// weighed by how many there are, the direction home is that of their difference. The turn is the circular median of
/// the bearings' changes. No geometry and no camera model but bearings: rough, but it does not fail where geometry
/// degenerates. Its confidence rises with the features' agreement and is not calibrated. Errors: kTooFewFeatures,
/// kTooLittleSupport.
Result<HomeVector> scale_space_vector(const features::Appearance& current, const features::Appearance& target,
                                      const ScaleSpaceConfig& config);

}  // namespace homeward::homing
