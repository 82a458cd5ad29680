// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/two_view.hpp"
#include "repeat/key_gallery.hpp"
#include "tracking/feature_tracker.hpp"
#include "tracking/harris.hpp"

namespace homeward::repeat {

/// The corners of a key image. A stricter sensitivity than usual: corners that an edge makes with what is behind it are
/// like edges, and slide along it (docs/experiments/teaching_a_path.md). `most` is what TeachConfig leaves.
inline tracking::HarrisConfig key_corners() {
  tracking::HarrisConfig corners;
  corners.spacing_px = 5.0;
  corners.sensitivity = 0.08;
  corners.least_strength = 10.0;
  return corners;
}

/// Of something that drives on a floor.
inline geometry::TwoViewConfig driving_geometry() {
  geometry::TwoViewConfig geometry;
  geometry.driving = geometry::DrivingPrior{};
  return geometry;
}

/// Where nothing can be tracked across a gap, and where a path comes round to its beginning: pictures matched without
/// any expectation.
struct BridgingConfig {
  RecognitionConfig matching{};
  int most_ahead = 10;              // pictures after a key image that are matched with it
  double most_turn_off_rad = 0.07;  // by which what was matched and what was then tracked may differ in the turn
  double least_lead = 10.0;         // over the best motion in another direction (geometry::TwoViewEstimate)
  int fewest_around = 6;            // arcs with a way that a closed path has
  double most_aside_rad = 1.05;     // of the way back to where it is closed, from straight ahead
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const BridgingConfig& config);

struct TeachConfig {
  double most_error_px = 4.0;   // sigma of Segvic et al. 2007, 2.1: reprojection error above which no arc goes on
  int least_features = 50;      // n, there: fewer agreeing with the geometry end an arc
  double least_share = 0.5;     // an arc that begins with fewer than n / least_share goes on while it keeps that share
  int fewest_features = 15;     // with fewer in an arc's second picture its key image is lost
  double least_agreeing = 0.5;  // of the features that are tracked: with a smaller share on the geometry there is none
  double least_kept = 0.15;  // of a key image's features: a smaller share agreeing in an arc's second picture is chance
  int least_common = 10;     // features of the arc before: fewer left end an arc (there: at least one)
  int fewest_known = 12;     // points whose distance the arc before tells: fewer say nothing of the motion
  double known_weight = 1.0;  // of what they say, beside the pairs; 0: they are not asked
  int fewest_scaled = 5;      // common points that a scale ratio is taken from
  int most_skipped = 3;       // pictures in a row that nothing can be followed into; more cut the path
  double retry_share = 0.7;   // where less of what agreed before does so again, features are looked for by the shift
                              // of the whole picture, too
  int most_features = 500;    // of a key image
  tracking::HarrisConfig corners = key_corners();
  tracking::FeatureTrackerConfig tracker{};  // most_residual is R, there
  geometry::TwoViewConfig geometry = driving_geometry();
  std::optional<BridgingConfig> bridging = BridgingConfig{};  // none: what cannot be tracked cuts the path
  std::uint64_t seed = 1;
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const TeachConfig& config);

/// How a path is best taught that is to be repeated beside where it was shown: more and weaker corners, and arcs that
/// end while three quarters of them are left (docs/experiments/repeating_a_path.md). Its tracker is the one to repeat
/// it with, too.
TeachConfig dense_teaching();

}  // namespace homeward::repeat
