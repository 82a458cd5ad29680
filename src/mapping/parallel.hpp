// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace homeward::mapping {

/// Calls `work(i)` once for each i below `count`, on `threads` threads (0: as many as the machine has), in any order:
/// `work` writes only what belongs to i. The calling thread calls `progress(done)` now and then. Returns whether all
/// was done; false after `stop` was asked for. An exception of `work` ends the loop and is thrown on.
bool parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& progress, const std::stop_token& stop);

}  // namespace homeward::mapping
