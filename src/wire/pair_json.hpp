// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "map/picture_pair.hpp"

namespace homeward::wire {

/// Two pictures beside each other (proto/schemas/pair.schema.json).
nlohmann::json pair_to_json(const map::PicturePair& pair);

}  // namespace homeward::wire
