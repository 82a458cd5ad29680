// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.hpp"
#include "sim/box.hpp"

namespace homeward::scenario {

/// Programs that each simulate a robot of one and the same world tell each other in a folder where their robots stand:
/// a file for each, which is there as long as the program is.
class SharedWorld {
 public:
  /// Makes the folder. Errors: kIo.
  static Result<SharedWorld> join(const std::filesystem::path& folder);
  ~SharedWorld();
  SharedWorld(SharedWorld&& other) noexcept;
  SharedWorld& operator=(SharedWorld&&) = delete;
  SharedWorld(const SharedWorld&) = delete;
  SharedWorld& operator=(const SharedWorld&) = delete;

  /// Tells where ours stands, and gives the others. One that has told nothing for two seconds is there no more. What
  /// cannot be written or read is as if it were not there.
  std::vector<sim::Box> exchange(const sim::Box& ours);

 private:
  explicit SharedWorld(std::filesystem::path file) : file_(std::move(file)) {}

  std::filesystem::path file_;  // ours; empty: moved away
};

}  // namespace homeward::scenario
