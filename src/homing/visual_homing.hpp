// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "features/appearance.hpp"
#include "homing/home_vector.hpp"
#include "homing/local_map.hpp"

namespace homeward::homing {

struct VisualHomingConfig {
  HomingConfig first;              // of the home vector that begins
  double begin_confidence = 0.5;   // of it; less certain ones begin nothing
  double prior_odds = 1.0;         // its odds are multiplied by these: what is known beside the pictures
  double metres_per_parallax = 4;  // first guess of the distance where nothing else is known
  int patience = 4;                // pictures in a row that may contradict before it begins anew
  LocalMapConfig map;
};

/// How far a target may be, as is known beside the pictures.
struct DistancePrior {
  double distance_m = 1.0;
  double spread = 0.5;  // of the logarithm
};

/// Where the target is, as the robot sees it now.
struct TargetSeen {
  HomeVector vector;
  std::optional<Eigen::Vector2d> target_m;                      // in the robot frame; metres where odometry is known
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  // of it, robot frame
  int known = 0;                                                // features of the local map
  bool began = false;                                           // the local map is new
};

/// Homing to one view through a local map of its features (Goedemé 2007 §7.2): an initialisation by two views, then a
/// pose against the map for every picture, the map growing and being refined as the robot moves. Deterministic by the
/// pictures and seeds given. Copies are independent.
class VisualHoming {
 public:
  VisualHoming() = default;
  explicit VisualHoming(const VisualHomingConfig& config) : config_(config), map_(config.map) {}

  /// One more picture. `target`: always the same. Errors: those of home_vector, where neither the map nor two views
  /// alone say where the target is.
  Result<TargetSeen> update(const features::Appearance& current, const features::Appearance& target,
                            const std::optional<Pose2>& odometry, const std::optional<DistancePrior>& prior,
                            std::uint64_t seed);

  [[nodiscard]] const LocalMap& map() const { return map_; }

 private:
  [[nodiscard]] TargetSeen answer(const LocalPose& pose, const HomeVector* fresh, int matches) const;

  VisualHomingConfig config_;
  LocalMap map_;
  double log_odds_ = 0.0;        // that the map is right
  double first_distance_ = 1.0;  // baseline of the first two views
  int misses_ = 0;
};

}  // namespace homeward::homing
