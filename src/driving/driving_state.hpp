// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "driving/asking.hpp"
#include "driving/continuity.hpp"
#include "driving/follow_state.hpp"
#include "driving/give_way.hpp"
#include "driving/inputs.hpp"
#include "driving/kept_estimate.hpp"
#include "driving/leg_state.hpp"
#include "driving/long_plan.hpp"
#include "driving/look_around.hpp"
#include "driving/milliseconds.hpp"
#include "driving/mission.hpp"
#include "driving/moving_obstacle.hpp"
#include "driving/repeat_state.hpp"
#include "driving/steady_sweep.hpp"
#include "driving/sweep_continuity.hpp"
#include "driving/turn_rate.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// Everything that `step` remembers between two steps. Copies are cheap: views are shared.
struct DrivingState {
  wire::DriveState drive = wire::DriveState::kIdle;
  std::optional<wire::Reason> reason;  // why it stopped or failed, or drives otherwise than it was sent
  wire::Order newest;                  // the newest order obeyed
  std::int64_t least_epoch = 0;
  std::shared_ptr<const Mission> mission;
  Milliseconds permit_ends_ms = 0;
  FollowState follow;
  FollowResult seen;      // of the latest picture
  bool pictured = false;  // a picture taken since the mission began has come in time
  bool docking = false;
  LongPlan plan;       // of a body that is not round
  TurnRate turning;    // of the body, as it moves now
  LookAround looking;  // for where it is
  LegState leg;        // of an exploration
  RepeatState repeat;  // of a path that was taught
  Asking asking;       // people, whether this is the destination
  std::optional<Milliseconds> off_path_since_ms;
  std::optional<Milliseconds> off_belief_since_ms;
  bool astray = false;               // it has ended because the robot was elsewhere than on its way
  bool at_odds = false;              // the mission has ended because belief and estimate named two places
  std::optional<KeptEstimate> kept;  // of where it is, for the next mission
  GiveWay give_way;                  // to whoever stands in the way
  MovingObstacle moving_obstacle;    // of whoever that is
  SteadySweep sweeps;                // round a body that is not round
  Continuity continuity;             // of the pictures that are recognised
  SweepContinuity going_on;          // of the sweeps
  int displaced = 0;                 // how often it noticed that it was moved without its wheels
  bool covered = false;              // the latest picture shows next to nothing
  std::optional<Milliseconds> last_step_ms;
  Milliseconds refuses_until_ms = 0;  // missions that waited while no step was made
  Milliseconds last_message_ms = 0;
  Milliseconds belief_ms = 0;          // when the server sent its belief last,
  Milliseconds belief_changes_ms = 0;  // and, lost or not, the same as follow.belief_lost last
  Milliseconds last_picture_ms = 0;    // at first, when the mission began
  Milliseconds picture_came_ms = 0;    // the latest one that counted, less what it was looked at for too long
  Milliseconds last_answer_ms = 0;
  Milliseconds last_sure_ms = 0;              // when it knew last where it was
  std::optional<Milliseconds> near_since_ms;  // how long it has been right beside the destination
  Milliseconds last_gain_ms = 0;              // when way was last gained
  Pose2 gain_from;
  std::optional<Milliseconds> stays_since_ms;  // when it came to the spot where it is,
  Pose2 stays_at;                              // and that, by odometry
  std::optional<SeenScan> scan;
  std::optional<double> min_range_m;
  std::uint64_t pictures = 0;
  std::vector<Milliseconds> answers_ms;  // of the last second, for the rate of vectors
};

}  // namespace homeward::driving
