// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::wire {

/// The most that a mission allows, of the server and of the simulated one, unless a scenario says otherwise. A body
/// that brakes with 1 m/s^2 is not driven faster than 0.38 m/s in any case: from there it stands half a second after a
/// silence begins (driving/permitted.hpp). What lies between only counts where doubt slows it down.
inline constexpr double kSpeedLimit_mps = 0.4;

}  // namespace homeward::wire
