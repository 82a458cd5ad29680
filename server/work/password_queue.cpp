// SPDX-License-Identifier: Apache-2.0
#include "server/work/password_queue.hpp"

#include <memory>

namespace homeward::server {

bool PasswordQueue::try_run(const std::string& address, WorkPool::Task task) {
  {
    const std::scoped_lock lock(mutex_);
    int& count = by_address_[address];
    if (count >= kMostOfAddress) return false;
    ++count;
  }
  // Given back however the task ends, also when it is dropped.
  const std::shared_ptr<void> place(nullptr, [this, address](void*) { left(address); });
  return pool_.try_run([place, task = std::move(task)] { task(); });
}

void PasswordQueue::left(const std::string& address) {
  const std::scoped_lock lock(mutex_);
  const auto found = by_address_.find(address);
  if (found != by_address_.end() && --found->second == 0) by_address_.erase(found);
}

}  // namespace homeward::server
