// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/services/maps.hpp"

namespace homeward::server {

/// Why a map is as it is: what of it a person should look at, and pictures beside each other. The arguments outlive the
/// router.
void add_evidence_routes(Router& router, MapService& maps);

}  // namespace homeward::server
