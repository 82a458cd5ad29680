// SPDX-License-Identifier: Apache-2.0
#include "driving/repeat_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/angles.hpp"
#include "driving/approach.hpp"
#include "driving/end_mission.hpp"
#include "driving/pursuit.hpp"
#include "driving/steering.hpp"
#include "driving/way_following.hpp"

namespace homeward::driving {
namespace {

using wire::ReasonCode;

constexpr Milliseconds kSilent_ms = 1000;  // nothing held against the path for so long: it is not known where it is

/// The rest of the way, robot frame, from the nearest of it on.
struct Rest {
  std::vector<Pose2> way;
  std::size_t nearest = 0;
  double aside_m = 0.0;  // of the nearest
};

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

Rest rest_of(const PathSight& sight, const Pose2& odometry, const RepeatPathConfig& config) {
  constexpr double kFarthest_m = 1.0;  // along the way: what comes nearer again later is another round
  const Pose2 now_from_then = inverse(odometry) * sight.odometry;
  Rest rest;
  double length_m = 0.0;
  double least = 0.0;
  for (const Pose2& pose : sight.way) {
    rest.way.push_back(now_from_then * pose);
    const std::size_t number = rest.way.size() - 1;
    if (number > 0) length_m += apart_m(rest.way[number - 1], rest.way[number]);
    const Pose2& here = rest.way.back();
    const double away_m = std::hypot(here.x_m, here.y_m);
    const double off = std::hypot(away_m, config.metres_per_rad * wrap_angle(here.theta_rad));
    if (number > 0 && (off >= least || length_m > kFarthest_m)) continue;
    least = off;
    rest.nearest = number;
    rest.aside_m = away_m;
  }
  return rest;
}

/// Where the way turns on the spot: it does from one pose to another, by so much.
struct Corner {
  std::size_t begins = 0;
  double turn_rad = 0.0;  // left of it from the nearest pose on, where that is in it
};

std::optional<Corner> next_corner(const Rest& rest, const RepeatPathConfig& config) {
  constexpr double kStraight_rad = 0.05;
  for (std::size_t from = rest.nearest; from < rest.way.size(); ++from) {
    double length_m = 0.0;
    double turned_rad = 0.0;
    for (std::size_t to = from + 1; to < rest.way.size(); ++to) {
      length_m += apart_m(rest.way[to - 1], rest.way[to]);
      if (length_m > config.corner_m) break;
      turned_rad += wrap_angle(rest.way[to].theta_rad - rest.way[to - 1].theta_rad);
    }
    if (std::abs(turned_rad) <= config.corner_rad) continue;
    std::size_t begins = from;
    while (begins + 1 < rest.way.size() &&
           std::abs(wrap_angle(rest.way[begins + 1].theta_rad - rest.way[from].theta_rad)) < kStraight_rad)
      ++begins;
    return Corner{begins, turned_rad};
  }
  return std::nullopt;
}

/// A point of the way so far on, no farther than where it ends or turns on the spot.
struct Aim {
  Eigen::Vector2d point_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;  // of the way up to there, to whichever side
};

Aim aim_on(const Rest& rest, double look_m, std::size_t last) {
  Aim aim{position_m(rest.way[rest.nearest]), 0.0};
  double left_m = look_m;
  for (std::size_t i = rest.nearest; i < last && left_m > 0.0; ++i) {
    const Pose2& from = rest.way[i];
    const Pose2& to = rest.way[i + 1];
    const double step_m = apart_m(from, to);
    const double share = step_m > left_m ? left_m / step_m : 1.0;
    aim.point_m = position_m(from) + share * (position_m(to) - position_m(from));
    aim.turn_rad += share * std::abs(wrap_angle(to.theta_rad - from.theta_rad));
    left_m -= step_m;
  }
  return aim;
}

double length_m(const Rest& rest, std::size_t last) {
  double sum_m = rest.aside_m;
  for (std::size_t i = rest.nearest; i < last; ++i) sum_m += apart_m(rest.way[i], rest.way[i + 1]);
  return sum_m;
}

double most_speed_mps(const DrivingState& state, const RepeatPathConfig& config) {
  constexpr double kEnough = 0.5;
  const double sure = std::clamp(state.repeat.known->confidence / kEnough, 0.0, 1.0);
  const double speed_mps = config.unsure_mps + sure * (config.straight_mps - config.unsure_mps);
  return std::min(speed_mps, state.mission->speed_limit_mps);
}

/// Steers so that features move to where the next key image has them.
Motion by_features(DrivingState& state, const Situation& now) {
  constexpr double kMost_rad = 0.5;
  constexpr double kTurns_rad = 0.1;
  const RepeatPathConfig& config = now.config.repeat_path;
  const double steering_rad = std::clamp(state.repeat.known->steering_rad, -kMost_rad, kMost_rad);
  const double turn_mps = std::abs(steering_rad) > kTurns_rad ? config.turn_mps : config.straight_mps;
  const Eigen::Vector2d aim_m = config.look_m * Eigen::Vector2d(std::cos(steering_rad), std::sin(steering_rad));
  return drive_towards(state, aim_m, std::min(turn_mps, most_speed_mps(state, config)), now);
}

/// The heading at the end, by the last of the way.
Motion take_end_heading(DrivingState& state, const Rest& rest, const Situation& now) {
  const double left_rad = rest.way.empty() ? 0.0 : wrap_angle(rest.way.back().theta_rad);
  if (std::abs(left_rad) >= now.config.dock_within_rad) return turn_in_place(left_rad, now.config.approach);
  end_mission(state, wire::DriveState::kArrived, std::nullopt);
  return {};
}

Motion along_way(DrivingState& state, const Rest& rest, const Situation& now) {
  const RepeatPathConfig& config = now.config.repeat_path;
  const std::size_t end = rest.way.size() - 1;
  const auto corner = next_corner(rest, config);
  const std::size_t last = corner ? corner->begins : end;
  const double left_m = length_m(rest, last);
  if (corner && (rest.nearest == corner->begins || left_m < config.at_corner_m) &&
      position_m(rest.way[corner->begins]).norm() < config.look_m) {
    const double left_rad = wrap_angle(rest.way[corner->begins].theta_rad) + corner->turn_rad;
    if (std::abs(left_rad) > config.turned_rad) return turn_in_place(left_rad, now.config.approach);
  }
  const bool stops = state.repeat.known->ends && last == end;
  const Eigen::Vector2d end_m = position_m(rest.way.back());
  if (stops && end_m.norm() < now.config.approach.within_m && left_m < 2.0 * now.config.approach.within_m) {
    if (end_m.norm() > config.there_m) return approach(end_m, now.config.body, now.points_m, now.config.approach);
    state.repeat.at_end = true;
    return take_end_heading(state, rest, now);
  }
  double speed_mps = most_speed_mps(state, config);
  const Aim aim = aim_on(rest, config.look_m, last);
  const double bend_radpm = aim.turn_rad / std::max(config.look_m, 1e-9);
  speed_mps = std::min(speed_mps, std::max(config.turn_mps, config.bend_radps / std::max(bend_radpm, 1e-9)));
  if (stops || corner) speed_mps = std::min(speed_mps, std::max(config.least_mps, config.brakes_per_s * left_m));
  const DrivingConfig& driving = now.config;
  if (const auto freely = pursue(driving.body, now.points_m, aim.point_m, speed_mps, driving.pursuit)) return *freely;
  const std::span<const Pose2> onwards(rest.way.begin() + static_cast<std::ptrdiff_t>(rest.nearest),
                                       last + 1 - rest.nearest);
  if (const auto closely = follow_way(driving.body, now.points_m, onwards, speed_mps)) return *closely;
  return steer_round(state.plan, driving.body, now.points_m, aim.point_m, now.inputs.odometry, speed_mps,
                     driving.turn_gain, driving.steering);
}

bool reached_by_features(const DrivingState& state, const Rest& rest) {
  return state.repeat.known->ends && (rest.way.empty() || rest.nearest + 1 == rest.way.size());
}

bool is_finite(const PathSight& sight) {
  const Pose2& at = sight.odometry;
  return std::isfinite(sight.steering_rad + sight.confidence + at.x_m + at.y_m + at.theta_rad) &&
         std::ranges::all_of(sight.way, [](const Pose2& pose) {
           return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
         });
}

void take_sight(DrivingState& state, const PathSight& sight, Milliseconds sensors_ms) {
  RepeatState& repeat = state.repeat;
  if (!repeat.heard_ms) repeat.begun_ms = sensors_ms;  // the path is there from now on
  repeat.heard_ms = sensors_ms;
  if (sight.lost || !is_finite(sight) || sensors_ms - sight.taken_ms > kSilent_ms) return;
  if (repeat.odometry_from_ms && sight.taken_ms < *repeat.odometry_from_ms) return;
  repeat.known = sight;
  repeat.known_ms = sensors_ms;
  if (says(state.reason, ReasonCode::kPathPlaceUnknown) || says(state.reason, ReasonCode::kPathLoads))
    state.reason.reset();
}

/// Whether the mission ends because nothing says where on the path it is.
bool ends_where_lost(DrivingState& state, const RepeatPathConfig& config, Milliseconds sensors_ms) {
  const RepeatState& repeat = state.repeat;
  if (!repeat.heard_ms) {
    state.reason = wire::Reason{ReasonCode::kPathLoads};
    if (sensors_ms - repeat.begun_ms <= config.loads_ms) return false;
    end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kPathPlaceUnknown});
    return true;
  }
  const bool lost = repeat.known_ms != repeat.heard_ms || sensors_ms - *repeat.heard_ms > kSilent_ms;
  if (lost) state.reason = wire::Reason{ReasonCode::kPathPlaceUnknown};
  if (!lost || sensors_ms - repeat.known_ms.value_or(repeat.begun_ms) <= config.lost_ms) return false;
  state.astray = true;
  end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kPathPlaceUnknown});
  return true;
}

