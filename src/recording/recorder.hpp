// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "driving/step.hpp"
#include "features/appearance.hpp"
#include "recording/look.hpp"
#include "recording/recording_thread.hpp"

namespace homeward::recording {

/// Records each mission of a robot in a file of its own. The driving loop never waits for the disk: a thread writes.
class Recorder {
 public:
  /// What all recordings of one robot have in common.
  struct Robot {
    std::string agent;  // "homeward-agent/" and its version
    camera::CameraConfig camera;
    features::FeatureConfig features;
    driving::DrivingConfig driving;
  };

  /// `log`: what is worth a line in a log; called from any thread. Errors: kInvalidInput (limits that cannot be), kIo.
  static Result<std::unique_ptr<Recorder>> create(const RecordingOptions& options, const Robot& robot,
                                                  std::function<void(const std::string&)> log);
  /// A recording that is open ends here, and says that the robot was still driving.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// One step of driving. Recorded from the step that takes up a mission to the one that ends it.
  /// `picture`: the bytes of the picture in `inputs`; null where there is none, or where only that one was taken is
  /// told, and not what it shows. `rows`: what whoever leads an exploration has decided since the step before.
  driving::Outputs step(driving::DrivingState& state, const driving::Inputs& inputs, const PictureBytes& picture,
                        driving::Milliseconds now_ms, std::vector<wire::StateRow> rows = {});

 private:
  Recorder(const RecordingOptions& options, Robot robot, std::function<void(const std::string&)> log);
  void begin(const driving::DrivingState& before, const driving::DrivingState& state);

  RecordingOptions options_;
  Robot robot_;
  std::string camera_json_;
  std::string features_json_;
  std::string driving_json_;
  std::string feature_config_id_;
  bool recording_ = false;
  std::int64_t seq_ = 0;
  RecordingThread thread_;
};

}  // namespace homeward::recording
