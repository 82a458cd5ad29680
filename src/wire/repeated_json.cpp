// SPDX-License-Identifier: Apache-2.0
#include "wire/repeated_json.hpp"

#include <nlohmann/json.hpp>

namespace homeward::wire {

nlohmann::json repeated_to_json(const RepeatedView& view) {
  const bool lost = !view.lost.empty();
  nlohmann::json value{{"image", view.image},
                       {"arc", view.arc},
                       {"from", view.from},
                       {"to", view.to},
                       {"tracked", view.tracked},
                       {"expected", view.expected},
                       {"predicted", view.predicted},
                       {"recovered", view.recovered},
                       {"lost", lost},
                       {"ms", view.ms}};
  value["why_lost"] = lost ? nlohmann::json(view.lost) : nlohmann::json();
  // Where nobody knows the place, no number may be taken for one.
  const auto known = [&](const char* key, const nlohmann::json& number) {
    value[key] = lost ? nlohmann::json() : number;
  };
  known("progress", view.progress);
  known("lateral_over_arc", view.lateral_over_arc);
  known("steering_rad", view.steering_rad);
  known("bearing_rad", view.bearing_rad ? nlohmann::json(*view.bearing_rad) : nlohmann::json());
  known("error_px", view.error_px);
  known("confidence", view.confidence);
  known("structure_agrees", view.structure_agrees);
  known("at_end", view.at_end);
  return value;
}

}  // namespace homeward::wire