/// Whether it knows where it is by its latest pictures, or was sure of it a moment and a little way back.
bool knows(const DrivingState& state, const Inputs& inputs, const RepeatPathConfig& config, Milliseconds sensors_ms) {
  const RepeatState& repeat = state.repeat;
  return repeat.known && sensors_ms - *repeat.known_ms <= kSilent_ms &&
         apart_m(repeat.known->odometry, inputs.odometry) <= config.blind_m;
}

/// Odometry that has begun anew since the last step says nothing of where it was before.
void notice_jump(RepeatState& repeat, const Pose2& odometry, Milliseconds sensors_ms) {
  constexpr double kMost_m = 0.5;  // in one step
  constexpr double kMost_rad = 0.5;
  const Pose2 moved = inverse(repeat.odometry) * odometry;
  repeat.odometry = odometry;
  if (std::hypot(moved.x_m, moved.y_m) < kMost_m && std::abs(moved.theta_rad) < kMost_rad) return;
  repeat.known.reset();
  repeat.known_ms.reset();
  repeat.begun_ms = sensors_ms;
  repeat.odometry_from_ms = sensors_ms;
}

/// Where it does not know where it is, it stands, and that is no way that is blocked.
void note_way(RepeatState& repeat, const Pose2& odometry, bool knows, const RepeatPathConfig& config,
              Milliseconds sensors_ms) {
  const Pose2 moved = inverse(repeat.got_on_at) * odometry;
  if (!knows || std::hypot(moved.x_m, moved.y_m) > config.gets_on_m || std::abs(moved.theta_rad) > config.gets_on_rad) {
    repeat.got_on_at = odometry;
    repeat.got_on_ms = sensors_ms;
  }
  if (!knows || apart_m(repeat.spot, odometry) > config.spot_m) {
    repeat.spot = odometry;
    repeat.at_spot_since_ms = sensors_ms;
  }
}

