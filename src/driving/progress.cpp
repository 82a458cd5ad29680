// SPDX-License-Identifier: Apache-2.0
#include "driving/progress.hpp"

#include <cmath>

#include "driving/end_mission.hpp"
#include "driving/estimated_position.hpp"
#include "driving/follow.hpp"

namespace homeward::driving {
namespace {

using wire::ReasonCode;

/// No part of the way is to blame.
void end_astray(DrivingState& state, wire::Reason reason) {
  state.astray = true;
  end_mission(state, wire::DriveState::kFailed, std::move(reason));
}

/// The way is blocked. A tour drove it: who is elsewhere meets walls where the map has a way, and who is there seldom
/// does. Where that leaves it unsure where it is, or surer of another place, no part of the way is to blame.
void end_blocked(DrivingState& state, const DrivingConfig& config) {
  const VisualPath& path = state.mission->path;
  const auto before = estimated_place(state.follow, path, config.follow);
  const PoseHypothesis* best = state.follow.hypotheses.best();
  if ((before || state.follow.looked_around) && path.index && best != nullptr) {
    state.follow.hypotheses.weigh_within({best->map_from_robot.x_m, best->map_from_robot.y_m},
                                         config.progress.blocked_within_m, config.progress.blocked_odds);
  }
  if (!state.follow.looked_around && (!before || estimated_place(state.follow, path, config.follow) == before)) {
    return end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kWayBlocked});
  }
  if (state.kept) state.kept->hypotheses = state.follow.hypotheses;
  end_astray(state, {ReasonCode::kWayBlockedOrElsewhere});
}

/// Whether the destination is right here; nothing where that is not known well enough.
std::optional<bool> is_near(const DrivingState& state, const DrivingConfig& config) {
  if (!state.follow.view.known() || state.follow.index + 1 != state.mission->path.size()) return false;
  // From pictures before, where somebody stands before the camera.
  if (!state.follow.measured && state.follow.view.doubt_m() > config.progress.near_known_m) return std::nullopt;
  if (state.follow.most_alike < share_when_here(state.follow, state.mission->path, config.follow)) return false;
  const auto goal_m = goal(state.follow, state.follow.odometry, config.follow);
  // Measured a little farther off, it is still near.
  const double near_m = config.near_m + (state.near_since_ms ? config.progress.stays_near_m : 0.0);
  return goal_m && goal_m->norm() < near_m;
}

/// Whether a distance has been more than so much for so long.
bool lasts(std::optional<Milliseconds>& since_ms, const std::optional<double>& distance_m, double most_m,
           Milliseconds now_ms, Milliseconds most_ms) {
  if (!distance_m || *distance_m <= most_m) {
    since_ms.reset();
    return false;
  }
  since_ms = since_ms.value_or(now_ms);
  return now_ms - *since_ms > most_ms;
}

/// Whether it has been at one spot for too long. Standing before a wall, doubting where it is, driving on a little to
/// look, and knowing again: each of these gains way or is no way wanted, and all in turn may go on for ever.
bool stays_too_long(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const Pose2 moved = inverse(state.stays_at) * state.follow.odometry;
  if (!state.stays_since_ms || std::hypot(moved.x_m, moved.y_m) > config.stays_within_m) {
    state.stays_since_ms = now_ms;
    state.stays_at = state.follow.odometry;
  }
  return now_ms - *state.stays_since_ms > config.stays_ms;
}

/// What is said of the destination.
wire::Reason of_destination(ReasonCode code, const Mission& mission) {
  return {code, {{"destination", mission.label}}};
}

/// It asks people no longer; what it said of that is over as well.
void stop_asking(DrivingState& state) {
  if (!state.asking.since_ms) return;
  withdraw(state.asking);
  state.reason.reset();
}

/// Beside its destination and not certain of it, the robot asks people; whether it does, and so stands and waits. Their
/// answer has moved the estimate already (orders.cpp): what is left to say here is that it was not enough.
bool ask_people(DrivingState& state, bool certain, const DrivingConfig& config, Milliseconds now_ms) {
  if (!state.asking.since_ms) {
    if (certain || !state.near_since_ms || now_ms - *state.near_since_ms <= config.doubtful_ms) return false;
    ask(state.asking, now_ms);
    state.reason = of_destination(ReasonCode::kDestinationAsked, *state.mission);
  }
  // Whoever comes to answer may stand before the camera; and it makes no way because it does not want to.
  state.last_answer_ms = state.last_sure_ms = state.last_gain_ms = now_ms;
  state.stays_since_ms.reset();
  if (state.asking.answer && *state.asking.answer) {
    // Whoever says so may be getting out: nothing drives on from here by itself.
    end_mission(state, wire::DriveState::kStopped, of_destination(ReasonCode::kDestinationAffirmed, *state.mission));
  } else if (state.asking.answer) {
    // Where it takes itself to be there all the same, a person decides.
    state.astray =
        arrival_probability(state.follow, state.mission->path, config.follow) < config.progress.denied_astray_below;
    end_mission(state, wire::DriveState::kFailed, of_destination(ReasonCode::kDestinationDenied, *state.mission));
  } else if (now_ms - *state.asking.since_ms > config.asks_ms) {
    end_astray(state, of_destination(ReasonCode::kDestinationUnsure, *state.mission));
  }
  return true;
}

