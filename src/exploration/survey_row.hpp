// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/pose2.hpp"

namespace homeward::exploration {

/// Why a survey has ended.
enum class SurveyEnd : std::uint8_t {
  kAllSeen,  // nothing is left to explore but what could not be got to (Explorer::put_off); it is back if it has to be
  kBack,     // it is where it began, as its time is nearly over
  kStuck,    // it does not get away from where it is, or knows no way home
  kLimit,    // whoever leads it has ended it (Survey::end_at_limit)
};

/// What a row of a survey's table of states tells of.
enum class SurveyState : std::uint8_t {
  kNew,         // a picture was taken where it has not been before, by all it knows,
  kKnownAgain,  // or at a place that it knows again
  kTakenBack,   // which was wrong: the other links contradict it
  kNextPlace,   // it drives to another place
  kReached,     // the place that it drove to
  kBlocked,     // or the way there does not lead on: it is put off
  kTriesAgain,  // nothing else is left: what was blocked is tried again
  kGoesHome,    // to where it began
  kEnded,
};

/// One row: what was found or decided, and by what numbers. As Ferdaus (2008, tables 5.1 to 5.8) keeps one of each
/// state of his exploration. Pictures are numbered from 0; the frame is that of the exploration.
struct SurveyRow {
  SurveyState state = SurveyState::kNew;
  std::optional<int> picture;  // the newest; kTakenBack: that was known again. Nothing: there is none yet
  Pose2 floor_from_robot;
  std::optional<int> known;                // kKnownAgain, kTakenBack: the picture by which,
  std::optional<double> agreement;         // and the share of the sweep that agrees with those around that one
  std::optional<Eigen::Vector2d> place_m;  // kNextPlace, kReached, kBlocked: where; kGoesHome, as far as it is known
  std::optional<double> gain_m2;           // kNextPlace: see NextView
  std::optional<double> cost_m;            // kNextPlace, kGoesHome: of the way there
  std::optional<SurveyEnd> end;            // kEnded; kGoesHome: as what it will end there
};

}  // namespace homeward::exploration
