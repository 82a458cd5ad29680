// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/store.hpp"
#include "server/http/router.hpp"
#include "server/services/plans.hpp"

namespace homeward::server {

/// Drawn plans, and the maps that are tied to them.
void add_plan_routes(Router& router, PlanService& plans, db::Store& store);

}  // namespace homeward::server
