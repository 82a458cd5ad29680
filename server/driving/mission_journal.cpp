// SPDX-License-Identifier: Apache-2.0
#include "server/driving/mission_journal.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace homeward::server {

void MissionJournal::keep(const wire::MissionView& mission) {
  const bool queued = journal_.try_run([this, mission] { write(mission); });
  if (!queued) spdlog::warn("mission {} is not kept: the server ends", mission.id.str());
}

void MissionJournal::write(const wire::MissionView& mission) {
  const Status kept = store_.update_mission(mission);
  const std::scoped_lock lock(mutex_);
  if (kept) {
    not_taken_.erase(mission.id);  // what was older
    return;
  }
  // One that the store does not know (its robot was removed) never will be.
  if (kept.error().code != ErrorCode::kNotFound) not_taken_[mission.id] = mission;
  spdlog::error("mission {} cannot be kept: {}", mission.id.str(), kept.error().message);
}

void MissionJournal::try_again(SteadyTime now) {
  const std::scoped_lock lock(mutex_);
  if (not_taken_.empty() || now - tried_ < kTryAgainAfter) return;
  tried_ = now;
  for (const auto& [id, mission] : not_taken_) {
    // By then a newer state may be kept, or wait to be tried.
    const bool queued = journal_.try_run([this, id = id] {
      std::optional<wire::MissionView> newest;
      {
        const std::scoped_lock inner(mutex_);
        const auto found = not_taken_.find(id);
        if (found != not_taken_.end()) newest = found->second;
      }
      if (newest) write(*newest);
    });
    if (!queued) return;
  }
}

}  // namespace homeward::server
