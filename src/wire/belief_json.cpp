// SPDX-License-Identifier: Apache-2.0
#include "wire/belief_json.hpp"

#include "wire/json_write.hpp"

namespace homeward::wire {

nlohmann::json belief_to_json(const BeliefView& belief) {
  nlohmann::json top = nlohmann::json::array();
  for (const PlaceShare& share : belief.top) {
    top.push_back({{"place", share.place.str()}, {"probability", finite_or_null(share.probability)}});
  }
  return {{"updates", belief.updates},
          {"place", or_null(belief.place)},
          {"probability", or_null(belief.probability)},
          {"top", top},
          {"lost", belief.lost},
          {"ms", or_null(belief.ms)},
          {"t_us", or_null(belief.t_us)}};
}

}  // namespace homeward::wire
