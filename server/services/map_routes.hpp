// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/jobs/build_jobs.hpp"
#include "server/services/maps.hpp"

namespace homeward::server {

/// maps, their graph, edits, pictures, routes and builds.
void add_map_routes(Router& router, MapService& maps, BuildJobs& jobs, db::Store& store);

}  // namespace homeward::server
