// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "server/work/work_pool.hpp"

namespace homeward::server {

/// Checks passwords one at a time, behind all other work: it is made to be dear, so that a flood of logins would take
/// the processors from those who drive. Of each address a few may wait, so that no other is kept out. Callable from any
/// thread.
class PasswordQueue {
 public:
  /// False when too many wait, in all or of this address; the task is then not run.
  [[nodiscard]] bool try_run(const std::string& address, WorkPool::Task task);
  void work_off() { pool_.work_off(); }
  void stop() { pool_.stop(); }
  [[nodiscard]] std::size_t waiting() const { return pool_.waiting(); }

 private:
  void left(const std::string& address);

  std::mutex mutex_;
  std::map<std::string, int> by_address_;  // that wait or run
  static constexpr std::size_t kMostWaiting = 32;
  static constexpr int kMostOfAddress = 4;
  static constexpr int kNiceness = 10;
  WorkPool pool_{1, kMostWaiting, kNiceness};
};

}  // namespace homeward::server
