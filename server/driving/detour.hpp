// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planning/route.hpp"

namespace homeward::server {

/// What not to drive again after a robot failed on its way to `path[index]` and is believed to be at `here`: the edge
/// that it was driving, and where it is known to be further already, the edge after that; both directions of them.
/// Nothing where no edge can be blamed.
std::vector<planning::Way> failed_ways(const std::vector<PlaceId>& path, std::int64_t index, const PlaceId& here);

}  // namespace homeward::server
