// SPDX-License-Identifier: Apache-2.0
#include "driving/step.hpp"

#include <algorithm>
#include <cmath>

#include "driving/end_mission.hpp"
#include "driving/estimated_position.hpp"
#include "driving/follow.hpp"
#include "driving/orders.hpp"
#include "driving/progress.hpp"
#include "driving/pursuit.hpp"
#include "driving/rider.hpp"
#include "driving/steering.hpp"

namespace homeward::driving {
namespace {

constexpr const char* kDisplaced = "All at once I see something else: was I lifted? I look where I am.";
constexpr int kFewestFeatures = 20;  // with fewer the camera is taken to be covered

void give_up_displaced(DrivingState& state) {
  ++state.displaced;
  state.follow = {};
  state.kept.reset();
  state.seen = {};
  if (state.drive != wire::DriveState::kDriving) return;
  state.astray = true;
  end_mission(state, wire::DriveState::kFailed, kDisplaced);
}

void take_picture(DrivingState& state, const SeenPicture& picture, const DrivingConfig& config, Milliseconds now_ms) {
  ++state.pictures;
  if (state.drive != wire::DriveState::kDriving) return;
  // A picture of before the mission, or one that was looked at for so long, says nothing of whether more will come: the
  // robot goes on standing until a better one does.
  const Milliseconds age_ms = now_ms - picture.taken_ms;
  if (!state.pictured && (picture.taken_ms < state.last_picture_ms || age_ms > config.frame_silence_ms)) return;
  // A clock that is ahead must not hide a camera that falls silent.
  state.last_picture_ms = std::min(picture.taken_ms, now_ms);
  // Looking at it for a moment is part of reacting; one that was looked at for long is as old as it is.
  state.picture_came_ms = std::min(now_ms, state.last_picture_ms + config.reaction_ms);
  const int furthest_before = state.follow.furthest;
  state.pictured = true;
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
    state.last_answer_ms = now_ms;
    state.answers_ms.push_back(now_ms);
  }
  if (picture.appearance) state.covered = picture.appearance->size() < kFewestFeatures;
  // A covered lens: memory must not carry the robot on.
  if (state.covered) state.seen = {};
  const bool gained = state.follow.furthest > furthest_before;
  const Pose2 moved = inverse(state.gain_from) * picture.odometry;
  if (gained || std::hypot(moved.x_m, moved.y_m) > 0.25) {
    state.last_gain_ms = now_ms;
    state.gain_from = picture.odometry;
  }
}

/// Why the robot must not drive any more, or nothing.
std::optional<std::string> reason_to_stop(const DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
                                          Milliseconds now_ms, Milliseconds sensors_ms) {
  if (!inputs.link_up) return "The connection to the house is lost.";
  if (now_ms - state.last_message_ms > config.link_silence_ms) return "The house has fallen silent.";
  if (now_ms > state.permit_ends_ms) return "The permit to drive has run out.";
  const Milliseconds patience_ms = state.pictured ? config.frame_silence_ms : config.first_frame_ms;
  if (sensors_ms - state.last_picture_ms > patience_ms) return "The camera gives no pictures.";
  if (!state.scan || sensors_ms - state.scan->taken_ms > config.scan_silence_ms)
    return "The range sensor gives no readings.";
  return std::nullopt;
}

/// No faster than what still comes to rest in time should the silence that has begun go on.
Motion slowed_by_silence(const Motion& wanted, const DrivingState& state, const DrivingConfig& config,
                         Milliseconds now_ms, Milliseconds sensors_ms) {
  const Milliseconds silence_ms =
      std::max({now_ms - state.last_message_ms, sensors_ms - state.picture_came_ms, sensors_ms - state.scan->taken_ms});
  const Milliseconds braking_ms = config.stands_within_ms - config.reaction_ms - silence_ms;
  const double braking_s = 0.001 * static_cast<double>(std::max<Milliseconds>(0, braking_ms));
  const double speed_mps = config.body.deceleration_mps2 * braking_s;
  const double turn_radps = config.body.turn_deceleration_radps2 * braking_s;
  return {std::clamp(wanted.speed_mps, -speed_mps, speed_mps), std::clamp(wanted.turn_radps, -turn_radps, turn_radps)};
}

constexpr double kFinal_m = 0.35;  // so near, the destination is driven to straight, backwards where it lies behind

constexpr double kShortcut_mps = 0.25;  // where no tour drove

constexpr double kBack_mps = 0.25;  // when it makes room for somebody

/// Whether a little more straight ahead, or back, leaves the body more room than it needs to pass a door: the last
/// centimetres to a destination are not worth going as near to things as that.
bool leaves_room(const Body& body, const std::vector<Eigen::Vector2d>& points_m, double speed_mps) {
  constexpr double kRoom_m = 0.08;
  constexpr double kAhead_m = 0.05;
  std::vector<Eigen::Vector2d> then_m = points_m;
  for (Eigen::Vector2d& point : then_m) point.x() -= std::copysign(kAhead_m, speed_mps);
  const double room_m = clearance_m(body, then_m);
  return room_m >= kRoom_m || room_m >= clearance_m(body, points_m);
}

/// The last bit of the way: turning towards the destination, or away from it where it lies behind, then straight.
Motion approach(const Eigen::Vector2d& goal_m, const Body& body, const std::vector<Eigen::Vector2d>& points_m) {
  constexpr double kSlowest_mps = 0.05;
  constexpr double kGain_per_s = 0.7;
  constexpr double kAhead_rad = 0.25;  // driven only with the destination that much ahead or behind
  const double ahead_rad = std::atan2(goal_m.y(), goal_m.x());
  const bool behind = std::abs(ahead_rad) > 0.5 * kPi;
  const double off_rad = behind ? wrap_angle(ahead_rad + kPi) : ahead_rad;
  Motion motion;
  motion.turn_radps = std::clamp(1.5 * off_rad, -0.6, 0.6);
  motion.turn_radps = std::clamp(motion.turn_radps, -body.max_turn_radps, body.max_turn_radps);
  if (std::abs(off_rad) < kAhead_rad) {
    const double speed_mps = std::max(kSlowest_mps, kGain_per_s * goal_m.norm());
    motion.speed_mps = behind ? -std::min(speed_mps, 0.1) : std::min(speed_mps, 0.2);
  }
  if (!leaves_room(body, points_m, motion.speed_mps)) motion.speed_mps = 0.0;
  return motion;
}

constexpr const char* kLooksAround = "I am not sure where I am; I drive on a little and look.";
constexpr const char* kGoesOn = "I am not sure where I am; I go on as if I were where I most probably am, and look.";
constexpr double kUnsure_mps = 0.25;  // where it does not know where it is

/// Where the robot does not know where it is, it drives on a little and looks; but not before it has seen something.
Motion look(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
            const std::vector<Eigen::Vector2d>& points_m) {
  forget_standing(state.give_way);
  if (state.follow.hypotheses.empty()) return {};
  state.reason = kLooksAround;
  const auto aim_m = look_around(state.looking, config.body, points_m, inputs.odometry);
  if (!aim_m) return {};
  if (const auto straight = pursue(config.body, points_m, *aim_m, kUnsure_mps)) return *straight;
  return steer_round(state.plan, config.body, points_m, *aim_m, inputs.odometry, kUnsure_mps, config.turn_gain);
}

/// Whether it is on a way that no tour drove: also on the last bit of one whose end counts as passed already.
bool on_shortcut(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.on_shortcut(state.index)) return true;
  const PoseHypothesis* best = state.hypotheses.best();
  if (!path.on_shortcut(state.index - 1) || best == nullptr) return false;
  // Its end still lies ahead.
  const Pose2 end = path.pose(state.index - 1);
  const Pose2 begin = path.pose(state.index - 2);
  const Eigen::Vector2d way_m(end.x_m - begin.x_m, end.y_m - begin.y_m);
  const Eigen::Vector2d left_m(end.x_m - best->map_from_robot.x_m, end.y_m - best->map_from_robot.y_m);
  return left_m.norm() < config.abreast_m && left_m.dot(way_m) > 0.0;
}

