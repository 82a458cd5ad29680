// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::wire {

/// The most that a mission allows, of the server and of the simulated one, unless a scenario says otherwise. Measured:
/// docs/experiments/speed_limit.md.
inline constexpr double kSpeedLimit_mps = 0.4;

}  // namespace homeward::wire
