// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "server/time/clock.hpp"

namespace homeward::server {

/// Slows down the guessing of passwords: after `most` failures, none of them longer than ten times `wait` after the one
/// before, a key has to wait. The clock is handed in.
class FailureCounter {
 public:
  explicit FailureCounter(int most = 5, std::chrono::seconds wait = std::chrono::seconds(60))
      : most_(most), wait_(wait) {}

  /// Seconds to wait before the next try; 0 when it may come now.
  int seconds_to_wait(const std::string& key, SteadyTime now) {
    const std::scoped_lock lock(mutex_);
    const auto found = entries_.find(key);
    if (found == entries_.end() || found->second.failures < most_) return 0;
    const auto left = found->second.last + wait_ - now;
    if (left <= SteadyTime::duration::zero()) {
      entries_.erase(found);
      return 0;
    }
    return static_cast<int>(std::chrono::ceil<std::chrono::seconds>(left).count());
  }

  void failed(const std::string& key, SteadyTime now) {
    const std::scoped_lock lock(mutex_);
    // Names that nobody has must not fill the memory.
    if (entries_.size() >= kMostKeys) {
      std::erase_if(entries_, [&](const auto& entry) { return entry.second.last + wait_ < now; });
      if (entries_.size() >= kMostKeys) entries_.clear();
    }
    Entry& entry = entries_[key];
    if (entry.last + 10 * wait_ < now) entry.failures = 0;
    ++entry.failures;
    entry.last = now;
  }

  void succeeded(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    entries_.erase(key);
  }

 private:
  static constexpr std::size_t kMostKeys = 10'000;
  struct Entry {
    int failures = 0;
    SteadyTime last;
  };
  int most_;
  std::chrono::seconds wait_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace homeward::server
