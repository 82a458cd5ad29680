// SPDX-License-Identifier: Apache-2.0
#include "server/work/work_pool.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>

#include "server/work/password_queue.hpp"

namespace homeward::server::work_pool_test {
namespace {

/// A task that runs until it is let go, and tells when it has begun.
class Gate {
 public:
  WorkPool::Task task() {
    return [this] {
      begun_.set_value();
      go_.get_future().wait();
    };
  }
  void wait_until_begun() { begun_.get_future().wait(); }
  void open() { go_.set_value(); }

 private:
  std::promise<void> begun_;
  std::promise<void> go_;
};

TEST(WorkPool, RefusesWorkWhenItsQueueIsFullAndTakesItAgainWhenThereIsRoom) {
  WorkPool pool(1, 2);
  Gate gate;
  std::atomic<int> ran = 0;
  ASSERT_TRUE(pool.try_run(gate.task()));
  gate.wait_until_begun();
  EXPECT_TRUE(pool.try_run([&] { ++ran; }));
  EXPECT_TRUE(pool.try_run([&] { ++ran; }));
  EXPECT_FALSE(pool.try_run([&] { ran += 100; }));
  EXPECT_EQ(pool.waiting(), 2U);
  gate.open();
  std::promise<void> done;
  while (!pool.try_run([&] { done.set_value(); })) std::this_thread::yield();
  done.get_future().wait();
  EXPECT_EQ(ran, 2);
}

TEST(WorkPool, FinishRunsWhatWaitsAndRefusesWhatComesAfter) {
  WorkPool pool(1, 10);
  std::atomic<int> ran = 0;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(pool.try_run([&] { ++ran; }));
  pool.finish();
  EXPECT_EQ(ran, 5);
  EXPECT_FALSE(pool.try_run([&] { ++ran; }));
}

TEST(WorkPool, StopEndsTheRunningTaskInOrderAndDropsWhatWaits) {
  WorkPool pool(1, 10);
  Gate gate;
  std::atomic<int> ran = 0;
  ASSERT_TRUE(pool.try_run(gate.task()));
  gate.wait_until_begun();
  ASSERT_TRUE(pool.try_run([&] { ++ran; }));
  std::jthread opener([&] {
    while (pool.waiting() > 0) std::this_thread::yield();  // until the stop has dropped it
    gate.open();
  });
  pool.stop();
  opener.join();
  EXPECT_EQ(ran, 0);
}

TEST(WorkPool, ItsWorkersStandBackAsFarAsTheyAreToldAndNobodyElseDoes) {
  const int own = getpriority(PRIO_PROCESS, 0);  // on Linux of this thread
  if (own >= 7) GTEST_SKIP() << "this whole run stands back as far";
  WorkPool behind(1, 1, 7);
  WorkPool beside(1, 1);
  std::promise<int> niceness;
  std::promise<int> none;
  ASSERT_TRUE(behind.try_run([&] { niceness.set_value(getpriority(PRIO_PROCESS, 0)); }));
  ASSERT_TRUE(beside.try_run([&] { none.set_value(getpriority(PRIO_PROCESS, 0)); }));
  EXPECT_EQ(niceness.get_future().get(), 7);
  EXPECT_EQ(none.get_future().get(), own);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), own);
}

TEST(WorkPool, AFaultEndsItsTaskAlone) {
  WorkPool pool(1, 10);
  std::atomic<int> ran = 0;
  ASSERT_TRUE(pool.try_run([] { throw std::runtime_error("no more memory"); }));
  ASSERT_TRUE(pool.try_run([&] { ++ran; }));
  pool.work_off();
  EXPECT_EQ(ran, 1);
}

TEST(PasswordQueue, OfOneAddressAFewMayWait) {
  PasswordQueue queue;
  Gate gate;
  std::atomic<int> ran = 0;
  ASSERT_TRUE(queue.try_run("a", gate.task()));
  gate.wait_until_begun();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.try_run("a", [&] { ++ran; })) << i;
  EXPECT_FALSE(queue.try_run("a", [&] { ran += 100; }));
  EXPECT_TRUE(queue.try_run("b", [&] { ++ran; }));
  for (int i = 0; i < 100; ++i) static_cast<void>(queue.try_run("c" + std::to_string(i), [&] { ++ran; }));
  EXPECT_EQ(queue.waiting(), 32U);
  EXPECT_FALSE(queue.try_run("d", [&] { ran += 100; }));
  gate.open();
  queue.work_off();
  EXPECT_EQ(ran, 32);
  EXPECT_TRUE(queue.try_run("a", [&] { ++ran; })) << "there is room again";
  EXPECT_TRUE(queue.try_run("d", [&] { ++ran; })) << "and whoever was refused in between left nothing behind";
  queue.work_off();
}

}  // namespace
}  // namespace homeward::server::work_pool_test
