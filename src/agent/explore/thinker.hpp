// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "agent/explore/exploring_mail.hpp"
#include "agent/explore/kept_survey.hpp"
#include "agent/explore/sharing.hpp"
#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "exploration/explorer.hpp"
#include "pipeline/eye.hpp"

namespace homeward::agent {

struct ThinkerOptions {
  std::filesystem::path folder;  // of all explorations
  exploration::ExplorerConfig explorer;
  /// Brings the pictures to the server as a tour of that name; tells the share that is there, and ends where that gives
  /// false. It is tried again after a while where it fails.
  std::function<Result<TourId>(const KeptFiles& kept, const std::string& name,
                               const std::function<bool(double)>& progress)>
      upload;
  std::function<void(const std::string&)> log;
  std::chrono::milliseconds upload_again_after{10'000};
  /// The steady clock, but in tests.
  std::function<std::chrono::steady_clock::time_point()> now = [] { return std::chrono::steady_clock::now(); };
};

/// Explores as it is ordered, and brings what was explored to the server: everything about explorations but driving. It
/// is used by one thread, and may think for a while. What it kept and the server has not got is taken up where it was;
/// nothing drives before an order comes.
class Thinker {
 public:
  using Tell = std::function<void(const FromThinker&)>;

  /// `eye` has to outlive it.
  Thinker(ThinkerOptions options, camera::CameraConfig camera, const pipeline::Eye& eye)
      : options_(std::move(options)),
        camera_(std::move(camera)),
        eye_(eye),
        sharing_(options_.explorer, options_.log) {}

  /// At first: what is on disk. It tells what it does while it does so.
  void take_up_kept(const Tell& tell, const std::stop_token& stop);
  /// What came, one after the other.
  void think(const ToThinker& mail, const Tell& tell, const std::stop_token& stop);

 private:
  using Clock = std::chrono::steady_clock;

  void obey(const OrderObeyed& obeyed);
  void obey(const OrderEnded& ended);
  void obey(const wire::Fences& fences);
  void obey(const wire::Finish& finish);
  void obey(const wire::Companion& companion);
  void share(const ToThinker& mail);
  [[nodiscard]] bool may_upload() const;
  [[nodiscard]] wire::ExplorationReport report_of_current() const;
  void explore(const ToThinker& mail);
  void take_up(const ToThinker& mail);
  void take_picture(const ToThinker& mail);
  void end_by(const driving::ExplorationOver& over);
  /// Of the present one nothing more is explored. Errors: kIo; then it stays as it is.
  Status end_current(const std::optional<wire::Reason>& reason);
  void restore(KeptFiles files, const Tell& tell, const std::stop_token& stop);
  void broken(const Error& error);
  void upload(const Tell& tell, const std::stop_token& stop);
  void tell_now(const Tell& tell, bool forced);

  ThinkerOptions options_;
  camera::CameraConfig camera_;
  const pipeline::Eye& eye_;
  std::optional<KeptSurvey> current_;
  Sharing sharing_;  // of the current one
  std::deque<KeptFiles> to_upload_;
  std::optional<wire::ExploreOrder> order_;  // that is followed
  bool taken_up_ = false;                // the survey follows it; else it is still looked for where the robot stands
  int looked_ = 0;                       // pictures by which that was tried
  std::optional<int> odometry_epoch_;    // that the poses of `current_` are of; nothing: of none that goes on
  driving::Milliseconds obeyed_ms_ = 0;  // when the order came, by the sensors' clock
  int unmatched_ = 0;                    // pictures without a sweep of their time, in a row
  std::optional<driving::Milliseconds> wants_picture_since_ms_;
  FromThinker said_;
  bool changed_ = true;
  Clock::time_point told_at_;
  Clock::time_point tried_upload_at_;
  Clock::time_point ended_at_;  // the latest exploration
};

}  // namespace homeward::agent
