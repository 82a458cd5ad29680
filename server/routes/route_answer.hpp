// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/message.hpp"
#include "server/services/maps.hpp"

namespace homeward::server {

/// Answers GET /maps/{map}/route.
Response answer_route(MapService& maps, const MapId& map, const Request& request);

}  // namespace homeward::server
