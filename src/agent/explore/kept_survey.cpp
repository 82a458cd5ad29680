// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/kept_survey.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "agent/explore/exploration_report.hpp"
#include "driving/exploration_over.hpp"
#include "files/read_file.hpp"
#include "wire/scans_json.hpp"

namespace homeward::agent {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

/// As it is kept, in whole millimetres: what is explored with now is what it is after a restart.
Result<RangeSweep> as_kept(const RangeSweep& sweep) { return wire::sweep_from_json(wire::sweep_to_json(sweep)); }

/// What was seen in a picture that is kept.
Result<std::shared_ptr<const features::Appearance>> look_again(const std::filesystem::path& file,
                                                               const pipeline::Eye& eye) {
  const auto picture = files::read_picture(file);
  if (!picture) return pass_on(picture);
  auto appearance = eye.look(*picture);
  if (!appearance) return pass_on(appearance);
  return std::make_shared<const features::Appearance>(std::move(*appearance));
}

}  // namespace

Result<KeptSurvey> KeptSurvey::begin(const std::filesystem::path& root, const wire::KeptExploration& kept,
                                     const camera::CameraConfig& camera, const exploration::ExplorerConfig& config) {
  auto files = KeptFiles::create(root, kept, camera);
  if (!files) return pass_on(files);
  return KeptSurvey(std::move(*files), config);
}

Result<KeptSurvey> KeptSurvey::restore(KeptFiles files, const pipeline::Eye& eye,
                                       const exploration::ExplorerConfig& config,
                                       const std::function<bool(double)>& progress, std::optional<Error>& unread) {
  KeptSurvey kept(std::move(files), config);
  const std::size_t pictures = kept.files_.size();
  const std::vector<wire::KeptSpot> given_up = kept.files_.kept().given_up;
  for (std::size_t i = 0; i < pictures; ++i) {
    if (progress && !progress(static_cast<double>(i) / static_cast<double>(pictures))) {
      return fail(ErrorCode::kConflict, "The program ends.", kept.files_.picture(i).string());
    }
    const auto view = kept.files_.view(i);
    const auto seen = view ? look_again(kept.files_.picture(i), eye) : pass_on(view);
    if (!seen && i == 0) return pass_on(seen);
    if (!seen) {
      unread = seen.error();
      if (const Status forgotten = kept.files_.forget_from(i); !forgotten) return pass_on(forgotten);
      break;
    }
    if (view->odometry_moved) kept.survey_.go_on_anew(view->odometry_moved);
    kept.survey_.take(view->sweep, view->odometry, *seen);
    for (const wire::KeptSpot& spot : given_up)
      if (spot.view == static_cast<std::int64_t>(i)) kept.survey_.give_up_again({i, spot.seen_from_view_m});
    kept.driven_m_ = view->driven_m;
    kept.explored_s_ = view->explored_s;
  }
  kept.survey_.set_fences(kept.files_.kept().fences_m);
  kept.survey_.take_rows();  // they are of the drives before
  kept.phase_ = kept.files_.kept().ended ? ExplorationPhase::kEnded : ExplorationPhase::kPaused;
  kept.reason_ = kept.files_.kept().reason;
  return kept;
}

void KeptSurvey::take_up(const wire::ExploreOrder& order, driving::Milliseconds sensors_ms,
                         const std::optional<Pose2>& odometry_moved) {
  survey_.go_on_anew(odometry_moved);
  if (odometry_moved) odometry_moved_ = odometry_moved_ ? *odometry_moved * *odometry_moved_ : *odometry_moved;
  survey_.need_not_be_back();
  if (order.back_after_s) survey_.be_back_by(sensors_ms + std::llround(1000.0 * *order.back_after_s));
  limit_m_ = order.limit_m;
  limit_s_ = order.limit_s;
  phase_ = ExplorationPhase::kExploring;
  reason_.reset();
  odometry_.reset();
  seen_ms_.reset();
}

bool KeptSurvey::at_limit() const {
  return (limit_m_ && driven_m_ >= *limit_m_) || (limit_s_ && explored_s_ >= *limit_s_);
}

KeptSurvey::Next KeptSurvey::see(const Sensed& sensed, bool blocked) {
  if (odometry_) driven_m_ += position_m(inverse(*odometry_) * sensed.odometry).norm();
  if (seen_ms_) explored_s_ += 0.001 * static_cast<double>(std::max<std::int64_t>(0, sensed.sensors_ms - *seen_ms_));
  odometry_ = sensed.odometry;
  seen_ms_ = sensed.sensors_ms;
  if (at_limit()) survey_.end_at_limit(sensed.odometry);
  const exploration::SurveyStep step = survey_.go_on(sensed.sweep, sensed.odometry, blocked, sensed.sensors_ms);
  if (!step.ended) return {step.goal_m, step.takes_picture, std::nullopt};
  return {std::nullopt, step.takes_picture, driving::exploration_over(*step.ended, survey_.explorer().put_off())};
}

