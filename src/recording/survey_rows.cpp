// SPDX-License-Identifier: Apache-2.0
#include "recording/survey_rows.hpp"

namespace homeward::recording {
namespace {

wire::SurveyState recorded_state(exploration::SurveyState state) {
  switch (state) {
    case exploration::SurveyState::kNew:
      return wire::SurveyState::kNew;
    case exploration::SurveyState::kKnownAgain:
      return wire::SurveyState::kKnownAgain;
    case exploration::SurveyState::kTakenBack:
      return wire::SurveyState::kTakenBack;
    case exploration::SurveyState::kNextPlace:
      return wire::SurveyState::kNextPlace;
    case exploration::SurveyState::kReached:
      return wire::SurveyState::kReached;
    case exploration::SurveyState::kBlocked:
      return wire::SurveyState::kBlocked;
    case exploration::SurveyState::kTriesAgain:
      return wire::SurveyState::kTriesAgain;
    case exploration::SurveyState::kGoesHome:
      return wire::SurveyState::kGoesHome;
    case exploration::SurveyState::kEnded:
      break;
  }
  return wire::SurveyState::kEnded;
}

wire::SurveyEnd recorded_end(exploration::SurveyEnd end) {
  switch (end) {
    case exploration::SurveyEnd::kAllSeen:
      return wire::SurveyEnd::kAllSeen;
    case exploration::SurveyEnd::kBack:
      return wire::SurveyEnd::kBack;
    case exploration::SurveyEnd::kStuck:
      return wire::SurveyEnd::kStuck;
    case exploration::SurveyEnd::kLimit:
      break;
  }
  return wire::SurveyEnd::kLimit;
}

}  // namespace

std::vector<wire::StateRow> to_recorded(const std::vector<exploration::SurveyRow>& rows) {
  std::vector<wire::StateRow> recorded;
  recorded.reserve(rows.size());
  for (const exploration::SurveyRow& row : rows) {
    wire::SurveyRow kept;
    kept.state = recorded_state(row.state);
    kept.picture = row.picture;
    kept.pose = row.floor_from_robot;
    kept.known = row.known;
    kept.agreement = row.agreement;
    kept.place_m = row.place_m;
    kept.gain_m2 = row.gain_m2;
    kept.cost_m = row.cost_m;
    if (row.end) kept.end = recorded_end(*row.end);
    recorded.emplace_back(std::move(kept));
  }
  return recorded;
}

}  // namespace homeward::recording
