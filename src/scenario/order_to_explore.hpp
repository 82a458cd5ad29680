// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "driving/driving_config.hpp"
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

/// What a simulated robot explores with; its recorder has to be given the same.
inline driving::DrivingConfig exploring_config(const driving::Body& body, const std::string& feature_config_id) {
  driving::DrivingConfig config;
  config.body = body;
  config.feature_config_id = feature_config_id;
  return config;
}

}  // namespace homeward::scenario
