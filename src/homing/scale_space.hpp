// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "homing/home_vector.hpp"

namespace homeward::homing {

/// How the direction home is made of features that contracted and features that expanded.
enum class ScaleSpaceSum {
  kEachFeature,  // every feature's direction counts one, so that a group that is spread out counts less (ours)
  kGroupSizes,   // each group's mean direction counts as much as it has features (Ferdaus 2008, eq. 4.3-4.5)
};

struct ScaleSpaceConfig {
  int fewest_matches = 12;     // with a change of scale that shows
  double least_change = 0.03;  // of the logarithm of a feature's size
  ScaleSpaceSum sum = ScaleSpaceSum::kEachFeature;
};

/// A feature that is smaller (contracted) or larger here than in the target, and where it is seen here.
struct ScaleChange {
  double bearing_rad = 0.0;
  bool contracted = true;
};

struct ScaleSpaceDirection {
  double bearing_rad = 0.0;  // to drive, (-pi, pi]
  double agreement = 0.0;    // of all features, expanded ones turned round: length of their mean, 0 to 1
};

/// The direction home, atan2(s, c). With kGroupSizes s = |M_pos| sin(theta_pos) + |M_neg| sin(theta_neg + pi) and c
/// likewise with cosines, where M_pos are the contracted features, M_neg the expanded ones, theta their circular mean
/// directions (Ferdaus 2008, eq. 4.3-4.5, which print the pi outside of sine and cosine; after Churchill and Vardy
/// 2008). Precondition: at least one feature.
ScaleSpaceDirection scale_space_direction(std::span<const ScaleChange> changes, ScaleSpaceSum sum);

/// Homing in scale space (Churchill and Vardy 2008; Ferdaus 2008 §4.3): features that are smaller here than in the
/// target lie where the target is, those that are larger lie away from it; `config.sum` says how they are put together.
/// The turn is the circular median of the bearings' changes. No geometry and no camera model but bearings: rough, but
/// it does not fail where geometry degenerates. Its confidence rises with the features' agreement and is not
/// calibrated. Errors: kTooFewFeatures, kTooLittleSupport.
Result<HomeVector> scale_space_vector(const features::Appearance& current, const features::Appearance& target,
                                      const ScaleSpaceConfig& config);

}  // namespace homeward::homing
