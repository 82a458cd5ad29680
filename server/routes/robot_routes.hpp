// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/auth/authenticator.hpp"
#include "server/driving/driving.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

/// robots, leases, missions, stop, frames.
void add_robot_routes(Router& router, Driving& driving, Authenticator& authenticator, db::Store& store);

}  // namespace homeward::server
