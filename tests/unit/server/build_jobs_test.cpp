// SPDX-License-Identifier: Apache-2.0
#include "server/work/build_jobs.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "support/scratch_folder.hpp"

namespace homeward::server::build_jobs_test {
namespace {

/// How many threads of this process stand back by that much (setpriority(2), for Linux of each thread).
int threads_of_niceness(int niceness) {
  int count = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    if (getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoi(thread.path().filename()))) == niceness) ++count;
  }
  return count;
}

TEST(BuildJobs, StandBackBehindThoseWhoDrive) {
  const int own = getpriority(PRIO_PROCESS, 0);
  if (own >= 10) GTEST_SKIP() << "this whole run stands back as far";
  const testing::ScratchFolder folder;
  const auto store = db::open_sqlite_store(folder.path());
  ASSERT_TRUE(store) << store.error().message;
  EventHub events;
  const SystemClock clock;
  MapService maps(**store, events, clock);
  const int before = threads_of_niceness(10);
  DraftService drafts(**store, maps, events, clock);
  const BuildJobs jobs(**store, maps, drafts, events, clock, 1);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (threads_of_niceness(10) == before && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(threads_of_niceness(10), before + 1);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), own) << "others are not held back";
}

}  // namespace
}  // namespace homeward::server::build_jobs_test
