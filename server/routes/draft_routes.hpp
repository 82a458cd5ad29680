// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/store.hpp"
#include "server/http/router.hpp"
#include "server/services/drafts.hpp"
#include "server/work/build_jobs.hpp"

namespace homeward::server {

/// Everything under /maps/{map}/drafts of the contract. The arguments outlive the router.
void add_draft_routes(Router& router, DraftService& drafts, BuildJobs& jobs, db::Store& store);

}  // namespace homeward::server
