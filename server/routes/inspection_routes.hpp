// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/services/inspection.hpp"

namespace homeward::server {

/// What maps were before edits, reports of builds, and similarity matrices.
void add_inspection_routes(Router& router, InspectionService& inspection);

}  // namespace homeward::server
