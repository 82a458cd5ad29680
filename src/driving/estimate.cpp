// SPDX-License-Identifier: Apache-2.0
#include "driving/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "driving/end_mission.hpp"
#include "driving/follow.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {
namespace {

constexpr Milliseconds kRateOver_ms = 1000;  // answers are counted over, for the rate of vectors

void give_up_displaced(DrivingState& state) {
  ++state.displaced;
  state.follow = {};
  state.kept.reset();
  state.seen = {};
  if (state.drive != wire::DriveState::kDriving) return;
  state.astray = true;
  end_mission(state, wire::DriveState::kFailed, wire::Reason{wire::ReasonCode::kLifted});
}

/// Arcs of ultrasound are no surfaces: they tell neither of a lift nor of what stands on a way.
void take_sweep(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  if (config.body.vague_ranges) return;
  // The sweeps tell of a lift between missions, too: the estimate is kept from one to the next.
  if (breaks_off(state.going_on, state.scan->scan, inputs.odometry, state.scan->taken_ms)) give_up_displaced(state);
  // What is near to where the robot has stopped says nothing new.
  if (state.drive != wire::DriveState::kDriving || !state.mission->homes()) return;
  see_ways(state.follow, state.mission->path, hit_points(state.scan->scan), inputs.odometry);
}

/// A picture of before the mission, or one that was looked at for so long, says nothing of whether more will come: the
/// robot goes on standing until a better one does.
bool comes_in_time(const DrivingState& state, const SeenPicture& picture, const DrivingConfig& config,
                   Milliseconds sensors_ms) {
  const Milliseconds age_ms = sensors_ms - picture.taken_ms;
  return state.pictured || (picture.taken_ms >= state.last_picture_ms && age_ms <= config.frame_silence_ms);
}

/// Whether way was gained: on the path, or by driving on.
void note_gain(DrivingState& state, const SeenPicture& picture, int furthest_before, const DrivingConfig& config,
               Milliseconds sensors_ms) {
  const bool gained = state.follow.furthest > furthest_before;
  const Pose2 moved = inverse(state.gain_from) * picture.odometry;
  if (!gained && !(std::hypot(moved.x_m, moved.y_m) > config.progress.gain_m)) return;
  state.last_gain_ms = sensors_ms;
  state.gain_from = picture.odometry;
}

bool shows_next_to_nothing(const features::Appearance& appearance, const DrivingConfig& config) {
  return static_cast<int>(appearance.size()) < config.covered_below_features;
}

void take_picture(DrivingState& state, const SeenPicture& picture, const DrivingConfig& config,
                  Milliseconds sensors_ms) {
  ++state.pictures;
  if (state.drive != wire::DriveState::kDriving || !comes_in_time(state, picture, config, sensors_ms)) return;
  // A clock that is ahead must not hide a camera that falls silent.
  state.last_picture_ms = std::min(picture.taken_ms, sensors_ms);
  // Looking at it for a moment is part of reacting; one that was looked at for long is as old as it is.
  state.picture_came_ms = std::min(sensors_ms, state.last_picture_ms + config.reaction_ms);
  const int furthest_before = state.follow.furthest;
  state.pictured = true;
  if (!state.mission->homes()) {
    if (picture.appearance) state.covered = shows_next_to_nothing(*picture.appearance, config);
    return;
  }
  state.seen = picture.appearance ? follow(state.follow, state.mission->path, *picture.appearance, picture.frame,
                                           picture.odometry, config.follow, state.pictures)
                                  : track(state.follow, state.mission->path, picture.frame, picture.odometry,
                                          config.follow, state.pictures);
  // What is of nowhere hides the view: that says nothing of where the robot is.
  if (picture.appearance && state.seen.recognised &&
      breaks_off(state.continuity, {picture.appearance, picture.odometry, picture.taken_ms}, state.pictures)) {
    return give_up_displaced(state);
  }
  if (state.seen.answered) {
    state.last_answer_ms = sensors_ms;
    state.answers_ms.push_back(sensors_ms);
  }
  if (picture.appearance) state.covered = shows_next_to_nothing(*picture.appearance, config);
  // A covered lens: memory must not carry the robot on.
  if (state.covered) state.seen = {};
  note_gain(state, picture, furthest_before, config, sensors_ms);
}

}  // namespace

void estimate(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms,
              Milliseconds sensors_ms) {
  if (inputs.scan) take_sweep(state, inputs, config);
  if (inputs.picture) take_picture(state, *inputs.picture, config, sensors_ms);
  if (state.drive == wire::DriveState::kDriving && state.mission->homes()) {
    state.kept = keep_estimate(state.follow, state.mission->path, state.mission->map, state.mission->revision, now_ms);
  }
  std::erase_if(state.answers_ms, [&](Milliseconds then_ms) { return sensors_ms - then_ms > kRateOver_ms; });
}

}  // namespace homeward::driving
