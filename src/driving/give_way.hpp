// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "core/pose2.hpp"
#include "driving/body.hpp"

namespace homeward::driving {

/// When a robot makes room for somebody, and how much.
struct GiveWayConfig {
  std::int64_t patience_ms = 6000;         // so long a round body tries to get on before it backs off,
  std::int64_t long_patience_ms = 12'000;  // and a long one: it may turn to and fro and get through in the end
  double got_on_m = 0.3;                   // with less it has not got on, however it turned there
  double back_m = 1.2;                     // so far it backs off,
  double least_back_m = 0.5;               // with less of a trail not at all,
  double farther_back_m = 0.8;             // and so much farther each time that somebody still stands there,
  double farthest_back_m = 4.0;            // up to that
  double backing_mps = 0.25;               // so fast,
  std::int64_t turning_ms = 3500;          // after so long for turning at most,
  double there_m = 0.15;                   // until it is so near
  std::int64_t waiting_ms = 2500;          // it waits there at least so long,
  std::int64_t longest_wait_ms = 12'000;   // and so long while somebody walks about;
  std::int64_t quiet_ms = 1500;            // after so long nobody walks there any more
  std::int64_t somebody_ms = 20'000;       // since something moved of itself: what stands there is no thing
  int times = 3;                           // that it backs off from a thing
  double elsewhere_m = 2.0;                // from where it backed off: it has got past
  double enough_beside_m = 2.0;            // room on one side that needs no pulling over;
  double most_aside_m = 0.8;               // else it pulls over by up to that,
  double wall_m = 0.12;                    // and leaves so much to the wall
};

/// Making room for somebody who stands in the way and cannot get past either: back along the way that the robot came,
/// to the side of it where that leaves them more room, a moment's wait, and on again once nobody walks there any more.
/// From a thing that stays the robot so backs off three times, and then waits before it; sent on from there it tries
/// once more.
/// Ours: docs/experiments/missions.md.
struct GiveWay {
  enum class Phase : std::uint8_t { kOnTheWay, kBacking, kWaiting };

  std::deque<Eigen::Vector2d> trail_m;  // where it came along, odometry's frame, oldest first
  Phase phase = Phase::kOnTheWay;
  std::int64_t phase_since_ms = 0;
  std::optional<Eigen::Vector2d> still_at_m;  // about where it has been since `still_since_ms`; odometry's frame
  std::int64_t still_since_ms = 0;
  Eigen::Vector2d back_to_m = Eigen::Vector2d::Zero();     // odometry's frame
  std::int64_t backing_ms = 0;                             // it may take so long to get there
  Eigen::Vector2d blocked_at_m = Eigen::Vector2d::Zero();  // where it last backed off,
  int times = 0;                                           // so many times from about there
};

/// Notes where the robot is: at every step, whoever drives it.
void remember_trail(GiveWay& state, const Pose2& odometry);

/// What a robot that may have to make room knows of what is about it.
struct Surroundings {
  std::span<const Eigen::Vector2d> points_m;      // of the newest sweep, robot frame
  std::optional<std::int64_t> obstacle_moved_ms;  // when something there last moved of itself
};

/// Where to back off to, robot frame; zero: it waits where it is; nothing: it drives on. To be asked at every step at
/// which the robot knows where to and wants to go there; `forget_standing` at the others. `patience_ms`: so long it may
/// try to get on before it backs off.
std::optional<Eigen::Vector2d> give_way(GiveWay& state, const Body& body, const Surroundings& about,
                                        const Pose2& odometry, std::int64_t now_ms, std::int64_t patience_ms,
                                        const GiveWayConfig& config = {});

/// The robot has a reason of its own to stand still.
void forget_standing(GiveWay& state);

/// The robot is sent on its way, anew perhaps: who stood before it may have gone, a thing has not.
void begin_way(GiveWay& state, const GiveWayConfig& config = {});

}  // namespace homeward::driving
