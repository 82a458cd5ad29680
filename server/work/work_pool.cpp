// SPDX-License-Identifier: Apache-2.0
#include "server/work/work_pool.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

namespace homeward::server {

WorkPool::WorkPool(int threads, std::size_t queue_limit, int niceness) : queue_limit_(queue_limit) {
  for (int i = 0; i < threads; ++i) {
    workers_.emplace_back([this, niceness](const std::stop_token& stop) {
      // Linux keeps a priority for each thread; 0 is the one that asks.
      if (niceness > 0) setpriority(PRIO_PROCESS, 0, niceness);
      work(stop);
    });
  }
}

WorkPool::~WorkPool() { stop(); }

bool WorkPool::try_run(Task task) {
  {
    const std::scoped_lock lock(mutex_);
    if (stopping_ || queue_.size() >= queue_limit_) return false;
    queue_.push_back(std::move(task));
  }
  ready_.notify_one();
  return true;
}

void WorkPool::work_off() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [&] { return queue_.empty() && running_ == 0; });
}

void WorkPool::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    queue_.clear();
  }
  for (std::jthread& worker : workers_) worker.request_stop();
  workers_.clear();  // joins
}

void WorkPool::finish() {
  {
    std::unique_lock lock(mutex_);
    stopping_ = true;
    idle_.wait(lock, [&] { return queue_.empty() && running_ == 0; });
  }
  stop();
}

std::size_t WorkPool::waiting() const {
  const std::scoped_lock lock(mutex_);
  return queue_.size();
}

void WorkPool::work(const std::stop_token& stop) {
  while (true) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      if (!ready_.wait(lock, stop, [&] { return !queue_.empty(); })) return;
      task = std::move(queue_.front());
      queue_.pop_front();
      ++running_;
    }
    try {
      task();
    } catch (const std::exception& exception) {
      spdlog::error("a task was ended by a fault: {}", exception.what());
    }
    task = nullptr;
    {
      const std::scoped_lock lock(mutex_);
      --running_;
    }
    idle_.notify_all();
  }
}

}  // namespace homeward::server
