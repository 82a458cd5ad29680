// SPDX-License-Identifier: Apache-2.0
#include "mapping/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace homeward::mapping {

bool parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& progress, const std::stop_token& stop) {
  const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
  const std::size_t helpers = std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(count, 1)) - 1;
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&](bool reports) {
    while (!stop.stop_requested() && !failed) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        work(i);
        ++done;
        if (reports && progress) progress(done);
      } catch (...) {
        const std::scoped_lock lock(failure_mutex);
        if (!failed.exchange(true)) failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    for (std::size_t h = 0; h < helpers; ++h) pool.emplace_back([&] { run(false); });
    run(true);
  }
  if (failure) std::rethrow_exception(failure);
  return done == count;
}

}  // namespace homeward::mapping
