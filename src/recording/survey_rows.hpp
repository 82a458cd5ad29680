// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "exploration/survey_row.hpp"
#include "wire/state_row_json.hpp"

namespace homeward::recording {

/// A survey's table of states as a recording holds it.
std::vector<wire::StateRow> to_recorded(const std::vector<exploration::SurveyRow>& rows);

}  // namespace homeward::recording
