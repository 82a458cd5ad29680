// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "exploration/explorer.hpp"
#include "exploration/survey_row.hpp"

namespace homeward::exploration {

/// What a picture, the newest, has made of the places known again: that it is of a new place or of one of these, and
/// which of them were wrong. `before`, `now`: Explorer::known_again before it was taken and after.
std::vector<SurveyRow> picture_rows(const std::vector<KnownAgain>& before, const std::vector<KnownAgain>& now,
                                    int picture, const Pose2& floor_from_robot);

}  // namespace homeward::exploration
