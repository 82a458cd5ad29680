// SPDX-License-Identifier: Apache-2.0
#include "server/driving/relay_queue.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

namespace homeward::server::relay_queue_test {
namespace {

constexpr SteadyTime kNow{std::chrono::hours(1)};
constexpr SteadyTime kLater = kNow + std::chrono::hours(1);

Outgoing message(const std::string& text, std::size_t bytes = 0) {
  return {std::make_shared<const std::string>(text + std::string(bytes, '.')), false};
}

std::string first_word(const std::optional<Outgoing>& outgoing) {
  return outgoing ? outgoing->bytes->substr(0, outgoing->bytes->find('.')) : "nothing";
}

TEST(RelayQueue, OfStatesTheNewestGoesOutAndBeforeViews) {
  RelayQueue queue;
  EXPECT_TRUE(queue.put_view(message("view")));
  queue.put_state(message("old"));
  queue.put_state(message("new"));
  EXPECT_EQ(first_word(queue.next(kNow)), "new");
  EXPECT_EQ(first_word(queue.next(kNow)), "view");
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(first_word(queue.next(kNow)), "nothing");
}

TEST(RelayQueue, OfTooManyViewsTheFirstStayInTheirOrder) {
  RelayQueue queue;
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(queue.put_view(message(std::to_string(i))), i < RelayQueue::kMostViews) << i;
  }
  for (std::size_t i = 0; i < RelayQueue::kMostViews; ++i) {
    EXPECT_EQ(first_word(queue.next(kNow + std::chrono::seconds(i))), std::to_string(i));
  }
  EXPECT_TRUE(queue.empty());
}

TEST(RelayQueue, HoldsNoMoreBytesThanItMayAndNoLargeView) {
  RelayQueue queue;
  EXPECT_FALSE(queue.put_view(message("large", RelayQueue::kMostView_bytes)));
  EXPECT_TRUE(queue.empty());
  for (const char* name : {"1", "2", "3", "4"})
    EXPECT_TRUE(queue.put_view(message(name, RelayQueue::kMostView_bytes - 100)));
  EXPECT_FALSE(queue.put_view(message("more", RelayQueue::kMostView_bytes / 2)));
  EXPECT_EQ(first_word(queue.next(kNow)), "1");
  EXPECT_TRUE(queue.put_view(message("more", RelayQueue::kMostView_bytes / 2)));
}

TEST(RelayQueue, HoweverSmallTheyAreTheyLeaveSomeWhileApart) {
  RelayQueue queue;
  for (const char* name : {"first", "second"}) EXPECT_TRUE(queue.put_view(message(name)));
  queue.put_state(message("state"));
  EXPECT_EQ(first_word(queue.next(kNow)), "state");
  EXPECT_EQ(first_word(queue.next(kNow)), "first");
  queue.put_state(message("next state"));
  EXPECT_EQ(first_word(queue.next(kNow + RelayQueue::kViewsApart / 2)), "nothing");
  EXPECT_EQ(first_word(queue.next(kNow + RelayQueue::kViewsApart)), "second");
  EXPECT_EQ(first_word(queue.next(kNow + RelayQueue::kStatesApart / 2)), "nothing");
  EXPECT_EQ(first_word(queue.next(kNow + RelayQueue::kStatesApart)), "next state");
}

TEST(RelayQueue, ViewsGoOutNoFasterThanTheRateAndStatesDoNotWaitForThem) {
  RelayQueue queue;
  EXPECT_TRUE(queue.put_view(message("first", RelayQueue::kPerSecond_bytes / 2)));
  EXPECT_TRUE(queue.put_view(message("second")));
  EXPECT_EQ(first_word(queue.next(kNow)), "first");
  EXPECT_EQ(first_word(queue.next(kNow + std::chrono::milliseconds(499))), "nothing");
  queue.put_state(message("state"));
  EXPECT_EQ(first_word(queue.next(kNow + std::chrono::milliseconds(499))), "state");
  EXPECT_EQ(first_word(queue.next(kNow + std::chrono::milliseconds(501))), "second");
}

TEST(RelayQueue, WhatWasForgottenDoesNotGoOut) {
  RelayQueue queue;
  queue.put_state(message("state"));
  EXPECT_TRUE(queue.put_view(message("view", RelayQueue::kMostView_bytes / 2)));
  queue.clear();
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(first_word(queue.next(kLater)), "nothing");
  EXPECT_TRUE(queue.put_view(message("next", RelayQueue::kMostView_bytes / 2))) << "and there is room again";
  EXPECT_EQ(first_word(queue.next(kLater)), "next");
}

}  // namespace
}  // namespace homeward::server::relay_queue_test
