// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "features/appearance.hpp"
#include "matching/match.hpp"
#include "matching/nearest_columns.hpp"

namespace homeward::matching {

struct ColumnMatchConfig {
  double ratio = 0.8;                  // to the second best, of Mahalanobis distances
  double max_distance = 5.0;           // Mahalanobis distance above which nothing is alike
  double max_height_error_rad = 0.02;  // of the proportion of both ends' heights, tilts of the camera included
  int max_colour_difference = 100;     // largest difference of one colour invariant, of 254
};

/// Column segments that look alike: mutual nearest neighbours by diagonal Mahalanobis distance of their ten invariants
/// that pass the ratio test in both directions and the colour check. Ascending in `current`; exchanging the pictures
/// exchanges the sides of each match and changes nothing else. (Goedemé 2007 §3.4, equation 2.)
std::vector<Match> match_columns(const features::FeatureSet& current, const features::FeatureSet& target,
                                 const ColumnMatchConfig& config);

/// The same by invariants given apart from the sets, which may be more exact than the bytes there.
std::vector<Match> match_columns(const features::FeatureSet& current, const features::FeatureSet& target,
                                 const ScaledColumns& of_current, const ScaledColumns& of_target,
                                 const ColumnMatchConfig& config);

/// The one correspondence that a match of columns is worth: the ends farther from the horizon. Both ends would be no
/// two: their heights stand in one proportion whatever the motion, which match_columns has asked already. Middles of
/// segments are not images of one point.
struct ColumnBearings {
  Eigen::Vector3d current;
  Eigen::Vector3d target;
  bool bottom = false;  // the lower ends of both; else the upper ones
};
ColumnBearings bearings_of(const features::FeatureSet& current, const features::FeatureSet& target, const Match& match);

}  // namespace homeward::matching
