// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/driving/driving.hpp"
#include "server/http/router.hpp"
#include "server/ws/event_hub.hpp"

namespace homeward::server {

/// The WebSockets: events for dashboards, which begin with `snapshot`, and the links of robots.
void add_socket_routes(Router& router, Driving& driving, EventHub& events, EventHub::MakeSnapshot snapshot);

}  // namespace homeward::server
