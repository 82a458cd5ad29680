// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/thinker.hpp"

#include <algorithm>
#include <utility>

#include "exploration/stand_again.hpp"
#include "wire/exploration_json.hpp"

namespace homeward::agent {
namespace {

using wire::ExplorationPhase;
using wire::ReasonCode;

constexpr auto kReportEvery = std::chrono::seconds(1);
constexpr int kLooksToStandAgain = 5;  // pictures
constexpr double kLegShare = 0.6;      // of the distance at which a place counts as reached: the leg goes on to that

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
  return report;
}

}  // namespace

void Thinker::take_up_kept(const Tell& tell, const std::stop_token& stop) {
  std::vector<Error> unread;
  std::vector<KeptFiles> kept = KeptFiles::not_uploaded(options_.folder, unread);
  for (const Error& error : unread) options_.log("an exploration is passed over: " + error.message + " " + error.where);
  std::optional<KeptFiles> open;
  for (KeptFiles& files : kept) {
    if (files.kept().ended) {
      to_upload_.push_back(std::move(files));
    } else {
      open = std::move(files);
    }
  }
  if (!open) return;
  options_.log("goes on from exploration " + open->kept().id.str() + " with " + std::to_string(open->size()) +
               " pictures");
  said_.exploration = open->kept().id;
  said_.report = report_of(*open, ExplorationPhase::kWaiting);
  tell(said_);
  auto restored =
      KeptSurvey::restore(std::move(*open), eye_, options_.explorer, [&](double) { return !stop.stop_requested(); });
  said_.report.reset();
  if (restored) {
    current_ = std::move(*restored);
    odometry_goes_on_ = false;
  } else if (!stop.stop_requested()) {
    options_.log("that exploration cannot be read: " + restored.error().message + " " + restored.error().where);
    said_.exploration.reset();
  }
  tell_now(tell, true);
}

void Thinker::think(const ToThinker& mail, const Tell& tell, const std::stop_token& stop) {
  for (const ExploringCommand& command : mail.commands) std::visit([this](const auto& what) { obey(what); }, command);
  if (order_ && !said_.over && mail.commands.empty()) explore(mail);
  tell_now(tell, !mail.commands.empty());
  const bool idle = !order_ || said_.over;
  if (idle && mail.link_up && !to_upload_.empty() && Clock::now() - tried_upload_at_ >= options_.upload_again_after)
    upload(tell, stop);
}

void Thinker::obey(const OrderObeyed& obeyed) {
  order_ = obeyed.order;
  said_.mission = obeyed.order.mission;
  said_.leg.reset();
  said_.over.reset();
  wants_picture_since_ms_.reset();
  taken_up_ = false;
  looked_ = 0;
  if (std::exchange(displaced_, obeyed.displaced) != obeyed.displaced) odometry_goes_on_ = false;
  changed_ = true;
  if (obeyed.order.goes_on && current_) return;
  if (current_) obey(wire::Finish{current_->files().kept().id});
  auto begun = KeptSurvey::begin(options_.folder, {obeyed.order.exploration, now_us(), {}, false, {}, {}}, camera_,
                                 options_.explorer);
  if (!begun) return broken(begun.error());
  current_ = std::move(*begun);
  said_.exploration = obeyed.order.exploration;
  odometry_goes_on_ = true;
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
  if (!current_ || current_->files().kept().id != fences.exploration) return;
  if (const Status set = current_->set_fences(fences.fences_m); !set) options_.log("no fence: " + set.error().message);
  changed_ = true;
}

void Thinker::obey(const wire::Finish& finish) {
  const bool knows_it = current_ && current_->files().kept().id == finish.exploration;
  if (!knows_it || current_->files().kept().ended) return;
  if (order_ && taken_up_ && said_.exploration == finish.exploration) return;  // it explores
  if (const Status ended = current_->end(wire::Reason{ReasonCode::kExplorationEndedByHand}); !ended)
    return options_.log("the exploration cannot be ended: " + ended.error().message + " " + ended.error().where);
  to_upload_.push_back(current_->files());
  said_.exploration.reset();
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
  if (const Status ended = current_->end(over.reason); !ended) return broken(ended.error());
  to_upload_.push_back(current_->files());
  said_.exploration.reset();
}

