// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "server_process.hpp"

namespace homeward::bench {

/// A map of 40 pictures that the server builds over and over until this goes. The tour is uploaded before it begins.
class BuildLoad {
 public:
  explicit BuildLoad(ServerProcess& server);
  /// How many builds have ended well.
  [[nodiscard]] int done() const { return done_; }

 private:
  std::atomic<int> done_ = 0;
  std::jthread thread_;
};

}  // namespace homeward::bench
