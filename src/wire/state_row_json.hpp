// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"

namespace homeward::wire {

// A row of an exploration's table of states, as a recording keeps it (proto/schemas/state_row.schema.json).

enum class SurveyState : std::uint8_t {
  kNew,
  kKnownAgain,
  kTakenBack,
  kNextPlace,
  kReached,
  kBlocked,
  kTriesAgain,
  kGoesHome,
  kEnded
};

enum class SurveyEnd : std::uint8_t { kAllSeen, kBack, kStuck, kLimit };

/// Of our own explorations: exploration::SurveyRow.
struct SurveyRow {
  SurveyState state = SurveyState::kNew;
  std::optional<std::int64_t> picture;  // from 0
  Pose2 pose;                           // frame of the exploration
  std::optional<std::int64_t> known;    // a picture
  std::optional<double> agreement;      // 0 to 1
  std::optional<Eigen::Vector2d> place_m;
  std::optional<double> gain_m2;
  std::optional<double> cost_m;
  std::optional<SurveyEnd> end;
};

enum class ThesisState : std::uint8_t { kExploration, kHoming, kPathPlanning, kDone };

/// Of the thesis's (Ferdaus 2008, tables 5.1 to 5.8).
struct ThesisRow {
  ThesisState state = ThesisState::kExploration;
  std::vector<std::int64_t> nodes;      // from, to; a whole way where it is planned
  std::optional<double> dissimilarity;  // from the node that the view was taken for; nothing where it was new
  std::optional<double> direction_rad;  // that was driven in, counter-clockwise from the heading of the first node
  std::vector<double> left_rad;         // directions of that node that are left, best first
};

using StateRow = std::variant<SurveyRow, ThesisRow>;

/// "next_place", "exploration_homing", ...
std::string_view state_name(const StateRow& row);
/// "all_seen", "back", "stuck", "limit".
std::string_view survey_end_name(SurveyEnd end);

nlohmann::json state_row_to_json(const StateRow& row);
/// Strict. Errors: kInvalidInput.
Result<StateRow> state_row_from_json(const nlohmann::json& value, const std::string& path = "state");

}  // namespace homeward::wire
