// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "db/store.hpp"
#include "server/http/metrics.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

/// healthz, readyz, metrics, api/docs.
void add_operation_routes(Router& router, Metrics& metrics, db::Store& store);

/// The contract as text (proto/openapi.yaml).
std::string_view openapi_text();

}  // namespace homeward::server
