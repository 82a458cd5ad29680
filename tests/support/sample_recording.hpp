// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "db/recording.hpp"

namespace homeward::testing {

inline db::RecordingHeader sample_recording_header() {
  return {"homeward-agent/0.1.0", 1'700'000'000'000'000, "m1", "kitchen", "hw2-test", "{}", "{}", "{}", "{}"};
}

/// A step with everything in it, and with numbers that SQLite's own columns do not keep.
inline db::RecordedStep sample_recorded_step(std::int64_t seq) {
  db::RecordedStep step;
  step.seq = seq;
  step.now_ms = 5'000 + 40 * seq;
  step.sensors_ms = 700 + 40 * seq;
  step.odometry = {-0.0, 1.0 / 3.0, 5e-324};
  step.link_up = true;
  step.received = {wire::Permit{MissionId("m1"), {3, seq}, 1500}};
  step.sweep =
      db::RecordedSweep{690 + 40 * seq, -0.0, 0.1, 12.0, {1.5F, std::numeric_limits<float>::infinity(), -0.0F}};
  step.picture = db::RecordedPicture{
      650 + 40 * seq, {2.0, -0.0, 0.1}, std::make_shared<const std::vector<std::uint8_t>>(200, std::uint8_t{7})};
  step.rider = db::RecordedRider{680 + 40 * seq, true, -0.0, std::nextafter(0.2, 1.0)};
  step.leg = db::RecordedLeg{-0.0, 1.0 / 7.0, 0.1};
  step.exploration_over = true;
  step.path_sight =
      db::RecordedPathSight{645 + 40 * seq, {-0.0, 2.0, 1.0 / 3.0},       false, 7,    120, std::nextafter(0.5, 1.0),
                            -0.0,           {{1.0 / 7.0, -0.0, 0.1}, {}}, true,  false};
  wire::SurveyRow known;
  known.state = wire::SurveyState::kKnownAgain;
  known.picture = 71;
  known.pose = {1.0 / 3.0, -2.0, 0.5};
  known.known = 12;
  known.agreement = 0.875;
  wire::SurveyRow next;
  next.state = wire::SurveyState::kNextPlace;
  next.picture = 71;
  next.place_m = {3.5, 0.75};
  next.gain_m2 = 1.25;
  next.cost_m = 1.0 / 7.0;
  step.rows = {known, next, wire::ThesisRow{wire::ThesisState::kHoming, {3, 1}, 271.613, -1.5, {0.25, 3.0}}};
  step.speed_mps = std::nextafter(0.3, 1.0);
  step.turn_radps = -0.0;
  step.state = wire::DriveState::kDriving;
  step.path_index = 2;
  step.answered = true;
  step.vector = db::RecordedVector{-0.0, 0.25, 0.9, 0.05, std::nullopt, 80, 40};
  step.tracks = db::RecordedTracks{60, 3, 12};
  step.min_range_m = 1.5;
  step.sent = {wire::Stopped{"s1", 0}};
  return step;
}

/// Reads all that there is of a recording. Errors: the reader's own.
inline Status read_whole_recording(const std::filesystem::path& file) {
  auto reader = db::RecordingReader::open(file);
  if (!reader) return pass_on(reader);
  const auto why = (*reader)->why_stopped();
  if (!why) return pass_on(why);
  while (true) {
    const auto step = (*reader)->next();
    if (!step) return pass_on(step);
    if (!*step) return {};
  }
}

}  // namespace homeward::testing