/// Where the robot stands, before an order is followed.
void Thinker::take_up(const ToThinker& mail) {
  const driving::Milliseconds now_ms = mail.sweeps.back().sensors_ms;
  const exploration::Explorer& explorer = current_->survey().explorer();
  if (odometry_goes_on_ || explorer.views().empty()) {
    current_->take_up(*order_, now_ms, std::nullopt);
    taken_up_ = true;
    return;
  }
  said_.wants_features = true;
  if (!mail.picture) return;
  const auto sweep = sweep_of_picture(mail.sweeps, mail.picture->seen);
  if (!sweep) return;
  const auto floor_from_robot = exploration::stand_again(explorer, *sweep, *mail.picture->seen.appearance);
  if (!floor_from_robot) {
    if (++looked_ >= kLooksToStandAgain) end_by({true, wire::Reason{ReasonCode::kRobotMovedSince}});
    return;
  }
  const Pose2 said_before = explorer.views().back().odometry * inverse(explorer.poses().back()) * *floor_from_robot;
  current_->take_up(*order_, now_ms, mail.picture->seen.odometry * inverse(said_before));
  taken_up_ = odometry_goes_on_ = true;
}

void Thinker::explore(const ToThinker& mail) {
  if (!current_ || mail.sweeps.empty()) return;
  changed_ = true;
  if (!taken_up_) return take_up(mail);
  const Sensed& sensed = mail.sweeps.back();
  const KeptSurvey::Next next = current_->see(sensed);
  said_.leg.reset();
  if (next.goal_m) said_.leg = driving::Leg{*next.goal_m, kLegShare * exploration::SurveyConfig{}.there_m};
  if (next.takes_picture && !wants_picture_since_ms_) wants_picture_since_ms_ = sensed.sensors_ms;
  if (wants_picture_since_ms_ && mail.picture && mail.picture->seen.taken_ms >= *wants_picture_since_ms_) {
    if (const auto sweep = sweep_of_picture(mail.sweeps, mail.picture->seen)) {
      wants_picture_since_ms_.reset();
      const Status taken = current_->take(
          {*sweep, mail.picture->seen.odometry, mail.picture->seen.appearance, mail.picture->bytes, now_us()});
      if (!taken) return broken(taken.error());
    }
  }
  said_.wants_features = wants_picture_since_ms_.has_value() || current_->soon_wants_picture();
  if (next.over) end_by(*next.over);
}

void Thinker::upload(const Tell& tell, const std::stop_token& stop) {
  const KeptFiles files = to_upload_.front();
  const bool is_current = current_ && current_->files().kept().id == files.kept().id;
  auto report = is_current ? current_->report() : report_of(files, ExplorationPhase::kEnded);
  report.reason = files.kept().reason;
  said_.uploads = true;
  const auto show = [&](double share) {
    report.uploaded = std::clamp(share, 0.0, 1.0);
    if (stop.stop_requested() || Clock::now() - told_at_ < kReportEvery) return;
    told_at_ = Clock::now();
    said_.report = report;
    tell(said_);
  };
  show(0.0);
  const auto tour = options_.upload(files.tour_folder(), "Exploration " + files.kept().id.str(), show);
  said_.uploads = false;
  tried_upload_at_ = Clock::now();
  if (!tour) {
    options_.log("the pictures of an exploration do not get to the server: " + tour.error().message);
    report.reason = wire::reason_with(ReasonCode::kExplorationNotUploaded, "because", wire::reason_of(tour.error()));
  } else {
    wire::KeptExploration kept = files.kept();
    kept.tour = *tour;
    KeptFiles done = files;
    if (const Status written = is_current ? current_->uploaded(*tour) : done.keep(kept); !written)
      options_.log("that an exploration is on the server cannot be noted: " + written.error().message);
    to_upload_.pop_front();
    tried_upload_at_ = {};
    report.phase = ExplorationPhase::kUploaded;
    report.tour = *tour;
    report.uploaded = 1.0;
  }
  told_at_ = Clock::now();
  changed_ = false;
  said_.report = report;
  tell(said_);
  said_.report.reset();
}

void Thinker::tell_now(const Tell& tell, bool forced) {
  const bool due = changed_ && (forced || said_.over || Clock::now() - told_at_ >= kReportEvery);
  if (due && current_) {
    said_.report = current_->report();
    if (order_ && !taken_up_ && !said_.over) said_.report->phase = ExplorationPhase::kWaiting;
    changed_ = false;
    told_at_ = Clock::now();
  }
  tell(said_);
  said_.report.reset();
}

}  // namespace homeward::agent
