// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <mutex>

#include "db/store.hpp"
#include "server/time/clock.hpp"
#include "server/work/work_pool.hpp"

namespace homeward::server {

/// Writes what becomes of missions to the store, without anybody waiting for it. What the store does not take (its disk
/// is full) is kept in memory, the newest of each mission, and written once it does.
class MissionJournal {
 public:
  static constexpr std::chrono::seconds kTryAgainAfter{5};

  /// `journal` has one worker. Both have to outlive it.
  MissionJournal(db::Store& store, WorkPool& journal) : store_(store), journal_(journal) {}

  /// From any thread.
  void keep(const wire::MissionView& mission);
  /// Tries again what was not taken, kTryAgainAfter after the last time. Call it often.
  void try_again(SteadyTime now);

 private:
  void write(const wire::MissionView& mission);

  db::Store& store_;
  WorkPool& journal_;
  std::mutex mutex_;
  std::map<MissionId, wire::MissionView> not_taken_;
  SteadyTime tried_;
};

}  // namespace homeward::server
