// SPDX-License-Identifier: Apache-2.0
#include "server/driving/plan_record.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace homeward::server {

void PlanRecord::note(const RobotId& robot, const std::optional<MissionId>& mission, const wire::PlanPoseView* said) {
  const std::scoped_lock lock(mutex_);
  const auto found = batches_.find(robot);
  if (found != batches_.end() && found->second.mission != mission) {
    keep(found->second);
    batches_.erase(found);
  }
  if (!mission || said == nullptr) return;
  Batch& batch = batches_[robot];
  batch.mission = *mission;
  batch.said.push_back(*said);
  batch.said.back().particles.clear();
  if (batch.said.size() >= kAtATime) keep(batch);
}

void PlanRecord::keep_what_is_left() {
  const std::scoped_lock lock(mutex_);
  for (auto& [robot, batch] : batches_) keep(batch);
  batches_.clear();
}

void PlanRecord::keep(Batch& batch) {
  if (batch.said.empty()) return;
  const bool queued = journal_.try_run([this, mission = batch.mission, said = std::exchange(batch.said, {})] {
    const Status kept = store_.add_plan_poses(mission, said);
    if (!kept) spdlog::warn("what the plan said of mission {} is not kept: {}", mission.str(), kept.error().message);
  });
  if (!queued) spdlog::warn("what the plan said of mission {} is not kept: too much waits", batch.mission.str());
}

}  // namespace homeward::server
