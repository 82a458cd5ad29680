// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "driving/inputs.hpp"
#include "exploration/survey_row.hpp"

namespace homeward::driving {

/// What the driving step is told when a survey has ended. `unreached`: places that it could not get to.
ExplorationOver exploration_over(exploration::SurveyEnd end, std::size_t unreached);

}  // namespace homeward::driving
