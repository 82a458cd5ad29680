// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/http/router.hpp"
#include "server/services/tours.hpp"

namespace homeward::server {

void add_tour_routes(Router& router, TourService& tours, db::Store& store);

}  // namespace homeward::server
