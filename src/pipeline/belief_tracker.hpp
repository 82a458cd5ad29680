// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "localisation/localiser.hpp"
#include "map/topological_map.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {

/// A belief from a stream of pictures: camera, features and localiser of one map together.
class BeliefTracker {
 public:
  /// `camera`: the camera of the stream; it may differ from the map's as long as the feature configuration agrees.
  /// Errors: kFeatureConfigMismatch, kInvalidInput.
  static Result<BeliefTracker> create(std::shared_ptr<const map::TopologicalMap> map,
                                      const camera::CameraConfig& camera,
                                      const localisation::LocaliserConfig& config = {});
  /// A belief with the map's own camera.
  static Result<BeliefTracker> create(std::shared_ptr<const map::TopologicalMap> map);
  ~BeliefTracker();
  BeliefTracker(BeliefTracker&&) noexcept;
  BeliefTracker& operator=(BeliefTracker&&) noexcept;

  /// Errors: kWrongImageSize. A black or covered picture is no error: the belief says lost.
  /// `odometry`: where it was taken, see localisation::Localiser.
  Result<localisation::Belief> update(const Image& picture, const std::optional<Pose2>& odometry = std::nullopt);
  /// The same of a picture whose features are known already, by an eye with this map's feature settings.
  localisation::Belief update(features::Appearance seen, const std::optional<Pose2>& odometry = std::nullopt);
  /// The robot's own estimate, after the update by the same picture; see localisation::Localiser::apply_estimate.
  localisation::Belief apply_estimate(const PlaceId& place, double probability);
  void restart();
  /// A person says where the robot is; see localisation::Localiser::start_at.
  void start_at(const std::vector<PlaceId>& places);
  /// Odometry counts anew; the belief stays.
  void restart_odometry();
  /// Of the latest picture; empty before the first.
  [[nodiscard]] const features::Appearance& seen() const;
  [[nodiscard]] const map::TopologicalMap& map() const;

 private:
  struct State;
  BeliefTracker();
  std::unique_ptr<State> state_;
};

}  // namespace homeward::pipeline
