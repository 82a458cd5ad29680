// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/thinker.hpp"

#include <algorithm>
#include <utility>

#include "exploration/stand_again.hpp"
#include "recording/survey_rows.hpp"
#include "wire/exploration_json.hpp"

namespace homeward::agent {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

constexpr auto kReportEvery = std::chrono::seconds(1);
constexpr int kLooksToStandAgain = 5;                          // pictures
constexpr int kMostUnmatched = 30;                             // pictures
constexpr auto kTellsBeforeUpload = std::chrono::seconds(15);  // at most: the companion what it lacks
constexpr double kLegShare = 0.6;  // of the distance at which a place counts as reached: the leg goes on to that

TimeUs now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Of one whose survey is not in memory.
wire::ExplorationReport report_of(const KeptFiles& files, ExplorationPhase phase) {
  wire::ExplorationReport report;
  report.id = files.kept().id;
  report.phase = phase;
  report.reason = files.kept().reason;
  report.pictures = static_cast<std::int64_t>(files.size());
  report.fences_m = files.kept().fences_m;
  if (files.kept().companion) report.companion = wire::SharedExploration{*files.kept().companion, false, 0};
  return report;
}

}  // namespace

void Thinker::restore(KeptFiles files, const Tell& tell, const std::stop_token& stop) {
  said_.exploration = files.kept().id;
  said_.report = report_of(files, ExplorationPhase::kWaiting);
  tell(said_);
  said_.report.reset();
  std::optional<Error> unread;
  auto restored = KeptSurvey::restore(
      files, eye_, options_.explorer, [&](double) { return !stop.stop_requested(); }, unread);
  odometry_epoch_.reset();
  if (unread) options_.log("from there on it cannot be read: " + unread->message + " " + unread->where);
  if (restored) {
    current_ = std::move(*restored);
  } else if (!stop.stop_requested()) {
    options_.log("that exploration cannot be read: " + restored.error().message + " " + restored.error().where);
    said_.exploration.reset();
    said_.report = report_of(files, ExplorationPhase::kUploaded);
    said_.report->reason =
        wire::reason_with(ReasonCode::kExplorationBroken, "because", wire::reason_of(restored.error()));
    tell(said_);
    said_.report.reset();
  }
}

void Thinker::take_up_kept(const Tell& tell, const std::stop_token& stop) {
  std::vector<Error> unread;
  std::deque<KeptFiles> open;
  for (KeptFiles& files : KeptFiles::not_uploaded(options_.folder, unread))
    (files.kept().ended ? to_upload_ : open).push_back(std::move(files));
  for (const Error& error : unread) options_.log("an exploration is passed over: " + error.message + " " + error.where);
  for (; !open.empty() && !stop.stop_requested(); open.pop_front()) {
    options_.log("goes on from exploration " + open.front().kept().id.str() + " with " +
                 std::to_string(open.front().size()) + " pictures");
    restore(open.front(), tell, stop);
    // It goes on with the newest; what was begun before and never ended is ended.
    if (open.size() == 1 || !current_) continue;
    if (const Status ended = end_current(wire::Reason{ReasonCode::kExplorationEndedByHand}); !ended)
      options_.log("an exploration cannot be ended: " + ended.error().message + " " + ended.error().where);
    current_.reset();
  }
  if (current_) tell_now(tell, true);
}

void Thinker::think(const ToThinker& mail, const Tell& tell, const std::stop_token& stop) {
  for (const ExploringCommand& command : mail.commands) std::visit([this](const auto& what) { obey(what); }, command);
  if (mail.commands.empty()) {
    share(mail);
  } else {
    // What it voids must not be driven on while a picture of the companion is looked at.
    sharing_.hear(mail.companion);
  }
  if (order_ && !said_.over && mail.commands.empty() && !mail.only_heard) explore(mail);
  if (current_) said_.rows = recording::to_recorded(current_->take_rows());
  tell_now(tell, !mail.commands.empty());
  const bool idle = !order_ || said_.over;
  if (idle && mail.link_up && !to_upload_.empty() && options_.now() - tried_upload_at_ >= options_.upload_again_after &&
      may_upload())
    upload(tell, stop);
}

/// What goes to and fro between the robots that explore together.
void Thinker::share(const ToThinker& mail) {
  const auto before = sharing_.progress();
  const bool drives = order_ && taken_up_ && !said_.over;
  sharing_.hear(mail.companion);
  auto to_say = sharing_.share(current_ ? &*current_ : nullptr, drives, options_.now());
  if (mail.link_up) said_.to_companion = std::move(to_say);
  const auto& now = sharing_.progress();
  if (now && (!before || before->joined != now->joined || before->pictures != now->pictures)) changed_ = true;
}

/// An upload takes a while in which nothing is told.
bool Thinker::may_upload() const {
  return !current_ || !sharing_.has_more_to_tell(*current_, options_.now()) ||
         options_.now() - ended_at_ >= kTellsBeforeUpload;
}

