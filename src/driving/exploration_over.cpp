// SPDX-License-Identifier: Apache-2.0
#include "driving/exploration_over.hpp"

#include <cstdint>

namespace homeward::driving {

ExplorationOver exploration_over(exploration::SurveyEnd end, std::size_t unreached) {
  using wire::ReasonCode;
  switch (end) {
    case exploration::SurveyEnd::kBack:
      return {false, wire::Reason{ReasonCode::kExplorationBack}};
    case exploration::SurveyEnd::kStuck:
      return {true, wire::Reason{ReasonCode::kExplorationStuck}};
    case exploration::SurveyEnd::kLimit:
      return {false, wire::Reason{ReasonCode::kExplorationLimit}};
    case exploration::SurveyEnd::kAllSeen:
      break;
  }
  if (unreached == 0) return {};
  return {false, wire::Reason{ReasonCode::kExplorationUnreached, {{"places", static_cast<std::int64_t>(unreached)}}}};
}

}  // namespace homeward::driving
