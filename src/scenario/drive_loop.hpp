// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "driving/step.hpp"
#include "pipeline/eye.hpp"
#include "recording/look.hpp"
#include "scenario/bystander.hpp"
#include "scenario/cycle_trace.hpp"
#include "scenario/fault_schedule.hpp"
#include "scenario/mission_result.hpp"
#include "scenario/scenario_listener.hpp"
#include "scenario/simulated_robot.hpp"

namespace homeward::recording {
class Recorder;
}

namespace homeward::scenario {

/// The cycle of the simulated server and of the robot in it, in simulated time.
inline constexpr double kScenarioCycle_s = 0.1;

/// A picture of the drive with the odometry where it was taken.
struct DrivenPicture {
  Image picture;
  Pose2 odometry;
};

/// Where a robot is put that is lifted in mid-mission. Nothing: there is no such spot.
using Elsewhere = std::function<Result<std::optional<Pose2>>()>;

/// What the server believes of a picture that the robot has recognised, where it was taken, and where the robot takes
/// itself to be.
using Believes = std::function<wire::BeliefReport(const features::Appearance&, const Pose2&,
                                                  const std::optional<wire::EstimateReport>&)>;

/// What a picture says of a path that was taught, as the camera sent it.
using SeesPath = std::function<Result<driving::PathSight>(const Image&, driving::Milliseconds, const Pose2&)>;

/// The loop of one mission: world, sensors and driving step, cycle by cycle, and the server that permits it, with all
/// that goes wrong. The robot's base brakes by itself 0.1 s after the last command.
class DriveLoop {
 public:
  /// Everything but the faults must outlive the loop. `recorder`: may be null.
  DriveLoop(SimulatedRobot& robot, const pipeline::Eye& eye, FaultSchedule faults, const driving::DrivingConfig& config,
            const ScenarioListener& listener, recording::Recorder* recorder);

  /// What a fault "kidnapped" asks where to; without it there is none.
  void kidnap_to(Elsewhere elsewhere) { elsewhere_ = std::move(elsewhere); }
  /// What is believed of the robot's recognised pictures, asked twice a second; without it nothing is.
  void ask_belief(Believes believes) { believes_ = std::move(believes); }
  /// Who answers when the robot asks whether it is at its destination, 2 s after; without it nobody does.
  void answer_by(Answers answers) { answers_ = std::move(answers); }
  /// A drive ends, wherever it is, once this says so after a cycle; without it no drive ends so.
  void end_when(std::function<bool(const CycleTrace&)> ended) { ended_ = std::move(ended); }
  /// Drives an order, numbered later than all before, until the robot stands, however that came about.
  /// `way`: where its pictures were truly taken, one for each view of its path; may be empty.
  Status run(wire::MissionOrder order, std::vector<Pose2> way = {});
  /// The same of an order to follow a path that was taught. `sees`: what its pictures are held against, each once.
  Status run(wire::RepeatOrder order, SeesPath sees);
  /// Goes on for a while after a stop and counts what moves without an order.
  Status watch();
  /// Goes on for a moment while the robot stands, and gives what the camera has shown in it: nothing while it shows
  /// nothing.
  Result<std::optional<DrivenPicture>> look_again();

  [[nodiscard]] const driving::DrivingState& state() const { return state_; }
  [[nodiscard]] int vectors() const { return vectors_; }
  [[nodiscard]] double elapsed_s() const { return 0.001 * static_cast<double>(now_ms_); }
  [[nodiscard]] std::vector<StopEvent>& stops() { return stops_; }
  [[nodiscard]] int moved_after_stop() const { return moved_after_stop_; }
  /// Whether somebody pressed stop.
  [[nodiscard]] bool stopped_by_hand() const { return stopped_by_hand_; }
  /// When the robot was lifted and put down elsewhere, the last time.
  [[nodiscard]] const std::optional<double>& kidnapped_at_s() const { return kidnapped_at_s_; }
  /// How long after that it gave up, or said that something is wrong. Nothing: never, or it took itself to have
  /// arrived.
  [[nodiscard]] const std::optional<double>& noticed_after_s() const { return noticed_after_s_; }
  /// The longest that a sure belief of the map and a sure estimate were more than 2 m apart while it drove.
  [[nodiscard]] double belief_apart_s() const { return belief_apart_s_; }
  /// About the last seconds' pictures, one a second, oldest first.
  [[nodiscard]] const std::deque<DrivenPicture>& pictures() const { return pictures_; }

 private:
  Status drive();
  Status cycle();
  Status look(driving::Inputs& inputs, recording::PictureBytes& bytes);
  Result<driving::Outputs> step_once(bool link_up);
  void receive_from_server(bool link_up);
  void answer_question();
  void place_boxes();
  Status kidnap();
  void listen_for_doubt();
  void compare_with_belief();
  void move(bool frozen);
  void close_stop();
  [[nodiscard]] bool on(wire::FaultKind kind) const { return faults_.active(kind, elapsed_s()); }
  [[nodiscard]] CycleTrace trace(const driving::Outputs& outputs) const;
  [[nodiscard]] std::optional<double> estimate_error_m() const;

  SimulatedRobot& robot_;
  const pipeline::Eye& eye_;
  FaultSchedule faults_;
  const driving::DrivingConfig& config_;
  const ScenarioListener& listener_;
  recording::Recorder* recorder_;
  MissionId mission_;
  wire::Order number_;              // of the newest order or permit
  std::vector<std::string> views_;  // names of the pictures that it homes to
  std::vector<Pose2> way_;
  SeesPath sees_path_;
  double longest_s_ = 0.0;
  Believes believes_;
  Answers answers_;
  std::function<bool(const CycleTrace&)> ended_;
  bool is_ended_ = false;
  std::int64_t answered_ = 0;                  // number of the last question that somebody heard
  driving::Milliseconds believed_ms_ = -1000;  // when the server was asked last
  driving::DrivingState state_;
  std::vector<wire::ServerMessage> messages_;
  std::vector<StopEvent> stops_;
  std::deque<DrivenPicture> pictures_;
  std::optional<DrivenPicture> newest_;
  std::vector<std::pair<std::size_t, sim::Box>> boxes_;  // by the number of their fault
  std::vector<bool> box_done_;
  std::vector<bool> lift_done_;
  Elsewhere elsewhere_;
  std::optional<double> kidnapped_at_s_;
  std::optional<double> noticed_after_s_;
  std::optional<wire::Reason> said_when_lifted_;
  std::optional<double> apart_since_s_;
  double belief_apart_s_ = 0.0;
  driving::Milliseconds now_ms_ = 0;
  double commanded_s_ = 0.0;      // the last command that reached the base
  double last_received_s_ = 0.0;  // when the server last received of the agent
  double stands_since_s_ = 0.0;
  bool stopped_by_hand_ = false;
  bool halted_ = false;  // stopped, and no order since
  int vectors_ = 0;
  int moved_after_stop_ = 0;
};

}  // namespace homeward::scenario
