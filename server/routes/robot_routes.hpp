// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/driving/driving.hpp"
#include "server/http/router.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// robots, leases, missions, stop, frames.
void add_robot_routes(Router& router, Driving& driving, db::Store& store, const Clock& clock);

}  // namespace homeward::server
