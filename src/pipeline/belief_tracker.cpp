// SPDX-License-Identifier: Apache-2.0
#include "pipeline/belief_tracker.hpp"

#include <utility>

namespace homeward::pipeline {

struct BeliefTracker::State {
  std::shared_ptr<const map::TopologicalMap> map;
  Eye eye;
  localisation::Localiser localiser;
  features::Appearance seen;
};

BeliefTracker::BeliefTracker() = default;
BeliefTracker::~BeliefTracker() = default;
BeliefTracker::BeliefTracker(BeliefTracker&&) noexcept = default;
BeliefTracker& BeliefTracker::operator=(BeliefTracker&&) noexcept = default;

Result<BeliefTracker> BeliefTracker::create(std::shared_ptr<const map::TopologicalMap> map,
                                            const camera::CameraConfig& camera,
                                            const localisation::LocaliserConfig& config) {
  const std::string own_id = features::feature_config_id(map->feature_config);
  if (map->feature_config_id != own_id) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The map was made with the feature settings " + map->feature_config_id + ", this program uses " +
                    own_id + ": rebuild the map from the kept images.",
                map->name);
  }
  auto eye = Eye::create(camera, map->feature_config);
  if (!eye) return pass_on(eye);
  localisation::Localiser localiser(map, config);
  BeliefTracker tracker;
  tracker.state_ = std::make_unique<State>(State{std::move(map), std::move(*eye), std::move(localiser), {}});
  return tracker;
}

Result<BeliefTracker> BeliefTracker::create(std::shared_ptr<const map::TopologicalMap> map) {
  const camera::CameraConfig camera = map->camera;
  return create(std::move(map), camera);
}

Result<localisation::Belief> BeliefTracker::update(const Image& picture, const std::optional<Pose2>& odometry) {
  auto seen = state_->eye.look(picture);
  if (!seen) return pass_on(seen);
  return update(std::move(*seen), odometry);
}

localisation::Belief BeliefTracker::update(features::Appearance seen, const std::optional<Pose2>& odometry) {
  state_->seen = std::move(seen);
  return state_->localiser.update(state_->seen, odometry);
}

localisation::Belief BeliefTracker::apply_estimate(const PlaceId& place, double probability) {
  return state_->localiser.apply_estimate(place, probability);
}

void BeliefTracker::restart() { state_->localiser.restart(); }

void BeliefTracker::start_at(const std::vector<PlaceId>& places) { state_->localiser.start_at(places); }

void BeliefTracker::restart_odometry() { state_->localiser.restart_odometry(); }

const features::Appearance& BeliefTracker::seen() const { return state_->seen; }

const map::TopologicalMap& BeliefTracker::map() const { return *state_->map; }

}  // namespace homeward::pipeline
