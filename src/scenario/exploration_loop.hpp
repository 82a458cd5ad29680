// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/step.hpp"
#include "exploration/survey.hpp"
#include "pipeline/eye.hpp"
#include "recording/recorder.hpp"
#include "scenario/exploration_result.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::scenario {

/// The loop of one exploration: world, sensors, survey and driving step, cycle by cycle.
class ExplorationLoop {
 public:
  /// As `explore` takes them, which must outlive it.
  ExplorationLoop(SimulatedRobot& robot, const driving::Body& body, const pipeline::Eye& eye,
                  const ExplorationPlan& plan, const std::function<double()>& clock_ms, recording::Recorder* recorder);

  /// One cycle of the scenario. False: it has ended. Errors: those of Eye::look.
  Result<bool> cycle();
  /// What came of it, once: what `so_far` tells is gone then.
  ExplorationResult finish();

  /// See Survey::set_companion.
  void set_companion(std::optional<exploration::Companion> companion) { survey_.set_companion(std::move(companion)); }
  [[nodiscard]] exploration::CompanionReport report() const { return survey_.report(robot_.odometry()); }
  [[nodiscard]] const exploration::Survey& survey() const { return survey_; }
  [[nodiscard]] const ExplorationResult& so_far() const { return result_; }

 private:
  [[nodiscard]] double clock() const { return clock_ms_ ? clock_ms_() : 0.0; }
  [[nodiscard]] double now_s() const { return 0.001 * static_cast<double>(now_ms_); }
  driving::Inputs sense();
  void drive(const driving::Inputs& inputs);
  double render_picture(const RangeSweep& sweep);
  Status look(const driving::Inputs& inputs);
  void move();

  SimulatedRobot& robot_;
  const pipeline::Eye& eye_;
  const ExplorationPlan& plan_;
  const std::function<double()>& clock_ms_;
  recording::Recorder* recorder_;
  exploration::Survey survey_;
  driving::DrivingConfig config_;
  driving::DrivingState state_;
  ExplorationResult result_;
  driving::Milliseconds now_ms_ = 0;
  std::int64_t permit_ = 1;
  bool begun_ = false;
};

}  // namespace homeward::scenario
