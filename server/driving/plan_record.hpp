// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "db/store.hpp"
#include "server/work/work_pool.hpp"

namespace homeward::server {

/// Keeps what plans say of the pictures of missions, some at a time and without anybody waiting for it. What the store
/// does not take is left out: it is no part of the drive. Thread-safe.
class PlanRecord {
 public:
  static constexpr std::size_t kAtATime = 25;  // pictures of a robot: some seconds

  /// `journal` has one worker. Both have to outlive it.
  PlanRecord(db::Store& store, WorkPool& journal) : store_(store), journal_(journal) {}

  /// Takes up what was said of a picture of this mission. `mission`: nothing, the robot is on none; `said`: null,
  /// nothing new was said.
  void note(const RobotId& robot, const std::optional<MissionId>& mission, const wire::PlanPoseView* said);
  /// Hands all to the journal that waits here.
  void keep_what_is_left();

 private:
  struct Batch {
    MissionId mission;
    std::vector<wire::PlanPoseView> said;
  };
  /// With mutex_ held.
  void keep(Batch& batch);

  db::Store& store_;
  WorkPool& journal_;
  std::mutex mutex_;
  std::map<RobotId, Batch> batches_;  // of robots that are on missions
};

}  // namespace homeward::server
