// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "agent/explore/kept_files.hpp"
#include "driving/inputs.hpp"
#include "exploration/survey.hpp"
#include "features/appearance.hpp"
#include "pipeline/eye.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// What the sensors say at one moment of an exploration.
struct Sensed {
  driving::Milliseconds sensors_ms = 0;
  RangeSweep sweep;
  Pose2 odometry;
};

/// A picture with a sweep of the same moment.
struct SensedPicture {
  RangeSweep sweep;  // as from where the picture was taken
  Pose2 odometry;
  std::shared_ptr<const features::Appearance> appearance;
  std::shared_ptr<const std::vector<std::uint8_t>> jpeg;
  TimeUs t_us = 0;
};

/// An exploration whose every picture is on disk before it counts: a survey, its files, its limits, and how far it is.
/// Used by one thread.
class KeptSurvey {
 public:
  /// A new one. Errors: those of KeptFiles::create.
  static Result<KeptSurvey> begin(const std::filesystem::path& root, const wire::KeptExploration& kept,
                                  const camera::CameraConfig& camera, const exploration::ExplorerConfig& config);
  /// As it was kept, picture by picture, up to the first that cannot be read (`unread`); `progress` hears the share
  /// that was read, and false ends it (kConflict). Errors: also why the very first picture cannot be read.
  static Result<KeptSurvey> restore(KeptFiles files, const pipeline::Eye& eye,
                                    const exploration::ExplorerConfig& config,
                                    const std::function<bool(double)>& progress, std::optional<Error>& unread);

  /// Takes up an order that came at `sensors_ms`. `odometry_moved`: Explorer::move_odometry, where odometry says no
  /// more where it stands.
  void take_up(const wire::ExploreOrder& order, driving::Milliseconds sensors_ms,
               const std::optional<Pose2>& odometry_moved);
  /// What is to be done now; while an order is followed.
  struct Next {
    std::optional<Eigen::Vector2d> goal_m;  // odometry's frame
    bool takes_picture = false;
    std::optional<driving::ExplorationOver> over;
  };
  /// `blocked`: the robot does not get on to the leg's goal.
  Next see(const Sensed& sensed, bool blocked);
  /// The places that are given up are on disk. To be called after `see`; what a picture takes back is written with the
  /// next. It writes where that is new. Errors: kIo; then what was kept before stays.
  Status keep_given_up();
  /// The picture that was asked for. Errors: kIo, kInvalidInput (a sweep that could not be read again); then it is as
  /// if there had been none.
  Status take(const SensedPicture& picture);
  /// See Survey::take_rows.
  std::vector<exploration::SurveyRow> take_rows() { return survey_.take_rows(); }
  /// It stands, and may go on later.
  void pause(const std::optional<wire::Reason>& reason);
  /// Nothing more is explored: its tables are written, and its pictures may go to the server. Errors: kIo.
  Status end(const std::optional<wire::Reason>& reason);
  /// They hold from now on. Errors: kIo; then they do not outlive a restart.
  Status set_fences(const std::vector<wire::Fence>& fences_m);
  /// It is shared with that exploration of another robot from now on; nothing: with none. Errors: kIo; then it is as
  /// before.
  Status share_with(const std::optional<ExplorationId>& companion);
  /// See Survey::set_companion.
  void set_companion(std::optional<exploration::Companion> companion) { survey_.set_companion(std::move(companion)); }
  /// It has ended without a picture.
  void nothing_to_upload() { phase_ = wire::ExplorationPhase::kUploaded; }
  /// Its pictures are on the server. Errors: kIo.
  Status uploaded(const TourId& tour);

  [[nodiscard]] const KeptFiles& files() const { return files_; }
  [[nodiscard]] const exploration::Survey& survey() const { return survey_; }
  [[nodiscard]] wire::ExplorationReport report() const;
  /// Where the robot is on its floor; nothing: not known.
  [[nodiscard]] std::optional<Pose2> floor_from_robot() const;
  /// Its odometry, as it would have gone on from the newest picture.
  [[nodiscard]] Pose2 odometry_of_pictures() const;
  /// Whether a picture will be wanted before long: it may take a moment to be ready.
  [[nodiscard]] bool soon_wants_picture() const;

 private:
  KeptSurvey(KeptFiles files, const exploration::ExplorerConfig& config)
      : files_(std::move(files)), survey_(config, {}) {}
  [[nodiscard]] bool at_limit() const;

  KeptFiles files_;
  exploration::Survey survey_;
  wire::ExplorationPhase phase_ = wire::ExplorationPhase::kPaused;
  std::optional<wire::Reason> reason_;
  std::optional<double> limit_m_;
  std::optional<double> limit_s_;
  std::optional<Pose2> odometry_moved_;  // since the last picture
  std::optional<Pose2> odometry_;        // the latest
  std::optional<driving::Milliseconds> seen_ms_;
  double driven_m_ = 0.0;
  double explored_s_ = 0.0;
};

}  // namespace homeward::agent
