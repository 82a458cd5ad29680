// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace homeward::server {

/// A fixed number of workers and a queue with a limit: when it is full, work is refused, never piled up.
class WorkPool {
 public:
  using Task = std::function<void()>;

  /// `niceness`: how much the workers stand back behind all else on the machine, 0 to 19 (setpriority(2)).
  WorkPool(int threads, std::size_t queue_limit, int niceness = 0);
  /// Finishes the tasks that run and drops those that wait.
  ~WorkPool();
  WorkPool(const WorkPool&) = delete;
  WorkPool& operator=(const WorkPool&) = delete;

  /// False when the queue is full or the pool is stopping; the task is then not run. What a task throws
  /// ends that task alone, and is logged.
  [[nodiscard]] bool try_run(Task task);
  /// Returns once nothing waits and nothing runs. Never from a task of its own.
  void work_off();
  /// Ends the workers; the same as destruction, callable earlier and more than once.
  void stop();
  /// Runs all that waits, then ends the workers.
  void finish();
  [[nodiscard]] std::size_t waiting() const;

 private:
  void work(const std::stop_token& stop);

  std::size_t queue_limit_;
  mutable std::mutex mutex_;
  std::condition_variable_any ready_;
  std::deque<Task> queue_;
  bool stopping_ = false;
  std::size_t running_ = 0;
  std::condition_variable idle_;
  std::vector<std::jthread> workers_;
};

}  // namespace homeward::server
