// SPDX-License-Identifier: Apache-2.0
#include "exploration/picture_rows.hpp"

namespace homeward::exploration {
namespace {

SurveyRow row_of_loop(SurveyState state, const KnownAgain& loop, const Pose2& floor_from_robot) {
  SurveyRow row;
  row.state = state;
  row.picture = loop.now;
  row.floor_from_robot = floor_from_robot;
  row.known = loop.then;
  row.agreement = loop.agreement;
  return row;
}

}  // namespace

std::vector<SurveyRow> picture_rows(const std::vector<KnownAgain>& before, const std::vector<KnownAgain>& now,
                                    int picture, const Pose2& floor_from_robot) {
  std::vector<SurveyRow> rows;
  if (now.size() > before.size()) {
    rows.push_back(row_of_loop(SurveyState::kKnownAgain, now.back(), floor_from_robot));
  } else {
    SurveyRow& row = rows.emplace_back();
    row.picture = picture;
    row.floor_from_robot = floor_from_robot;
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    const bool was_taken_back = i < before.size() && before[i].taken_back;
    if (now[i].taken_back && !was_taken_back)
      rows.push_back(row_of_loop(SurveyState::kTakenBack, now[i], floor_from_robot));
  }
  return rows;
}

}  // namespace homeward::exploration