Status KeptSurvey::keep_given_up() {
  std::vector<wire::KeptSpot> given_up;
  for (const exploration::Explorer::Spot& spot : survey_.explorer().given_up())
    given_up.push_back({static_cast<std::int64_t>(spot.view), spot.seen_from_view_m});
  if (given_up == files_.kept().given_up) return {};
  wire::KeptExploration kept = files_.kept();
  kept.given_up = std::move(given_up);
  return files_.keep(kept);
}

Status KeptSurvey::take(const SensedPicture& picture) {
  auto sweep = as_kept(picture.sweep);
  if (!sweep) return pass_on(sweep);
  wire::KeptView view;
  view.t_us = picture.t_us;
  view.odometry = picture.odometry;
  view.odometry_moved = odometry_moved_;
  view.sweep = std::move(*sweep);
  view.driven_m = driven_m_;
  view.explored_s = explored_s_;
  if (Status added = files_.add(*picture.jpeg, view); !added) return added;
  odometry_moved_.reset();
  survey_.take(view.sweep, picture.odometry, picture.appearance);
  return {};
}

void KeptSurvey::pause(const std::optional<wire::Reason>& reason) {
  if (phase_ != ExplorationPhase::kExploring) return;
  phase_ = ExplorationPhase::kPaused;
  reason_ = reason;
}

Status KeptSurvey::end(const std::optional<wire::Reason>& reason) {
  if (Status written = files_.write_tables(survey_.explorer().poses()); !written) return written;
  wire::KeptExploration kept = files_.kept();
  kept.ended = true;
  kept.reason = reason;
  if (Status written = files_.keep(kept); !written) return written;
  phase_ = ExplorationPhase::kEnded;
  reason_ = reason;
  return {};
}

Status KeptSurvey::set_fences(const std::vector<wire::Fence>& fences_m) {
  survey_.set_fences(fences_m);
  wire::KeptExploration kept = files_.kept();
  kept.fences_m = fences_m;
  return files_.keep(kept);
}

Status KeptSurvey::share_with(const std::optional<ExplorationId>& companion) {
  wire::KeptExploration kept = files_.kept();
  kept.companion = companion;
  return files_.keep(kept);
}

Status KeptSurvey::uploaded(const TourId& tour) {
  wire::KeptExploration kept = files_.kept();
  kept.tour = tour;
  if (Status written = files_.keep(kept); !written) return written;
  phase_ = ExplorationPhase::kUploaded;
  return {};
}

bool KeptSurvey::soon_wants_picture() const {
  constexpr double kSoon = 0.6;  // of the way from picture to picture
  return !odometry_ || survey_.explorer().views().empty() ||
         survey_.explorer().since_picture_m(*odometry_) >= kSoon * survey_.explorer().config().picture_every_m;
}

std::optional<Pose2> KeptSurvey::floor_from_robot() const {
  if (!odometry_ || survey_.explorer().views().empty()) return std::nullopt;
  return survey_.explorer().floor_from_robot(*odometry_);
}

Pose2 KeptSurvey::odometry_of_pictures() const {
  if (survey_.explorer().views().empty()) return {};
  const Pose2& latest = odometry_ ? *odometry_ : survey_.explorer().views().back().odometry;
  return odometry_moved_ ? inverse(*odometry_moved_) * latest : latest;
}

wire::ExplorationReport KeptSurvey::report() const {
  wire::ExplorationReport report;
  report.id = files_.kept().id;
  report.phase = phase_;
  report.reason = reason_;
  report.pictures = static_cast<std::int64_t>(files_.size());
  report.driven_m = driven_m_;
  report.explored_s = explored_s_;
  report.fences_m = files_.kept().fences_m;
  report.tour = files_.kept().tour;
  report.uploaded = report.tour ? 1.0 : 0.0;
  describe(survey_.explorer(), report);
  report.pose = floor_from_robot();
  if (files_.kept().companion) report.companion = wire::SharedExploration{*files_.kept().companion, false, 0};
  if (phase_ == ExplorationPhase::kExploring) report.target_m = survey_.target_m();
  return report;
}

}  // namespace homeward::agent
