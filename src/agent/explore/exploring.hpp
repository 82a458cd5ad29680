// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "agent/explore/exploring_mail.hpp"
#include "agent/explore/thinker.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"
#include "files/folder_lock.hpp"
#include "recording/look.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// Leads a robot through explorations for the loop that drives it. It thinks, and writes to disk, in a thread of its
/// own (Thinker): the loop never waits for it. All but the destructor are called by the loop.
class Exploring {
 public:
  /// `eye` has to outlive it. Errors: kIo (the folder cannot be made), kConflict
  /// (another program explores into it).
  static Result<std::unique_ptr<Exploring>> create(ThinkerOptions options, const camera::CameraConfig& camera,
                                                   const pipeline::Eye& eye);
  ~Exploring();
  Exploring(const Exploring&) = delete;
  Exploring& operator=(const Exploring&) = delete;

  /// Before a step: adds where to drive, that it is over, and why an order to explore is refused.
  void prepare(driving::Inputs& inputs, const driving::DrivingState& state) const;
  /// After it: what was ordered and obeyed, and what the sensors said. `picture`: the bytes of the inputs' picture.
  /// `now_ms`: of the step.
  void follow(const driving::Inputs& inputs, const recording::PictureBytes& picture, const driving::DrivingState& state,
              driving::Milliseconds now_ms);
  /// What the companion told (take_from_companion). Of much at once the oldest is lost.
  void hear(std::vector<FromCompanion> told);
  /// Whether a picture with its features is of use now.
  [[nodiscard]] bool wants_features() const;
  /// How far it is, as a message of the link (wire::Explored, encoded), where that is new or the server has welcomed
  /// the robot since; null otherwise.
  std::shared_ptr<const std::vector<std::uint8_t>> take_report();
  /// What the companion is to be told, encoded, since this was called last.
  std::vector<std::vector<std::uint8_t>> take_to_companion();
  /// The rows of the table of states since this was called last, for a recording: before the step.
  std::vector<wire::StateRow> take_rows();

 private:
  Exploring(files::FolderLock lock, ThinkerOptions options, const camera::CameraConfig& camera,
            const pipeline::Eye& eye);
  void run(const std::stop_token& stop);
  void note_orders(const driving::Inputs& inputs, const driving::DrivingState& state);
  void watch_odometry(const driving::Inputs& inputs, const driving::DrivingState& state, driving::Milliseconds now_ms);
  [[nodiscard]] bool odometry_goes_on(const driving::Inputs& inputs, const driving::DrivingState& state,
                                      driving::Milliseconds now_ms) const;
  [[nodiscard]] std::optional<wire::Reason> why_not(const wire::ExploreOrder& order) const;

  files::FolderLock lock_;  // of the folder
  Thinker thinker_;         // the thread's
  // The loop's own:
  std::optional<MissionId> followed_;
  std::deque<std::pair<driving::Milliseconds, Pose2>> odometry_;  // of the last second
  int odometry_epoch_ = 0;
  int displaced_ = 0;
  std::optional<driving::Milliseconds> step_ms_;   // of the latest step, and by the sensors' clock of its
  std::optional<driving::Milliseconds> sweep_ms_;  // latest sweep
  bool welcomed_ = false;                          // since a report was asked for last

  mutable std::mutex mutex_;  // of the mails
  std::condition_variable_any came_;
  ToThinker to_;
  bool new_sweep_ = false;
  FromThinker from_;                                             // but for the report
  std::shared_ptr<const std::vector<std::uint8_t>> new_report_;  // encoded, and not sent yet
  std::shared_ptr<const std::vector<std::uint8_t>> told_;        // the latest that was sent, for who is welcomed anew
  std::jthread thread_;                                          // last: it uses all of the above
};

}  // namespace homeward::agent