/// Whether the destination is right here, and since when. Somebody who stands before the camera for a moment does not
/// move the robot away.
void note_nearness(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const auto near = is_near(state, config);
  if (!near) return;
  if (*near) {
    state.near_since_ms = state.near_since_ms.value_or(now_ms);
    return;
  }
  state.near_since_ms.reset();
  if (!state.asking.answer) stop_asking(state);  // an answer is dealt with first
}

/// A heading is taken only where it stays certain that this is the destination.
void leave_dock_where_unsure(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  if (!state.docking || stays_certain_of_arrival(state.follow, state.mission->path, config.follow)) return;
  state.docking = false;
  state.last_answer_ms = state.last_sure_ms = state.last_gain_ms = now_ms;
}

/// Whether it is at its destination by now, and certain of that.
bool has_arrived(const DrivingState& state, bool certain, const DrivingConfig& config, Milliseconds now_ms) {
  const bool near_enough = certain && state.near_since_ms && now_ms - *state.near_since_ms > config.near_ms;
  const bool confirmed = certain && state.asking.since_ms;  // by an answer, or by what it has seen since it asks
  const bool denied = state.asking.answer == false;
  // What the latest picture said of its end may be older than what speaks against it.
  const bool at_end = state.seen.at_end && certain;
  return (at_end || near_enough || confirmed) && !denied;
}

/// Arrived: what is left is the heading, where the mission wants one.
void arrive(DrivingState& state, Milliseconds now_ms) {
  stop_asking(state);
  if (!state.mission->dock) return end_mission(state, wire::DriveState::kArrived, std::nullopt);
  state.docking = true;
  state.last_gain_ms = now_ms;
}

/// The place is reached; a heading that cannot be taken does not make it a failure.
void judge_docking(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  if (state.covered) {
    state.last_gain_ms = now_ms;  // it stands, and turns on when it sees again
    if (now_ms - state.last_answer_ms > config.blind_ms) end_astray(state, {ReasonCode::kPlaceNotSeen});
    return;
  }
  if (now_ms - state.last_gain_ms > config.progress.docking_ms) {
    end_mission(state, wire::DriveState::kArrived, wire::Reason{ReasonCode::kHeadingNotTaken});
  }
}

/// Ends a mission that does not know where it is, or is elsewhere than on its way; whether it does.
bool ends_where_lost(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const VisualPath& path = state.mission->path;
  const double probability = position_probability(state.follow, path);
  if (probability >= config.follow.drive_above) {
    state.last_sure_ms = now_ms;
    state.follow.looked_around = false;
  } else if (now_ms - state.last_sure_ms > config.looks_ms) {
    state.follow.looked_around = true;
  }
  // Looking around is no way gained, and not blocked either.
  if (probability < drives_above(state.follow, config.follow)) state.last_gain_ms = now_ms;
  if (now_ms - state.last_sure_ms > config.unsure_ms || state.looking.driven_m > config.look_around.most_m) {
    end_astray(state, {ReasonCode::kPlaceUnsure});
    return true;
  }
  if (lasts(state.off_path_since_ms, off_path_m(state.follow, path, config.follow), config.off_path_m, now_ms,
            config.off_path_ms)) {
    end_astray(state, {ReasonCode::kOffTheWay});
    return true;
  }
  if (lasts(state.off_belief_since_ms, off_belief_m(state.follow, path, config.follow), config.off_belief_m, now_ms,
            config.off_belief_ms)) {
    state.at_odds = true;
    state.kept.reset();
    end_astray(state, {ReasonCode::kPlaceDeniedByMap});
    return true;
  }
  return false;
}

/// Ends a mission that makes no way. Beside its destination it waits for `near_ms` and has then arrived.
void judge_way(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const bool obstacle_moves =
      state.moving_obstacle.seen_ms && now_ms - *state.moving_obstacle.seen_ms < config.stuck_ms;
  const Milliseconds patience_ms = obstacle_moves ? config.patience_ms : config.stuck_ms;
  if (!state.near_since_ms && now_ms - state.last_gain_ms > patience_ms) {
    if (is_unsure(state.follow)) {
      return end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kDestinationNotSeenClearly});
    }
    return end_blocked(state, config);
  }
  if (obstacle_moves) state.stays_since_ms.reset();  // it waits for them as long as its patience lasts
  if (stays_too_long(state, config, now_ms)) end_blocked(state, config);
}

}  // namespace

void judge_progress(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  note_nearness(state, config, now_ms);
  leave_dock_where_unsure(state, config, now_ms);
  const bool certain =
      is_certain_of_arrival(state.follow, state.mission->path, config.follow, state.asking.answer == true);
  if (!state.docking && has_arrived(state, certain, config, now_ms)) {
    arrive(state, now_ms);
    if (!state.docking) return;
  }
  if (state.docking) return judge_docking(state, config, now_ms);
  if (ask_people(state, certain, config, now_ms)) return;
  if (now_ms - state.last_answer_ms > config.blind_ms) {
    return end_mission(state, wire::DriveState::kFailed, wire::Reason{ReasonCode::kWayNotRecognised});
  }
  if (!ends_where_lost(state, config, now_ms)) judge_way(state, config, now_ms);
}

}  // namespace homeward::driving
