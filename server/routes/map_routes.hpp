// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/services/maps.hpp"
#include "server/work/build_jobs.hpp"

namespace homeward::server {

/// Maps: their graph, edits, pictures, routes and builds.
void add_map_routes(Router& router, MapService& maps, BuildJobs& jobs, db::Store& store);

}  // namespace homeward::server
