// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/driving/driving.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

/// Explorations of robots: begin or go on, how far it is, fences, with whom, the end.
void add_exploration_routes(Router& router, Driving& driving);

}  // namespace homeward::server
