// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/work/build_jobs.hpp"

namespace homeward::server {

/// Jobs by their id: how far they are, taking an offer, cancelling.
void add_job_routes(Router& router, BuildJobs& jobs);

}  // namespace homeward::server