/// How fast it may drive at most here: a way that no tour drove, slowly.
double speed_limit_mps(const DrivingState& state, const DrivingConfig& config) {
  const double limit_mps = std::min(state.mission->speed_limit_mps, config.body.max_speed_mps);
  const bool slowly = on_shortcut(state.follow, state.mission->path, config.follow);
  return slowly ? std::min(limit_mps, kShortcut_mps) : limit_mps;
}

Motion drive(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
             const std::vector<Eigen::Vector2d>& points_m, Milliseconds now_ms) {
  const bool last_view = state.follow.index + 1 == static_cast<int>(state.mission->path.views.size());
  if (state.docking) {
    if (state.covered) return {};
    // Heading at the end, by the latest answer and the turn made since.
    const double left_rad = wrap_angle(state.follow.view.heading_rad() - inputs.odometry.theta_rad);
    if (std::abs(left_rad) < config.dock_within_rad) {
      end_mission(state, wire::DriveState::kArrived, "");
      return {};
    }
    const double turn = std::clamp(1.5 * left_rad, -0.6, 0.6);
    return {0.0, std::copysign(std::max(0.12, std::abs(turn)), left_rad)};
  }
  if (state.asking.since_ms) {
    forget_standing(state.give_way);
    return {};
  }
  const auto goal_m = goal(state.follow, inputs.odometry, config.follow);
  const double probability = position_probability(state.follow, state.mission->path);
  if (probability < drives_above(state.follow, config.follow) && !state.covered) {
    return look(state, inputs, config, points_m);
  }
  state.looking = {};
  if (state.reason == kLooksAround || state.reason == kGoesOn) state.reason.clear();
  if (state.follow.looked_around) state.reason = kGoesOn;
  if (!goal_m || state.covered) {
    forget_standing(state.give_way);
    return {};
  }
  // A long body may well turn to and fro for a while where it gets through in the end.
  const Milliseconds patience_ms = is_round(config.body.outline) ? 6000 : 12'000;
  if (state.near_since_ms) {
    forget_standing(state.give_way);
  } else if (const auto back_m = give_way(state.give_way, config.body, {points_m, state.moving_obstacle.seen_ms},
                                          inputs.odometry, now_ms, patience_ms)) {
    // Whoever it makes room for stands before what it would recognise, and back it goes where it came along.
    state.last_answer_ms = now_ms;
    state.follow.blind_m = 0.0;
    if (back_m->isZero()) return {};
    return steer_round(state.plan, config.body, points_m, *back_m, inputs.odometry, kBack_mps, config.turn_gain);
  }
  double speed_mps = speed_limit_mps(state, config);
  Eigen::Vector2d aim_m = *goal_m;
  if (last_view) {
    // The destination is approached so slowly that one picture's way is a fraction of the tolerance. How near it is, is
    // known roughly; its direction is known well, so that is driven until it lies abeam.
    if (state.follow.measured && goal_m->norm() < kFinal_m) return approach(*goal_m, config.body, points_m);
    const bool alike = state.follow.alike > 0.25;
    speed_mps = std::min(speed_mps, std::max(alike ? 0.12 : 0.18, 0.6 * goal_m->norm()));
    constexpr double kLeastAim_m = 0.4;
    if (!state.follow.measured && state.seen.vector && goal_m->norm() < kLeastAim_m) {
      const double bearing_rad = state.seen.vector->bearing_rad;
      aim_m = kLeastAim_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    }
  }
  // The less is recognised, the slower.
  if (!state.seen.answered || state.follow.looked_around) speed_mps = std::min(speed_mps, kUnsure_mps);
  const double doubt_m = state.follow.view.doubt_m();
  speed_mps *= std::clamp(1.2 - 0.4 * doubt_m, 0.4, 1.0);
  if (const auto straight = pursue(config.body, points_m, aim_m, speed_mps)) return *straight;
  return steer_round(state.plan, config.body, points_m, aim_m, inputs.odometry, speed_mps, config.turn_gain);
}

