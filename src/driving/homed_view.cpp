// SPDX-License-Identifier: Apache-2.0
#include "driving/homed_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "driving/estimated_position.hpp"

namespace homeward::driving {

homing::VisualHoming new_homing(const FollowConfig& config) {
  homing::VisualHomingConfig visual = config.visual;
  visual.first = config.homing;
  visual.prior_odds = config.path_odds;
  visual.begin_confidence = config.believe;
  return homing::VisualHoming(visual);
}

homing::VisualHoming& homing_of(FollowState& state, const FollowConfig& config) {
  if (state.visual_index != state.index) {
    state.visual = new_homing(config);
    state.visual_index = state.index;
    state.contradictions = 0;
    state.bearings.clear();
    state.undecided = state.given_up = 0;
    state.most_alike = 0.0;
  }
  return state.visual;
}

bool is_sure(const homing::HomeVector& vector, const FollowConfig& config) {
  return vector.confidence >= config.sure && vector.inliers >= config.sure_inliers;
}

bool is_believed(const Result<homing::TargetSeen>& answer, const FollowConfig& config) {
  constexpr double kHere_m = 0.1;
  if (!answer) return false;
  if (answer->vector.confidence >= config.believe) return true;
  return answer->target_m && answer->target_m->norm() < kHere_m && answer->map_confidence >= config.believe;
}

bool take_in(FollowState& state, const Result<homing::TargetSeen>& answer, const FollowConfig& config,
             FollowResult& result) {
  state.measured = false;
  if (!is_believed(answer, config)) return false;
  if (answer->target_m) {
    state.measured = true;
    const Eigen::Matrix2d turned = Eigen::Rotation2Dd(state.odometry.theta_rad).toRotationMatrix();
    state.view.settle(Eigen::Vector2d(state.odometry.x_m, state.odometry.y_m) + turned * *answer->target_m,
                      turned * answer->covariance_m2 * turned.transpose(),
                      state.odometry.theta_rad + answer->vector.turn_rad);
  } else if (!state.view.observe(state.odometry, answer->vector, config.track)) {
    return false;
  }
  result.vector = answer->vector;
  result.tracks = answer->tracks;
  result.answered = true;
  state.blind_m = 0.0;
  return true;
}

std::optional<homing::DistancePrior> distance_known(const FollowState& state, bool mapped) {
  if (!state.view.known()) return std::nullopt;
  const Eigen::Vector2d here_m(state.odometry.x_m, state.odometry.y_m);
  const double distance_m = std::max(0.1, (state.view.position_m() - here_m).norm());
  return homing::DistancePrior{distance_m, std::clamp(state.view.doubt_m() / distance_m, 0.1, 0.8), mapped};
}

bool is_reached(FollowState& state, const VisualPath& path, const FollowConfig& config, const FollowResult& result) {
  if (!result.vector || !state.view.known()) return false;
  const Eigen::Vector2d here_m(state.odometry.x_m, state.odometry.y_m);
  const double distance_m = (state.view.position_m() - here_m).norm();
  // Bearings are sharp to within centimetres of a view: when it passes from ahead to behind, the robot is there.
  const bool behind = is_sure(*result.vector, config) && std::cos(result.vector->bearing_rad) < 0.0;
  state.behind = behind ? state.behind + 1 : 0;
  const bool coincides =
      result.vector->median_parallax_rad < config.homing.arrived_parallax_rad && state.alike > config.alike_share;
  if (state.most_alike < share_when_here(state, path, config)) return false;
  return state.measured ? distance_m < config.reached_m
                        : coincides || (state.behind >= 2 && distance_m < config.nearby_m);
}

}  // namespace homeward::driving
