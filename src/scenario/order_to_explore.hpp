// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/lease_durations.hpp"
#include "wire/link_messages.hpp"

namespace homeward::scenario {

/// The first order of all, to explore, of a server that permits for ever: mission "exploration".
inline wire::ExploreOrder order_to_explore(double speed_limit_mps) {
  wire::ExploreOrder order;
  order.mission = MissionId("exploration");
  order.order = {1, 1};
  order.valid_for_ms = wire::kPermitValid_ms;
  order.speed_limit_mps = speed_limit_mps;
  order.exploration = ExplorationId("exploration");
  return order;
}

}  // namespace homeward::scenario
