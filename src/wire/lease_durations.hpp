// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace homeward::wire {

// How long the rights to drive last, and how often server and robot let each other hear: what server, agent and
// simulated server have to agree on, each value once.

/// How long the right to drive lasts after it was taken or kept.
inline constexpr std::int64_t kLease_ms = 10'000;
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

}  // namespace homeward::wire
