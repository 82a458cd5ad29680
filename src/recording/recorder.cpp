// SPDX-License-Identifier: Apache-2.0
#include "recording/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "files/write_file.hpp"
#include "recording/memory_json.hpp"
#include "recording/recorded_step.hpp"
#include "recording/settings_json.hpp"
#include "wire/camera_json.hpp"

namespace homeward::recording {
namespace {

TimeUs now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

bool may_begin(const driving::Inputs& inputs) {
  return std::any_of(inputs.messages.begin(), inputs.messages.end(), [](const wire::ServerMessage& message) {
    return std::holds_alternative<wire::MissionOrder>(message) || std::holds_alternative<wire::ExploreOrder>(message) ||
           std::holds_alternative<wire::RepeatOrder>(message);
  });
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const RecordingOptions& options, const Robot& robot,
                                                   std::function<void(const std::string&)> log) {
  constexpr std::int64_t kLeast = 1 << 20;
  if (options.limit_bytes < kLeast || options.folder_limit_bytes < options.limit_bytes) {
    return fail(ErrorCode::kInvalidInput,
                "A recording needs at least 1 MB, and its folder at least as much as one recording.",
                options.folder.string());
  }
  if (const Status made = files::make_folder(options.folder); !made) return pass_on(made);
  return std::unique_ptr<Recorder>(new Recorder(options, robot, std::move(log)));
}

Recorder::Recorder(const RecordingOptions& options, Robot robot, std::function<void(const std::string&)> log)
    : options_(options),
      robot_(std::move(robot)),
      camera_json_(wire::camera_to_json(robot_.camera).dump()),
      features_json_(features_to_json(robot_.features)),
      driving_json_(driving_to_json(robot_.driving)),
      feature_config_id_(features::feature_config_id(robot_.features)),
      thread_(options, std::move(log)) {}

Recorder::~Recorder() {
  if (recording_) thread_.finish({false, "The program ended while the robot was driving."});
}

void Recorder::begin(const driving::DrivingState& before, const driving::DrivingState& state) {
  if (recording_) thread_.finish({true, "Another mission was sent."});
  db::RecordingHeader header;
  header.agent = robot_.agent;
  header.started_us = now_us();
  header.mission = state.mission->id.str();
  header.label = state.mission->label;
  header.feature_config_id = feature_config_id_;
  header.camera_json = camera_json_;
  header.features_json = features_json_;
  header.driving_json = driving_json_;
  header.before_json = memory_to_json(before);
  thread_.begin(std::move(header), before.scan ? std::optional(to_recorded(*before.scan)) : std::nullopt);
  recording_ = true;
  seq_ = 0;
}

driving::Outputs Recorder::step(driving::DrivingState& state, const driving::Inputs& inputs,
                                const PictureBytes& picture, driving::Milliseconds now_ms,
                                std::vector<wire::StateRow> rows) {
  std::optional<driving::DrivingState> before;
  if (may_begin(inputs)) before = state;
  const driving::Outputs outputs = driving::step(state, inputs, robot_.driving, now_ms);
  if (before && state.mission != before->mission) begin(*before, state);
  if (!recording_) return outputs;
  db::RecordedStep recorded = to_recorded(++seq_, inputs, picture, state, outputs, now_ms);
  recorded.rows = std::move(rows);
  recording_ = thread_.append(std::move(recorded));
  if (recording_ && state.drive != wire::DriveState::kDriving) {
    thread_.finish({true, "The mission ended."});
    recording_ = false;
  }
  return outputs;
}

}  // namespace homeward::recording
