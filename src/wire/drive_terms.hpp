// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace homeward::wire {

// The terms on which robots are driven: what server, agent and simulated server have to agree on, each value once.

/// The most that a mission of the server allows: so slow that braking at 1 m/s^2 ends within half a second of a link
/// that falls silent.
inline constexpr double kServerSpeedLimit_mps = 0.4;
/// The most that a mission of the simulated server allows, and that the measured scenarios were driven with. It is not
/// the server's.
inline constexpr double kScenarioSpeedLimit_mps = 0.45;

/// How long an order or a permit is valid from its receipt, by the robot's own clock.
inline constexpr std::int64_t kPermitValid_ms = 1500;
/// How often the server permits; the simulated server does so in each of its cycles.
inline constexpr std::int64_t kPermitEvery_ms = 50;
/// A permit goes only to a robot that was heard within this time.
inline constexpr std::int64_t kHeardWithin_ms = 1000;
/// The link of a robot that was silent for longer is closed.
inline constexpr std::int64_t kLinkSilence_ms = 4000;
/// How often a robot tells its status at the least.
inline constexpr std::int64_t kStatusEvery_ms = 250;
/// How often a robot shows the server a picture, unless it is told otherwise.
inline constexpr std::int64_t kFrameEvery_ms = 200;
/// How long the right to drive lasts after it was taken or kept.
inline constexpr std::int64_t kLease_ms = 10'000;

/// The cycle of a robot's loop: 25 times a second.
inline constexpr std::int64_t kAgentCycle_ms = 40;
/// The cycle of the simulated server and of the robot in it, in simulated time.
inline constexpr double kScenarioCycle_s = 0.1;

}  // namespace homeward::wire
