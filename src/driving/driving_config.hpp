// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "driving/approach.hpp"
#include "driving/body.hpp"
#include "driving/follow_config.hpp"
#include "driving/give_way.hpp"
#include "driving/look_around.hpp"
#include "driving/milliseconds.hpp"
#include "driving/pursuit.hpp"
#include "driving/repeat_path_config.hpp"
#include "driving/steering.hpp"

namespace homeward::driving {

/// How fast a mission is driven, within what it, the body and the ranges allow.
struct SpeedConfig {
  double shortcut_mps = 0.25;           // where no tour drove
  double unsure_mps = 0.25;             // where it does not know where it is, or nothing answers
  double destination_gain_per_s = 0.6;  // for each metre left to the destination's view: one picture's way must stay a
                                        // fraction of the tolerance,
  double destination_mps = 0.18;        // and at least,
  double alike_mps = 0.12;              // where the picture looks like the view,
  double alike_share = 0.25;            // from this share of its features on
  double without_doubt = 1.2;           // share of the speed, were it known exactly where the view lies,
  double less_per_m = 0.4;              // less so much for each metre of doubt; 1 at most,
  double least_share = 0.4;             // and at least that
};

/// When a mission has arrived or makes no way.
struct ProgressConfig {
  double gain_m = 0.25;              // driven on by more than that, way is gained
  double near_known_m = 0.1;         // doubted by less, the destination is right here also where nothing shows it now
  double stays_near_m = 0.05;        // measured so much farther off, it is still near
  Milliseconds docking_ms = 15'000;  // not turned to the heading there for so long, it has arrived all the same
  // A blocked way that a tour drove speaks against being where the estimate is: the odds, and within what distance.
  double blocked_odds = 0.02;
  double blocked_within_m = 2.0;
  double denied_astray_below = 0.5;  // less probably at a destination that somebody denies, it is astray
};

/// Everything that decides beside the inputs how a robot drives. Recorded with each mission (recording/settings_json).
struct DrivingConfig {
  Body body;
  FollowConfig follow;
  SafetyConfig safety;
  SpeedConfig speed;
  ProgressConfig progress;
  ApproachConfig approach;
  PursuitConfig pursuit;
  SteeringConfig steering;
  GiveWayConfig give_way;
  LookAroundConfig look_around;
  RepeatPathConfig repeat_path;
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
  Milliseconds patience_ms = 90'000;        // after so long where somebody moves about the robot
  Milliseconds stays_ms = 60'000;           // so long at one spot the way is blocked, whatever the robot does there:
  double stays_within_m = 1.5;              // no farther than that from where it came to it
  double near_m = 0.25;                     // of the destination: what is in the way there may stay in the way
  Milliseconds near_ms = 8000;              // so long it tries to come nearer than that
  double turn_gain = 1.8;                   // turn rate for each radian towards the carrot
  double dock_within_rad = 0.02;            // heading at the end
  Milliseconds belief_lasts_ms = 1000;      // so long the server's belief must be lost before that counts
  int covered_below_features = 20;          // a picture with fewer is of a covered camera
  double odometry_jump_m = 1.0;             // farther between two missions, and odometry has begun anew
  double least_aim_m = 0.4;        // nearer than that, the destination's bearing is better known than its place
  double rider_creep_mps = 0.12;   // so fast the rider drives at most where no sweep is fresh,
  double rider_creep_radps = 0.4;  // and turns
};

}  // namespace homeward::driving
