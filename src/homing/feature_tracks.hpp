// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "homing/local_map.hpp"
#include "homing/sighting.hpp"
#include "tracking/intensity.hpp"
#include "tracking/tracking_frame.hpp"

namespace homeward::homing {

struct FeatureTracksConfig {
  tracking::TrackConfig track;
  int most = 150;                  // features followed: the strongest all around
  int patch_px = 15;               // side of what is remembered of a feature's surroundings
  double least_in_common = 0.7;    // of two intensity histograms, for a lost feature to be looked for
  double least_correlation = 0.8;  // of the patch, for it to be taken up again
  int search_px = 5;               // round where it should be
  int forget_after = 30;           // pictures that a feature may stay lost
  int neighbour_px = 0;            // a feature is tracked by the strongest corner so near to it; 0: by itself
};

/// What happened to the features from one picture to the next.
struct TrackCounts {
  int tracked = 0;    // seen in this picture, the recovered ones among them
  int recovered = 0;  // lost before and taken up again
  int lost = 0;       // known and not seen now
};

/// The features of a local map followed from picture to picture (Goedemé 2007 §7.2): tracked, and where they get lost,
/// taken up again where the map says they must be when the surroundings look as they did. With `neighbour_px` what is
/// tracked is the best trackable point near a feature (§7.2.1), and the feature is taken to keep its place beside it in
/// the picture, as what lies on one surface nearly does while the distance changes little. Copies are independent.
class FeatureTracks {
 public:
  FeatureTracks() = default;
  explicit FeatureTracks(const FeatureTracksConfig& config) : config_(config) {}

  [[nodiscard]] bool empty() const { return tracks_.empty(); }
  [[nodiscard]] const TrackCounts& counts() const { return counts_; }

  /// Takes features where they were recognised in a picture: what was tracked before moves there. Of many, those with
  /// the lowest numbers, which are the strongest of each direction.
  void anchor(const tracking::TrackingFrame& frame, std::span<const Sighting> sightings);

  /// Follows all features into the next picture; `guess`: where the map and odometry say that the robot is. Gives those
  /// that were found; what they say is still to be checked.
  std::vector<Sighting> follow(const tracking::TrackingFrame& next, const LocalMap& map, const Pose2& guess);

  /// Once the pose of that picture is known: features that do not agree with it are lost, and lost ones that it makes
  /// visible are taken up again. Gives the sightings that hold.
  std::vector<Sighting> settle(const LocalMap& map, const Pose2& target_from_robot);

 private:
  struct Track {
    Eigen::Vector3d target = Eigen::Vector3d::UnitX();
    Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();   // of what is tracked,
    Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  // which lies so far from the feature
    std::vector<std::uint8_t> patch;
    tracking::IntensityHistogram histogram{};
    int lost_for = 0;  // pictures; 0: seen in the latest
  };

  FeatureTracksConfig config_;
  tracking::TrackingFrame frame_;
  std::map<int, Track> tracks_;
  TrackCounts counts_;
};

}  // namespace homeward::homing