/// A loop that was held up stops, and what was ordered meanwhile is refused: who ordered it no longer expects it.
void notice_gap(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const Milliseconds gap_ms = now_ms - state.last_step_ms.value_or(now_ms);
  state.last_step_ms = now_ms;
  if (gap_ms > config.held_up_ms) state.refuses_until_ms = now_ms + config.held_up_ms;
  if (gap_ms > config.loop_silence_ms && state.drive == wire::DriveState::kDriving) {
    end_mission(state, wire::DriveState::kStopped, "The robot's computer was held up.");
  }
}

/// Only a body that is not round goes so near to things that the noise of single sweeps matters; arcs of ultrasound are
/// no surfaces that several sweeps could agree on.
bool steadies(const Body& body) { return !is_round(body.outline) && !body.vague_ranges; }

/// The sweeps tell of a lift between missions, too: the estimate is kept from one to the next.
void notice_lift(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  if (config.body.vague_ranges) return;
  if (breaks_off(state.going_on, state.scan->scan, inputs.odometry, state.scan->taken_ms)) give_up_displaced(state);
}

/// Between two missions a robot hardly moves: odometry that says otherwise has begun anew.
void forget_where_odometry_jumped(DrivingState& state, const Pose2& odometry) {
  constexpr double kFarthest_m = 1.0;
  const Pose2 moved = inverse(state.follow.odometry) * odometry;
  if (state.follow.begun && std::hypot(moved.x_m, moved.y_m) > kFarthest_m) state.follow = {};
}

