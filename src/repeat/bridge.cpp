// SPDX-License-Identifier: Apache-2.0
#include "repeat/bridge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward::repeat {

bool holds(const SubrangeView& view, int looked_for, const WideMatch& match, const TeachConfig& config) {
  if (!view.geometry || view.geometry->error_px > config.most_error_px) return false;
  if (view.agreeing() < std::max<double>(config.fewest_features, config.least_kept * looked_for)) return false;
  if (view.agreeing() < config.least_agreeing * view.tracked) return false;
  if (view.geometry->has_baseline && view.geometry->lead < config.bridging->least_lead) return false;
  return turn_between_rad(view.geometry->motion, match.estimate.motion) <= config.bridging->most_turn_off_rad;
}

int looked_for(const Subrange& from, const GuessPlace& guess, const camera::Camera& camera) {
  const camera::CameraConfig& config = camera.config();
  return static_cast<int>(std::ranges::count_if(from.features(), [&](const KeyFeature& feature) {
    const Eigen::Vector2d at_px = guess(feature.pixel_px, 1.0).pixel_px;
    return at_px.x() >= 0.0 && at_px.y() >= 0.0 && at_px.x() <= config.width_px - 1.0 &&
           at_px.y() <= config.height_px - 1.0;
  }));
}

std::optional<Bridge> bridge_to(const NumberedPicture& picture, const Subrange& from, const camera::Camera& camera,
                                const TeachConfig& config) {
  if (!config.bridging) return std::nullopt;
  const RecognitionConfig& matching = config.bridging->matching;
  const auto match =
      wide_match(describe(from.key().pyramid, camera, matching), describe(picture.pyramid, camera, matching), camera,
                 matching, config.geometry, config.seed + static_cast<std::uint64_t>(picture.number));
  if (!match) return std::nullopt;
  Bridge bridge{from, {}, match->agreeing(), match->compared, 0};
  bridge.from.add(match->first_px, config);
  const GuessPlace guess = guess_by(*match, camera);
  bridge.view = bridge.from.look_where(picture, config, guess);
  bridge.looked_for = looked_for(bridge.from, guess, camera);
  if (!holds(bridge.view, bridge.looked_for, *match, config)) return std::nullopt;
  return bridge;
}

}  // namespace homeward::repeat
