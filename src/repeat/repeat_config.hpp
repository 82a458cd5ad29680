// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/two_view.hpp"
#include "repeat/arc_pose.hpp"
#include "repeat/key_gallery.hpp"
#include "tracking/feature_tracker.hpp"

namespace homeward::repeat {

/// Two views of something that drives on a floor and may be beside its path: any direction on the floor.
inline geometry::TwoViewConfig repeat_geometry() {
  geometry::TwoViewConfig geometry;
  geometry.driving = geometry::DrivingPrior{};
  geometry.driving->swerve_rad = 10.0;
  return geometry;
}

inline PoseFitConfig repeat_pose() {
  PoseFitConfig pose;
  pose.driving = geometry::DrivingPrior{};
  return pose;
}

/// Also by much less light than there was in teaching (docs/experiments/repeating_a_path.md).
inline tracking::FeatureTrackerConfig repeat_tracker() {
  tracking::FeatureTrackerConfig tracker;
  tracker.darker_residual = true;
  tracker.least_gain = 0.15;
  return tracker;
}

struct RepeatConfig {
  int reach = 3;                   // arcs before and after the actual one whose features are tracked, too (Segvic et
                                   // al. 2007: 1)
  double most_error_rad = 0.0175;  // reprojection error above which a picture is lost: nothing is predicted, and no arc
                                   // left (there: sigma, 4 px of 320)
  double doubtful_error_rad = 0.008;  // above which the arc's geometry is said to be doubtful
  int fewest_features = 8;            // with fewer that agree the picture is lost
  double least_agreeing = 0.5;        // of the features that are tracked: with a smaller share there is no geometry
  double least_expected = 0.12;       // of the features that should be in the picture: a smaller share is chance
  double least_visible = 2.0;         // (grey levels a pixel)^2: by little light, what shows less than that is not
                                      // expected, as a camera's noise is more
  int fewest_recovered = 15;          // the same two after the place was lost
  double least_recovered = 0.2;
  double enough_agreeing = 0.75;  // of the features that are tracked: with fewer the arc's geometry is doubted, and the
                                  // pictures themselves are asked
  double passed = 1.0;            // progress along an arc beyond which it is left
  double turned = 0.5;            // share of a turn that is enough where the way along the arc is behind
  double nearly_passed = 0.7;     // progress that is enough where so much of a turn that follows is made already
  double turning = 0.4;
  double clear_way_rad = 0.03;  // way, over the landmarks' distance, that tells an arc where its turn does not: whoever
                                // drives on may turn back before a turn is made
  double back = -0.15;          // progress below which the arc before is gone back to
  int most_transitions = 3;     // in one picture
  double most_from_predicted_rad = 0.05;  // a feature found farther from where it was predicted is another one
  double most_from_start_rad = 0.2;       // the same while lost
  int most_predicted = 150;               // features looked for where they are predicted, in one picture
  int keys_tried = 2;                     // key images from which everything is looked for, in one picture, while lost
  double retry_share = 0.7;  // where less of what was tracked still is, the shift of the whole picture is tried, too
  double turn_from_scale = 1.25;  // references of the key image in which a feature looks so much more alike in size are
                                  // taken instead
  int fewest_scaled = 5;          // common points that units are joined by
  double steering_gain = 1.0;     // lambda, there
  PoseFitConfig pose = repeat_pose();
  geometry::TwoViewConfig geometry = repeat_geometry();
  tracking::FeatureTrackerConfig tracker = repeat_tracker();           // most_residual is R, there
  std::optional<RecognitionConfig> recognition = RecognitionConfig{};  // none: what is lost is looked for nearby alone
  std::uint64_t seed = 1;
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const RepeatConfig& config);

}  // namespace homeward::repeat