wire::ExplorationReport Thinker::report_of_current() const {
  wire::ExplorationReport report = current_->report();
  const auto& progress = sharing_.progress();
  if (report.companion && progress && progress->exploration == report.companion->exploration)
    report.companion = progress;
  return report;
}

void Thinker::obey(const OrderObeyed& obeyed) {
  order_ = obeyed.order;
  obeyed_ms_ = obeyed.sensors_ms;
  said_.mission = obeyed.order.mission;
  said_.odometry_epoch = obeyed.odometry_epoch;
  said_.leg.reset();
  said_.over.reset();
  wants_picture_since_ms_.reset();
  taken_up_ = false;
  looked_ = unmatched_ = 0;
  changed_ = true;
  const bool has_it =
      current_ && !current_->files().kept().ended && current_->files().kept().id == obeyed.order.exploration;
  if (obeyed.order.goes_on) {
    if (!has_it) end_by({true, wire::Reason{ReasonCode::kExplorationUnknown}});
    return;
  }
  if (current_ && !current_->files().kept().ended) {
    if (const Status ended = end_current(wire::Reason{ReasonCode::kExplorationEndedByHand}); !ended)
      return broken(ended.error());
  }
  auto begun = KeptSurvey::begin(options_.folder, {obeyed.order.exploration, now_us(), {}, {}, false, {}, {}}, camera_,
                                 options_.explorer);
  if (!begun) return broken(begun.error());
  current_ = std::move(*begun);
  said_.exploration = obeyed.order.exploration;
  odometry_epoch_ = obeyed.odometry_epoch;
}

void Thinker::obey(const OrderEnded& ended) {
  if (!order_) return;
  // Its own end has been dealt with.
  if (current_ && !said_.over) current_->pause(ended.reason);
  order_.reset();
  said_.leg.reset();
  said_.over.reset();
  said_.wants_features = false;
  changed_ = true;
}

void Thinker::obey(const wire::Fences& fences) {
  const bool knows_it = current_ && current_->files().kept().id == fences.exploration;
  if (!knows_it || current_->files().kept().ended) return;
  said_.leg.reset();  // it may lead over one
  changed_ = true;
  const Status set = current_->set_fences(fences.fences_m);
  if (set) return;
  // It keeps off them now, and would not after a restart.
  if (order_) return broken(set.error());
  options_.log("fences are not kept: " + set.error().message + " " + set.error().where);
}

void Thinker::obey(const wire::Finish& finish) {
  const bool knows_it = current_ && current_->files().kept().id == finish.exploration;
  if (!knows_it || current_->files().kept().ended) return;
  if (order_ && !said_.over) return;  // it explores, or is about to
  if (const Status ended = end_current(wire::Reason{ReasonCode::kExplorationEndedByHand}); !ended)
    options_.log("the exploration cannot be ended: " + ended.error().message + " " + ended.error().where);
  changed_ = true;
}

void Thinker::obey(const wire::Companion& companion) {
  if (!current_ || current_->files().kept().id != companion.exploration) return;
  if (companion.with == companion.exploration) return;
  if (const Status kept = current_->share_with(companion.with); !kept)
    options_.log("with whom is explored is not kept: " + kept.error().message + " " + kept.error().where);
  changed_ = true;
}

/// It stands, says why, and can go on once what was wrong is mended.
void Thinker::broken(const Error& error) {
  options_.log("the exploration cannot go on: " + error.message + " " + error.where);
  end_by({true, wire::reason_with(ReasonCode::kExplorationBroken, "because", wire::reason_of(error))});
}

void Thinker::end_by(const driving::ExplorationOver& over) {
  said_.leg.reset();
  said_.over = over;
  said_.wants_features = false;
  changed_ = true;
  if (!current_) return;
  if (over.failed) return current_->pause(over.reason);
  if (const Status ended = end_current(over.reason); !ended) broken(ended.error());
}

Status Thinker::end_current(const std::optional<wire::Reason>& reason) {
  ended_at_ = options_.now();
  if (Status ended = current_->end(reason); !ended) return ended;
  said_.exploration.reset();
  if (current_->files().size() > 0) {
    to_upload_.push_back(current_->files());
    return {};
  }
  // There is nothing that could be a tour.
  if (const Status removed = current_->files().remove(); !removed) options_.log(removed.error().message);
  current_->nothing_to_upload();
  return {};
}

/// Where the robot stands, before an order is followed.
void Thinker::take_up(const ToThinker& mail) {
  const exploration::Explorer& explorer = current_->survey().explorer();
  if (odometry_epoch_ == mail.odometry_epoch || explorer.views().empty()) {
    odometry_epoch_ = said_.odometry_epoch = mail.odometry_epoch;
    current_->take_up(*order_, obeyed_ms_, std::nullopt);
    taken_up_ = true;
    return;
  }
  said_.wants_features = true;
  if (!mail.picture) return;
  const auto sweep = sweep_of_picture(mail.sweeps, mail.picture->seen);
  std::optional<Pose2> floor_from_robot;
  if (sweep) floor_from_robot = exploration::stand_again(explorer, *sweep, *mail.picture->seen.appearance);
  if (!floor_from_robot) {
    if (++looked_ >= kLooksToStandAgain) end_by({true, wire::Reason{ReasonCode::kRobotMovedSince}});
    return;
  }
  const Pose2 said_before = explorer.views().back().odometry * inverse(explorer.poses().back()) * *floor_from_robot;
  current_->take_up(*order_, obeyed_ms_, mail.picture->seen.odometry * inverse(said_before));
  odometry_epoch_ = said_.odometry_epoch = mail.odometry_epoch;
  taken_up_ = true;
}

