// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/milliseconds.hpp"

namespace homeward::driving {

/// How a path that was taught is driven.
struct RepeatPathConfig {
  bool steers_by_features = false;  // by the law of Segvic et al. 2007 alone
  double look_m = 0.45;             // so far ahead of the robot it steers to, along the way
  double aside_m = 1.0;             // farther from the way it is off it
  double metres_per_rad = 0.5;      // how a turn counts beside a distance, where the nearest of the way is looked for
  double corner_rad = 0.35;         // turned by more than that
  double corner_m = 0.12;           // over less way is a turn on the spot,
  double at_corner_m = 0.06;        // made where it is so near
  double turned_rad = 0.1;          // and over when so little of it is left
  double turn_mps = 0.3;            // in turns (Segvic et al. 2007),
  double straight_mps = 0.8;        // and straight on, at most
  double bend_radps = 0.6;          // so fast the way may turn
  double unsure_mps = 0.2;          // with a confidence of 0; of 0.5 and more it makes no difference
  double brakes_per_s = 0.8;        // speed for each metre left to the end or to a corner
  double least_mps = 0.08;
  double there_m = 0.03;             // so near to its end it has arrived
  double blind_m = 0.3;              // driven on by odometry after the last picture that was known
  Milliseconds lost_ms = 8000;       // not known for so long: the mission fails
  Milliseconds loads_ms = 60'000;    // without the path for so long: the same
  double gets_on_m = 0.1;            // driven on by less,
  double gets_on_rad = 0.2;          // and turned by less, it does not get on;
  double spot_m = 0.6;               // nor where it stays so near to one spot,
  Milliseconds at_spot_ms = 30'000;  // whatever it does there, for so long
};

}  // namespace homeward::driving