bool does_not_get_on(const DrivingState& state, const DrivingConfig& config, Milliseconds sensors_ms) {
  const RepeatState& repeat = state.repeat;
  const bool obstacle_moves =
      state.moving_obstacle.seen_ms && sensors_ms - *state.moving_obstacle.seen_ms < config.stuck_ms;
  if (obstacle_moves) return sensors_ms - repeat.got_on_ms > config.patience_ms;
  return sensors_ms - repeat.got_on_ms > config.stuck_ms ||
         sensors_ms - repeat.at_spot_since_ms > config.repeat_path.at_spot_ms;
}

}  // namespace

void begin_repeat(RepeatState& repeat, const Pose2& odometry, Milliseconds sensors_ms) {
  repeat = {};
  repeat.begun_ms = repeat.got_on_ms = repeat.at_spot_since_ms = sensors_ms;
  repeat.got_on_at = repeat.spot = repeat.odometry = odometry;
}

void judge_repeat(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms) {
  RepeatState& repeat = state.repeat;
  if (inputs.why_not_repeating) {
    return end_mission(state, wire::DriveState::kFailed,
                       reason_with(ReasonCode::kPathUnusable, "because", *inputs.why_not_repeating));
  }
  notice_jump(repeat, inputs.odometry, sensors_ms);
  if (inputs.path_sight) take_sight(state, *inputs.path_sight, sensors_ms);
  if (ends_where_lost(state, config.repeat_path, sensors_ms)) return;
  note_way(repeat, inputs.odometry, knows(state, inputs, config.repeat_path, sensors_ms), config.repeat_path,
           sensors_ms);
  if (!repeat.known) return;
  if (repeat.known->leads_elsewhere) {
    return end_mission(state, wire::DriveState::kFailed,
                       wire::Reason{ReasonCode::kPathLeadsElsewhere, {{"destination", state.mission->label}}});
  }
  const Rest rest = rest_of(*repeat.known, inputs.odometry, config.repeat_path);
  if (!rest.way.empty() && rest.aside_m > config.repeat_path.aside_m) {
    state.astray = true;
    return end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kOffTheWay});
  }
  const bool is_near = repeat.known->ends && !rest.way.empty() && position_m(rest.way.back()).norm() < config.near_m;
  if (is_near && sensors_ms - repeat.got_on_ms > config.near_ms) {
    // What stands in the way there may stay there.
    return end_mission(state, wire::DriveState::kArrived, wire::Reason{ReasonCode::kHeadingNotTaken});
  }
  if (does_not_get_on(state, config, sensors_ms))
    end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kWayBlocked});
}

Motion repeat_motion(DrivingState& state, const Situation& now) {
  const RepeatPathConfig& config = now.config.repeat_path;
  if (!state.pictured || !knows(state, now.inputs, config, now.sensors_ms)) return {};
  const Rest rest = rest_of(*state.repeat.known, now.inputs.odometry, config);
  const bool is_there =
      state.repeat.known->ends && !rest.way.empty() && position_m(rest.way.back()).norm() < now.config.near_m;
  state.repeat.at_end = state.repeat.at_end && is_there;
  if (state.repeat.at_end) return take_end_heading(state, rest, now);
  if (!rest.way.empty() && !config.steers_by_features) return along_way(state, rest, now);
  if (!reached_by_features(state, rest)) return by_features(state, now);
  end_mission(state, wire::DriveState::kArrived, std::nullopt);
  return {};
}

}  // namespace homeward::driving
