// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/pose2.hpp"
#include "driving/asking.hpp"
#include "driving/body.hpp"
#include "driving/continuity.hpp"
#include "driving/follow.hpp"
#include "driving/give_way.hpp"
#include "driving/kept_estimate.hpp"
#include "driving/long_plan.hpp"
#include "driving/look_around.hpp"
#include "driving/scan.hpp"
#include "driving/steady_sweep.hpp"
#include "driving/stirring.hpp"
#include "driving/sweep_continuity.hpp"
#include "driving/turn_rate.hpp"
#include "features/appearance.hpp"
#include "tracking/tracking_frame.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// Milliseconds of a clock that never jumps; only differences mean something.
using Milliseconds = std::int64_t;

struct DrivingConfig {
  Body body;
  FollowConfig follow;
  std::string feature_config_id;            // of this robot's eye: missions made with another are refused
  Milliseconds link_silence_ms = 400;       // no message for so long while driving: stop
  Milliseconds frame_silence_ms = 1000;     // no picture for so long while driving: stop
  Milliseconds first_frame_ms = 4000;       // a mission waits so long, standing, for its first picture
  Milliseconds scan_silence_ms = 400;       // no sweep for so long while driving: stop
  Milliseconds rider_silence_ms = 300;      // a joystick that says nothing for so long counts as released
  Milliseconds loop_silence_ms = 400;       // no step for so long while driving: stop
  Milliseconds held_up_ms = 1000;           // no step for so long: missions that waited meanwhile are refused
  Milliseconds stands_within_ms = 500;      // after the last message, picture or sweep it is at rest by itself
  Milliseconds reaction_ms = 120;           // of it, from an arrival to the wheels
  Milliseconds blind_ms = 8000;             // nothing recognised for so long: the mission fails
  Milliseconds looks_ms = 15'000;           // so long it looks around where it does not know where it is,
  Milliseconds unsure_ms = 60'000;          // and after so long it gives up, whatever it has tried
  Milliseconds off_path_ms = 1000;          // so long beside its path, by the estimate, and it needs another
  double off_path_m = 3.0;                  // by more than that
  Milliseconds off_belief_ms = 3000;        // so long the server's belief may name another place
  double off_belief_m = 2.0;                // farther off than that
  Milliseconds estimate_lives_ms = 10'000;  // an estimate is kept for a mission that comes so soon after the last one
  Milliseconds belief_silence_ms = 2000;    // a belief as old as that says nothing any more
  Milliseconds doubtful_ms = 12'000;        // so long it tries to make sure that it is at the destination,
  Milliseconds asks_ms = 60'000;            // and so long it then stands there and asks people
  Milliseconds stuck_ms = 20'000;           // no way gained for so long: the mission fails,
  Milliseconds patience_ms = 90'000;        // after so long where somebody stirs about the robot
  Milliseconds stays_ms = 60'000;           // so long at one spot the way is blocked, whatever the robot does there:
  double stays_within_m = 1.5;              // no farther than that from where it came to it
  double near_m = 0.25;                     // of the destination: what is in the way there may stay in the way
  Milliseconds near_ms = 8000;              // so long it tries to come nearer than that
  double turn_gain = 1.8;                   // turn rate for each radian towards the carrot
  double dock_within_rad = 0.02;            // heading at the end
};

/// What is new since the last step. Pictures and sweeps carry the time at which they were taken, by the sensors' clock:
/// the machine's own on a robot, simulated time in a simulator.
struct SeenPicture {
  Milliseconds taken_ms = 0;
  std::shared_ptr<const features::Appearance> appearance;  // null: only tracked, not recognised
  tracking::TrackingFrame frame;
  Pose2 odometry;  // when it was taken
};
struct SeenScan {
  Milliseconds taken_ms = 0;
  Scan scan;
};
/// What the rider's own joystick says. A deflected one may want no motion of the agent: the base obeys it by itself, or
/// it has not been at rest yet.
struct RiderHand {
  Milliseconds said_ms = 0;  // by the sensors' clock
  bool deflected = false;
  Motion wanted;
};
struct Inputs {
  std::optional<SeenPicture> picture;
  std::optional<SeenScan> scan;
  Pose2 odometry;
  std::vector<wire::ServerMessage> messages;  // in the order of their arrival
  bool link_up = false;
  std::optional<Milliseconds> sensors_now_ms;  // by the sensors' clock; nothing: it is the machine's own
  std::optional<RiderHand> rider;              // the newest word of the joystick, when there is one
};

/// One mission that was permitted.
struct Mission {
  MissionId id;
  MapId map;
  std::int64_t revision = 0;
  std::string label;
  VisualPath path;
  bool dock = false;
  double speed_limit_mps = 0.0;
};

/// Everything that the heart of the agent remembers between two steps. Copies are cheap: views are shared.
struct DrivingState {
  wire::DriveState drive = wire::DriveState::kIdle;
  std::string reason;  // why it stopped or failed, or drives otherwise than it was sent, for people
  wire::Order newest;  // the newest order obeyed
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
  Asking asking;       // people, whether this is the destination
  std::optional<Milliseconds> off_path_since_ms;
  std::optional<Milliseconds> off_belief_since_ms;
  bool astray = false;               // it has ended because the robot was elsewhere than on its way
  bool at_odds = false;              // the mission has ended because belief and estimate named two places
  std::optional<KeptEstimate> kept;  // of where it is, for the next mission
  GiveWay give_way;                  // to whoever stands in the way
  Stirring stirring;                 // of whoever that is
  SteadySweep sweeps;                // round a body that is not round
  Continuity continuity;             // of the pictures that are recognised
  SweepContinuity going_on;          // of the sweeps
  int displaced = 0;                 // how often it noticed that it was moved without its wheels
  bool covered = false;              // the latest picture shows next to nothing
  std::optional<Milliseconds> last_step_ms;
  Milliseconds refuses_until_ms = 0;  // missions that waited while no step was made
  Milliseconds last_message_ms = 0;
  Milliseconds belief_ms = 0;          // when the server told its belief last,
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

/// What goes out: the motion for the driver, messages for the server.
struct Outputs {
  Motion motion;
  std::vector<wire::AgentMessage> messages;
};

/// The heart of the agent: no clock, thread, socket or device. Same state, inputs and time, same result.
/// The longer no message, picture or sweep has come, the slower it goes, so that braking ends `stands_within_ms` after
/// a silence begins although only `link_silence_ms`, `frame_silence_ms` or `scan_silence_ms` of it end the mission. It
/// drives only under a permit that is counted from its receipt on the robot's own clock, with link, pictures and sweeps
/// fresh; everything else is a stop, after which only a newer mission moves it again (docs/architecture.md). The
/// rider's joystick wins at any time: deflected, it ends the mission and the rider drives, with or without link and
/// permit, slowed by the range sensors as missions are; released, the robot stands. No mission drives backwards where
/// the sweeps do not show what is behind.
Outputs step(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms);

/// A mission as the heart needs it, its views decoded. Errors: kFeatureConfigMismatch, kCorruptFile,
/// kUnsupportedFormat.
Result<Mission> decode_mission(const wire::MissionOrder& order, const DrivingConfig& config);

}  // namespace homeward::driving
