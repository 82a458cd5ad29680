// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "features/appearance.hpp"
#include "homing/feature_tracks.hpp"
#include "homing/home_vector.hpp"
#include "homing/local_map.hpp"

namespace homeward::homing {

struct VisualHomingConfig {
  HomingConfig first;              // of the home vector that begins
  int recognise_every = 3;         // pictures: of so many at least one is recognised anew
  int fewest_tracked = 12;         // with fewer the next picture is recognised
  double begin_confidence = 0.5;   // of it; less certain ones begin nothing
  double prior_odds = 1.0;         // its odds are multiplied by these: what is known beside the pictures
  double metres_per_parallax = 4;  // first guess of the distance where nothing else is known
  int patience = 4;                // pictures in a row that may contradict before it begins anew
  bool columns = false;            // the local map takes column segments in as well
  LocalMapConfig map;
  FeatureTracksConfig tracks;
};

/// How far a target may be, as is known beside the pictures.
struct DistancePrior {
  double distance_m = 1.0;
  double spread = 0.5;  // of the logarithm
  bool mapped = true;   // by a map; not by nothing but bearings to the target itself
};

/// How far a target usually is of whose features this share is recognised, by the median of rooms. Of few features it
/// says more than their parallax: far things alone show none at any distance.
double usual_distance_m(double share);

/// The share of two views' features that agree on where one lies from the other: 0.3 and more where they coincide, by
/// night as well.
double shared_share(const features::Appearance& current, const features::Appearance& target, int inliers);

/// Where the target is, as the robot sees it now.
struct TargetSeen {
  HomeVector vector;
  std::optional<Eigen::Vector2d> target_m;                      // in the robot frame; metres where odometry is known
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  // of it, robot frame
  double map_confidence = 0.0;                                  // probability that the local map is right
  int known = 0;                                                // features of the local map
  TrackCounts tracks;                                           // in the latest picture
  bool began = false;                                           // the local map is new
};

/// Homing to one view through a local map of its features (Goedemé 2007 §7.2): an initialisation by two views, then a
/// pose against the map for every picture, the map growing and being refined as the robot moves. Of a column segment,
/// where `columns` lets it in, the ends that matching::bearings_of takes are the feature, its upper and its lower end
/// one of its own each; they follow the SIFT features in number and so in what is tracked. Deterministic by the
/// pictures and seeds given. Copies are independent.
class VisualHoming {
 public:
  /// With a smaller share of its features recognised, a target is not right here, whatever the geometry says.
  static constexpr double kLeastShare = 0.05;

  VisualHoming() = default;
  explicit VisualHoming(const VisualHomingConfig& config) : config_(config), map_(config.map), tracks_(config.tracks) {}

  /// One more picture, recognised anew. `target`: always the same. `frame`: the picture itself, for `track` to go on
  /// from. Of less than kLeastShare of its features no map is begun unless a map says how far the target is: an answer
  /// is a bearing alone then. Errors: those of home_vector, where neither the map nor two views alone say where the
  /// target is.
  Result<TargetSeen> update(const features::Appearance& current, const features::Appearance& target,
                            const std::optional<Pose2>& odometry, const std::optional<DistancePrior>& prior,
                            const tracking::TrackingFrame& frame, std::uint64_t seed);

  /// One more picture through the features tracked from the one before: some three times as fast as recognising it.
  /// Errors: kTooLittleSupport, before the first `update` that found the target too.
  Result<TargetSeen> track(const tracking::TrackingFrame& frame, const std::optional<Pose2>& odometry,
                           std::uint64_t seed);

  /// Whether the next picture is better recognised than tracked.
  [[nodiscard]] bool wants_features() const { return wants_features_; }

  [[nodiscard]] const LocalMap& map() const { return map_; }

 private:
  [[nodiscard]] TargetSeen answer(const LocalPose& pose, const HomeVector* fresh, int matches) const;
  [[nodiscard]] std::optional<Pose2> expected(const std::optional<Pose2>& odometry) const;
  void keep(const LocalPose& pose, const std::optional<Pose2>& odometry);
  /// The target by a pose against the map: the map grows with what agrees, and tracks begin. `inliers`: of `all`.
  TargetSeen seen_by_map(const LocalPose& pose, const std::vector<Sighting>& all, const std::vector<int>& inliers,
                         const std::optional<Pose2>& odometry, const tracking::TrackingFrame& frame);
  Result<TargetSeen> recognise(const features::Appearance& current, const features::Appearance& target,
                               const std::optional<Pose2>& odometry, const std::optional<DistancePrior>& prior,
                               const tracking::TrackingFrame& frame, std::uint64_t seed);

  VisualHomingConfig config_;
  LocalMap map_;
  FeatureTracks tracks_;
  double log_odds_ = 0.0;        // that the map is right
  double first_distance_ = 1.0;  // baseline of the first two views
  int misses_ = 0;
  int tracked_for_ = 0;  // pictures since the target was recognised
  bool wants_features_ = true;
  std::optional<LocalPose> latest_;
  std::optional<Pose2> latest_odometry_;
};

}  // namespace homeward::homing
