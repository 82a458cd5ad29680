// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace homeward::db {

/// A lock for each name, which is there as long as somebody holds or waits for it.
class KeyedMutex {
  struct Entry {
    std::mutex mutex;
    int users = 0;
  };

 public:
  /// Holds the lock of a name while it lives.
  class Hold {
   public:
    Hold(KeyedMutex& locks, const std::string& name) : locks_(locks) {
      {
        const std::scoped_lock lock(locks_.mutex_);
        entry_ = locks_.entries_.try_emplace(name).first;
        ++entry_->second.users;
      }
      entry_->second.mutex.lock();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() {
      entry_->second.mutex.unlock();
      const std::scoped_lock lock(locks_.mutex_);
      if (--entry_->second.users == 0) locks_.entries_.erase(entry_);
    }

   private:
    KeyedMutex& locks_;
    std::map<std::string, Entry>::iterator entry_;
  };

 private:
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace homeward::db
