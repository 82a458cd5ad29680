// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/sharing.hpp"

#include <algorithm>
#include <utility>

#include "wire/appearance_blob.hpp"

namespace homeward::agent {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMostWaiting = 8;                // pictures
constexpr std::size_t kMostTold_bytes = 200UL * 1024;  // of features; the server passes no larger picture on
constexpr auto kInformedEvery = milliseconds(500);
constexpr auto kSaidEvery = milliseconds(500);           // while anything changes
constexpr auto kSaidStandingEvery = milliseconds(3000);  // else
constexpr auto kComplainsEvery = std::chrono::seconds(10);

std::int64_t in_ms(Sharing::Time time) {
  return std::chrono::duration_cast<milliseconds>(time.time_since_epoch()).count();
}

const exploration::Explorer& explorer_of(const KeptSurvey& ours) { return ours.survey().explorer(); }

std::int64_t pictures_of(const KeptSurvey& ours) { return static_cast<std::int64_t>(explorer_of(ours).views().size()); }

}  // namespace

void Sharing::complain(const std::string& what, Time now) {
  if (complained_at_ && now - *complained_at_ < kComplainsEvery) return;
  complained_at_ = now;
  log_(what);
}

/// Begins anew where it is another exploration, of ours or of the other robot.
void Sharing::turn_to(KeptSurvey* ours) {
  const std::optional<ExplorationId> with = ours != nullptr ? ours->files().kept().companion : std::nullopt;
  const bool same = companion_ ? with == companion_->exploration() && ours->files().kept().id == ours_ : !with;
  if (same) return;
  if (ours != nullptr) ours->set_companion(std::nullopt);
  companion_.reset();
  told_ = PicturesTold();
  views_.clear();
  progress_.reset();
  informed_at_.reset();
  said_at_.reset();
  said_has_ = 0;
  if (!with) return;
  ours_ = ours->files().kept().id;
  companion_.emplace(*with, explorer_);
  progress_ = wire::SharedExploration{*with, false, 0};
}

void Sharing::hear(std::vector<FromCompanion> told) {
  for (FromCompanion& one : told) {
    const auto id = std::visit([](const auto& what) { return what.exploration; }, one.what);
    if (!companion_ || id != companion_->exploration()) {
      complain("what comes of an exploration that is not shared is passed over: " + id.str(), one.came);
    } else if (const auto* state = std::get_if<wire::CompanionState>(&one.what)) {
      take_in(*state, one.came);
    } else if (views_.size() < kMostWaiting) {
      views_.push_back(std::move(std::get<wire::CompanionView>(one.what)));
    }
  }
}

void Sharing::take_in(const wire::CompanionState& state, Time came) {
  if (state.pictures < companion_->has()) {
    log_("the companion has lost pictures, and tells them again");
    views_.clear();
  }
  companion_->hear(state, in_ms(came));
  told_.heard(state.has, in_ms(came));
}

bool Sharing::take_in(const wire::CompanionView& view, const KeptSurvey& ours, bool drives, Time now) {
  if (view.index < companion_->has()) return false;  // told once more
  if (const Status taken = companion_->hear(view); !taken) {
    complain("a picture of the companion is not taken: " + taken.error().message + " " + taken.error().where, now);
    return false;
  }
  companion_->look_from_theirs(explorer_of(ours), drives ? ours.floor_from_robot() : std::nullopt, in_ms(now));
  return true;
}

/// Our survey hears of the other robot.
void Sharing::inform(KeptSurvey& ours, Time now) {
  if (informed_at_ && now - *informed_at_ < kInformedEvery) return;
  informed_at_ = now;
  auto companion = companion_->companion(explorer_of(ours), in_ms(now));
  if (companion.has_value() != progress_->joined)
    log_(companion ? "the companion's floor is joined to this one" : "the companion's floor is not joined any more");
  progress_->joined = companion.has_value();
  ours.set_companion(std::move(companion));
}

void Sharing::say_state(const KeptSurvey& ours, bool drives, Time now, std::vector<std::vector<std::uint8_t>>& out) {
  const bool changes = drives || drives != said_drives_ || companion_->has() != said_has_;
  if (said_at_ && now - *said_at_ < (changes ? kSaidEvery : kSaidStandingEvery)) return;
  said_at_ = now;
  said_has_ = companion_->has();
  said_drives_ = drives;
  wire::CompanionState state;
  state.exploration = ours_;
  state.pictures = pictures_of(ours);
  state.odometry = ours.odometry_of_pictures();
  if (drives) state.target_m = ours.survey().target_m();
  state.drives = drives;
  state.agreements = companion_->agreements();
  // Where no more is taken in, no more need be told.
  const wire::CompanionState* told = companion_->lately_told(in_ms(now));
  state.has = told != nullptr && companion_->takes_no_more() ? told->pictures : companion_->has();
  out.push_back(wire::encode(wire::AgentMessage(state)));
}

void Sharing::say_picture(const KeptSurvey& ours, Time now, std::vector<std::vector<std::uint8_t>>& out) {
  if (companion_->lately_told(in_ms(now)) == nullptr) return;
  const auto index = told_.next(pictures_of(ours), in_ms(now));
  if (!index) return;
  auto view = ours.files().view(static_cast<std::size_t>(*index));
  if (!view) return complain("a picture cannot be told to the companion: " + view.error().message, now);
  wire::CompanionView told{ours_, *index, std::move(*view), {}};
  const auto& appearance = explorer_of(ours).views()[static_cast<std::size_t>(*index)].appearance;
  if (appearance) told.appearance = wire::encode_appearance(*appearance);
  if (told.appearance.size() > kMostTold_bytes) told.appearance.clear();
  out.push_back(wire::encode(wire::AgentMessage(std::move(told))));
}

std::vector<std::vector<std::uint8_t>> Sharing::share(KeptSurvey* ours, bool drives, Time now) {
  turn_to(ours);
  std::vector<std::vector<std::uint8_t>> out;
  if (!companion_) return out;
  for (bool goes_on = true; goes_on && !views_.empty(); views_.pop_front())
    goes_on = !take_in(views_.front(), *ours, drives, now);
  progress_->pictures = companion_->has();
  inform(*ours, now);
  say_state(*ours, drives, now, out);
  say_picture(*ours, now, out);
  return out;
}

void Sharing::took_picture(const KeptSurvey& ours, Time now) {
  if (companion_) companion_->look_from_ours(explorer_of(ours), in_ms(now));
}

bool Sharing::has_more_to_tell(const KeptSurvey& ours, Time now) const {
  return companion_ && companion_->lately_told(in_ms(now)) != nullptr && told_.has() &&
         *told_.has() < pictures_of(ours);
}

}  // namespace homeward::agent
