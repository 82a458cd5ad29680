// SPDX-License-Identifier: Apache-2.0
#include "recording/replay.hpp"

#include <bit>
#include <cstdio>

#include "recording/look.hpp"
#include "recording/memory_json.hpp"
#include "recording/recorded_step.hpp"
#include "recording/settings_json.hpp"
#include "wire/camera_json.hpp"

namespace homeward::recording {
namespace {

constexpr std::size_t kMostDifferencesReported = 10;

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string shown(std::int64_t value) { return std::to_string(value); }
std::string shown(bool value) { return value ? "yes" : "no"; }
std::string shown(const wire::Reason& value) { return wire::english(value); }
std::string shown(wire::DriveState value) { return std::string(wire::drive_state_name(value)); }
template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? shown(*value) : "nothing";
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}
bool same(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

/// An older recording has words instead of codes.
bool same_words(const std::optional<wire::Reason>& then, const std::optional<wire::Reason>& now) {
  return says(then, wire::ReasonCode::kText) && now && wire::english(*then) == wire::english(*now);
}

bool same_message(const wire::AgentMessage& then, const wire::AgentMessage& now) {
  const auto* refused_then = std::get_if<wire::MissionRefused>(&then);
  const auto* refused_now = std::get_if<wire::MissionRefused>(&now);
  if (refused_then != nullptr && refused_now != nullptr && same_words(refused_then->reason, refused_now->reason)) {
    wire::MissionRefused expected = *refused_then;
    expected.reason = refused_now->reason;
    return wire::encode(wire::AgentMessage(expected)) == wire::encode(now);
  }
  return wire::encode(then) == wire::encode(now);
}

/// Compares what came out of one step, then and now.
class Comparison {
 public:
  Comparison(std::int64_t step, ReplayResult& result) : step_(step), result_(result) {}

  void all(const db::RecordedStep& then, const db::RecordedStep& now) {
    one("state", then.state, now.state);
    if (!same_words(then.reason, now.reason)) one("reason", then.reason, now.reason);
    one("path_index", then.path_index, now.path_index);
    one("answered", then.answered, now.answered);
    one("docking", then.docking, now.docking);
    one("covered", then.covered, now.covered);
    one("min_range_m", then.min_range_m, now.min_range_m);
    one("vector", then.vector.has_value(), now.vector.has_value());
    if (then.vector && now.vector) {
      one("vector/bearing_rad", then.vector->bearing_rad, now.vector->bearing_rad);
      one("vector/turn_rad", then.vector->turn_rad, now.vector->turn_rad);
      one("vector/confidence", then.vector->confidence, now.vector->confidence);
      one("vector/parallax_rad", then.vector->parallax_rad, now.vector->parallax_rad);
      one("vector/nearness", then.vector->nearness, now.vector->nearness);
      one("vector/matches", then.vector->matches, now.vector->matches);
      one("vector/inliers", then.vector->inliers, now.vector->inliers);
    }
    if (then.tracks && now.tracks) {  // beside each vector, but in older recordings
      one("tracks/tracked", then.tracks->tracked, now.tracks->tracked);
      one("tracks/recovered", then.tracks->recovered, now.tracks->recovered);
      one("tracks/lost", then.tracks->lost, now.tracks->lost);
    }
    one("speed_mps", then.speed_mps, now.speed_mps);
    one("turn_radps", then.turn_radps, now.turn_radps);
    one("messages", then.sent.size(), now.sent.size());
    for (std::size_t i = 0; i < std::min(then.sent.size(), now.sent.size()); ++i) {
      one("messages/" + std::to_string(i), same_message(then.sent[i], now.sent[i]), true);
    }
  }

 private:
  void one(const std::string& what, std::size_t then, std::size_t now) {
    one(what, static_cast<std::int64_t>(then), static_cast<std::int64_t>(now));
  }
  template <class T>
  void one(const std::string& what, const T& then, const T& now) {
    if (same(then, now)) return;
    ++result_.differences;
    if (result_.differing.size() < kMostDifferencesReported) {
      result_.differing.push_back({step_, what, shown(then), shown(now)});
    }
  }

  std::int64_t step_;
  ReplayResult& result_;
};

struct Robot {
  driving::DrivingConfig driving;
  driving::DrivingState state;
  pipeline::Eye eye;
};

/// The robot as it was when the mission began.
Result<Robot> robot_of(const db::RecordingReader& recording) {
  const db::RecordingHeader& header = recording.header();
  const auto camera = wire::parse_camera(header.camera_json, "meta/camera");
  if (!camera) return pass_on(camera);
  const auto features = features_from_json(header.features_json);
  if (!features) return pass_on(features);
  auto driving = driving_from_json(header.driving_json);
  if (!driving) return pass_on(driving);
  auto state = memory_from_json(header.before_json);
  if (!state) return pass_on(state);
  const std::string own = features::feature_config_id(*features);
  if (own != header.feature_config_id || own != driving->feature_config_id) {
    return fail(ErrorCode::kFeatureConfigMismatch,
                "The recording was made with other features (" + header.feature_config_id + ") than this program's (" +
                    own + "): replay it with the program that recorded it.",
                "meta/feature_config_id");
  }
  auto eye = pipeline::Eye::create(*camera, *features);
  if (!eye) return pass_on(eye);
  if (recording.sweep_before()) state->scan = from_recorded(*recording.sweep_before());
  return Robot{std::move(*driving), std::move(*state), std::move(*eye)};
}

/// Why the recording cannot be replayed from this step on, or nothing.
Result<std::optional<std::string>> replay_step(const db::RecordedStep& then, Robot& robot, ReplayResult& result) {
  driving::Inputs inputs = inputs_of(then);
  if (then.picture && then.picture->looked_at) {
    if (!then.picture->bytes) return std::optional("the picture of step " + shown(then.seq) + " was left out");
    auto seen = look({then.picture->taken_ms, then.picture->odometry, then.picture->bytes, then.picture->recognised},
                     robot.eye);
    if (!seen) return pass_on(seen);
    inputs.picture = std::move(*seen);
    ++result.pictures;
  }
  const driving::Outputs outputs = driving::step(robot.state, inputs, robot.driving, then.now_ms);
  db::RecordedStep now;
  put_outcome(now, robot.state, outputs);
  Comparison(then.seq, result).all(then, now);
  if (then.picture && then.vector) ++result.vectors;
  ++result.compared;
  return std::optional<std::string>();
}

Result<ReplayResult> replay_all(db::RecordingReader& recording, const std::function<void(double)>& progress) {
  ReplayResult result;
  result.header = recording.header();
  result.steps = recording.step_count();
  auto robot = robot_of(recording);
  if (!robot) return pass_on(robot);
  std::optional<std::string> ends_early;
  while (!ends_early) {
    auto then = recording.next();
    if (!then) return pass_on(then);
    if (!*then) break;
    auto replayed = replay_step(**then, *robot, result);
    if (!replayed) return pass_on(replayed);
    ends_early = std::move(*replayed);
    progress(static_cast<double>(result.compared) / static_cast<double>(result.steps));
  }
  if (result.steps == 0) return fail(ErrorCode::kEmptyInput, "The recording has no steps: it was cut off as it began.");
  const auto& end = recording.end();
  result.complete = end && end->whole && !ends_early;
  result.note = end ? end->note : "The recording was cut off after step " + shown(result.steps) + ".";
  if (ends_early) result.note += " Replayed up to step " + shown(result.compared) + ": " + *ends_early + ".";
  const auto why = recording.why_stopped();
  if (!why) return pass_on(why);
  result.why = *why;
  return result;
}

}  // namespace

Result<ReplayResult> replay(const std::filesystem::path& file, const std::function<void(double)>& progress) {
  const auto recording = db::RecordingReader::open(file);
  if (!recording) return pass_on(recording);
  auto result = replay_all(**recording, progress);
  if (!result && result.error().where.find(file.string()) == std::string::npos) {
    Error error = result.error();
    error.where = file.string() + (error.where.empty() ? "" : ": " + error.where);
    return tl::unexpected<Error>(std::move(error));
  }
  return result;
}

}  // namespace homeward::recording