/// The picture that is wanted, once there is one with a sweep of its time.
void Thinker::take_picture(const ToThinker& mail) {
  if (!wants_picture_since_ms_ || !mail.picture) return;
  if (mail.picture->seen.taken_ms < *wants_picture_since_ms_) return;
  const auto sweep = sweep_of_picture(mail.sweeps, mail.picture->seen);
  if (!sweep) {
    if (++unmatched_ < kMostUnmatched) return;
    return broken({ErrorCode::kIo, "Pictures come so late that no sweep of their time is known any more.", "camera"});
  }
  unmatched_ = 0;
  wants_picture_since_ms_.reset();
  const Status taken = current_->take(
      {*sweep, mail.picture->seen.odometry, mail.picture->seen.appearance, mail.picture->bytes, now_us()});
  if (!taken) return broken(taken.error());
  sharing_.took_picture(*current_, options_.now());
}

void Thinker::explore(const ToThinker& mail) {
  if (!current_ || mail.sweeps.empty()) return;
  changed_ = true;
  if (!taken_up_) return take_up(mail);
  if (odometry_epoch_ != mail.odometry_epoch)
    return end_by({true, wire::Reason{ReasonCode::kRobotMovedSince}});  // it sees where it stands when it is sent on
  const Sensed& sensed = mail.sweeps.back();
  const KeptSurvey::Next next = current_->see(sensed, mail.blocked);
  if (const Status kept = current_->keep_given_up(); !kept) return broken(kept.error());
  said_.leg.reset();
  if (next.goal_m) said_.leg = driving::Leg{*next.goal_m, kLegShare * exploration::SurveyConfig{}.there_m};
  if (next.takes_picture && !wants_picture_since_ms_) wants_picture_since_ms_ = sensed.sensors_ms;
  take_picture(mail);
  if (said_.over) return;
  said_.wants_features = wants_picture_since_ms_.has_value() || current_->soon_wants_picture();
  if (next.over) end_by(*next.over);
}

void Thinker::upload(const Tell& tell, const std::stop_token& stop) {
  KeptFiles files = std::move(to_upload_.front());
  to_upload_.pop_front();
  const bool is_current = current_ && current_->files().kept().id == files.kept().id;
  // Of one that is over nothing is told while there is one to go on with.
  const bool is_told = is_current || !current_ || current_->files().kept().ended;
  auto report = is_current ? report_of_current() : report_of(files, ExplorationPhase::kEnded);
  report.reason = files.kept().reason;
  const auto tell_report = [&] {
    if (is_told) said_.report = report;
    told_at_ = options_.now();
    tell(said_);
    said_.report.reset();
  };
  said_.uploads = true;
  tell_report();
  const auto tour = options_.upload(files, "Exploration " + files.kept().id.str(), [&](double share) {
    report.uploaded = std::clamp(share, 0.0, 1.0);
    if (options_.now() - told_at_ >= kReportEvery) tell_report();
    return !stop.stop_requested();
  });
  said_.uploads = false;
  tried_upload_at_ = options_.now();
  if (!tour) {
    options_.log("the pictures of an exploration do not get to the server: " + tour.error().message);
    report.reason = wire::reason_with(ReasonCode::kExplorationNotUploaded, "because", wire::reason_of(tour.error()));
    to_upload_.push_back(std::move(files));  // others first
  } else {
    wire::KeptExploration kept = files.kept();
    kept.tour = *tour;
    if (const Status written = is_current ? current_->uploaded(*tour) : files.keep(kept); !written)
      options_.log("that an exploration is on the server cannot be noted: " + written.error().message);
    tried_upload_at_ = {};
    report.phase = ExplorationPhase::kUploaded;
    report.tour = *tour;
    report.uploaded = 1.0;
  }
  changed_ = false;
  tell_report();
}

void Thinker::tell_now(const Tell& tell, bool forced) {
  const bool due = changed_ && (forced || said_.over || options_.now() - told_at_ >= kReportEvery);
  if (due && current_) {
    said_.report = report_of_current();
    if (order_ && !taken_up_ && !said_.over) said_.report->phase = ExplorationPhase::kWaiting;
    changed_ = false;
    told_at_ = options_.now();
  }
  tell(said_);
  said_.report.reset();
  said_.rows.clear();
  said_.to_companion.clear();
}

}  // namespace homeward::agent
