// SPDX-License-Identifier: Apache-2.0
#include "wire/pair_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

nlohmann::json point_to_json(const map::PicturePoint& point) { return {{"x", point.x}, {"y", point.y}}; }

}  // namespace

nlohmann::json pair_to_json(const map::PicturePair& pair) {
  nlohmann::json matches = nlohmann::json::array();
  for (const map::PairMatch& match : pair.matches) {
    matches.push_back({{"a", point_to_json(match.a)},
                       {"b", point_to_json(match.b)},
                       {"distinctiveness", match.distinctiveness},
                       {"agrees", match.agrees}});
  }
  return {{"format", "homeward-pair"},
          {"version", 1},
          {"image_a", pair.image_a.str()},
          {"image_b", pair.image_b.str()},
          {"distance", or_null(pair.distance)},
          {"similarity", pair.similarity},
          {"turn_rad", or_null(pair.turn_rad)},
          {"shift", or_null(pair.shift)},
          {"matches", matches}};
}

}  // namespace homeward::wire