/// Arcs of ultrasound are no surfaces, and what is near to where the robot has stopped says nothing new.
void see_ways(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  if (config.body.vague_ranges || state.drive != wire::DriveState::kDriving) return;
  see_ways(state.follow, state.mission->path, hit_points(state.scan->scan), inputs.odometry);
}

void steady(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  if (state.scan && steadies(config.body))
    state.sweeps.observe(state.scan->scan, inputs.odometry, state.scan->taken_ms);
}

}  // namespace

Outputs step(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms) {
  Outputs outputs;
  const Milliseconds sensors_ms = inputs.sensors_now_ms.value_or(now_ms);
  const std::shared_ptr<const Mission> before = state.mission;
  notice_gap(state, config, now_ms);
  const bool rider = rider_steers(inputs, config, sensors_ms);
  // Also where the server may be about to send it on after a drive that failed: a hand on the joystick ends that.
  const bool may_go_on = state.drive == wire::DriveState::kDriving || state.drive == wire::DriveState::kFailed;
  if (rider && may_go_on) end_mission(state, wire::DriveState::kStopped, kRiderTookOver);
  obey(state, inputs.messages, rider, config, now_ms, outputs);
  if (now_ms - state.belief_ms > config.belief_silence_ms) {
    state.follow.belief.reset();
    state.follow.belief_lost = false;
  }
  if (state.mission != before) {
    state.last_answer_ms = state.last_sure_ms = state.last_gain_ms = state.last_picture_ms = sensors_ms;
    state.gain_from = inputs.odometry;
    state.stays_since_ms.reset();
    state.plan = {};
    state.turning = {};
    state.sweeps = {};
    steady(state, inputs, config);
    begin_way(state.give_way);
    forget_where_odometry_jumped(state, inputs.odometry);
  }
  state.turning.observe(inputs.odometry.theta_rad, sensors_ms);
  remember_trail(state.give_way, inputs.odometry);
  if (inputs.scan) {
    state.scan = inputs.scan;
    state.scan->taken_ms = std::min(state.scan->taken_ms, sensors_ms);
    // The arcs of ultrasound come and go by themselves.
    if (!config.body.vague_ranges) watch(state.moving_obstacle, state.scan->scan, inputs.odometry, sensors_ms);
    steady(state, inputs, config);
    notice_lift(state, inputs, config);
    see_ways(state, inputs, config);
  }
  std::vector<Eigen::Vector2d> points_m;
  if (state.scan) points_m = steadies(config.body) ? state.sweeps.points_m() : hit_points(state.scan->scan);
  state.min_range_m.reset();
  for (const Eigen::Vector2d& point : points_m) {
    state.min_range_m = std::min(state.min_range_m.value_or(1e9), point.norm());
  }
  if (inputs.picture) take_picture(state, *inputs.picture, config, sensors_ms);
  if (state.drive == wire::DriveState::kDriving) {
    state.kept = keep_estimate(state.follow, state.mission->path, state.mission->map, state.mission->revision, now_ms);
  }
  std::erase_if(state.answers_ms, [&](Milliseconds then) { return sensors_ms - then > 1000; });
  if (rider)
    outputs.motion = rider_motion(*inputs.rider, state.scan, points_m, state.turning.radps(), config, sensors_ms);
  if (state.drive != wire::DriveState::kDriving) return outputs;
  if (auto reason = reason_to_stop(state, inputs, config, now_ms, sensors_ms)) {
    end_mission(state, wire::DriveState::kStopped, std::move(*reason));
    return outputs;
  }
  judge_progress(state, config, sensors_ms);
  if (state.drive != wire::DriveState::kDriving) return outputs;
  Motion wanted = drive(state, inputs, config, points_m, sensors_ms);
  if (state.drive != wire::DriveState::kDriving) return outputs;
  // The last decimetres and backing off have speeds of their own, which the limit holds for as well.
  const double limit_mps = speed_limit_mps(state, config);
  wanted.speed_mps = std::clamp(wanted.speed_mps, -limit_mps, limit_mps);
  Motion heard = slowed_by_silence(wanted, state, config, now_ms, sensors_ms);
  // What no sensor looks at may be anything.
  const bool forward_only = !looks_behind(state.scan->scan);
  if (forward_only) heard.speed_mps = std::max(0.0, heard.speed_mps);
  const Motion safe = made_safe(heard, config.body, points_m, state.turning.radps());
  if (!forward_only || safe.speed_mps >= 0.0) outputs.motion = safe;
  return outputs;
}

}  // namespace homeward::driving
