// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/link_lag.hpp"

#include <gtest/gtest.h>

#include <random>

namespace homeward::agent::link_lag_test {
namespace {

using driving::Milliseconds;

constexpr double kDrift = 1e-3;

TEST(StampedDelay, IsWhatAMessageTookLongerThanTheQuickest) {
  StampedDelay delay(kDrift);
  EXPECT_EQ(delay.age_ms(7'000'000, 100'000), 0) << "whatever the clocks say";
  EXPECT_EQ(delay.age_ms(7'100'000, 100'130), 30);
  EXPECT_EQ(delay.age_ms(7'200'000, 100'190), 0) << "a quicker one";
  EXPECT_EQ(delay.age_ms(7'300'000, 102'290), 1998) << "2.1 s on the way less 0.1, and two of drift at most";
}

TEST(StampedDelay, OfARobotThatLivesBeforeOurTime) {
  StampedDelay delay(kDrift);
  const std::int64_t of_2026_us = 1'790'000'000'000'000;
  EXPECT_EQ(delay.age_ms(of_2026_us, 5'000), 0);
  EXPECT_EQ(delay.age_ms(of_2026_us + 100'000, 5'600), 499);
}

TEST(StampedDelay, FollowsAClockThatDrifts) {
  for (const double drift : {-0.9 * kDrift, 0.9 * kDrift}) {
    StampedDelay delay(kDrift);
    for (Milliseconds now_ms = 0; now_ms < 7'200'000; now_ms += 100) {
      const auto stamp_us = static_cast<std::int64_t>(1000.0 * (1.0 + drift) * static_cast<double>(now_ms));
      ASSERT_LE(delay.age_ms(stamp_us, now_ms), 1) << now_ms << " ms with " << drift;
    }
  }
}

TEST(StampedDelay, SeesThroughJitter) {
  StampedDelay delay(kDrift);
  std::mt19937 random(3);
  std::uniform_int_distribution<Milliseconds> jitter_ms(5, 60);
  Milliseconds now_ms = 1000;
  for (; now_ms < 60'000; now_ms += 100) {
    ASSERT_LE(delay.age_ms(1000 * now_ms, now_ms + jitter_ms(random)), 60);
  }
  EXPECT_GT(delay.age_ms(1000 * now_ms, now_ms + 500), 400);
}

TEST(StampedDelay, AClockThatWasSetForwardMakesNothingOld) {
  StampedDelay delay(kDrift);
  delay.age_ms(7'000'000, 1000);
  EXPECT_EQ(delay.age_ms(3'607'100'000, 1100), 0);
  EXPECT_GT(delay.age_ms(7'200'000, 1200), 3'000'000) << "and set back everything, until the connection is made anew";
  delay.forget();
  EXPECT_EQ(delay.age_ms(7'300'000, 1300), 0);
}

class LinkLagTest : public ::testing::Test {
 protected:
  LinkLagTest() { lag_.begin(0); }

  LinkLagConfig config_;
  LinkLag lag_{config_};
};

TEST_F(LinkLagTest, IsNotKnownOfAConnectionJustMade) {
  EXPECT_FALSE(lag_.settled(config_.remembered_ms - 1));
  EXPECT_TRUE(lag_.settled(config_.remembered_ms));
  EXPECT_FALSE(lag_.late(config_.remembered_ms)) << "where nothing bears a stamp";
}

TEST_F(LinkLagTest, AnythingLateSpeaksForAWhile) {
  lag_.pinged(config_.most_ms, 1000);
  EXPECT_FALSE(lag_.late(1000));
  lag_.pinged(config_.most_ms + 1, 2000);
  EXPECT_TRUE(lag_.late(2000));
  EXPECT_TRUE(lag_.late(2000 + config_.remembered_ms));
  EXPECT_EQ(lag_.worst_ms(2000), config_.most_ms + 1);
  EXPECT_FALSE(lag_.late(2001 + config_.remembered_ms));
  lag_.heard(700, 5000);
  lag_.heard(0, 5001);
  EXPECT_TRUE(lag_.late(5001)) << "what waited in the bridge comes beside what is new";
}

TEST_F(LinkLagTest, WhatComesAfterASilenceMayBeAsOldAsThat) {
  lag_.heard(20, 1000);
  EXPECT_FALSE(lag_.late(1200));
  EXPECT_TRUE(lag_.late(1000 + config_.most_ms));
  lag_.heard(0, 1400);
  EXPECT_FALSE(lag_.late(1400));
}

TEST_F(LinkLagTest, ThatLastsIsALostConnection) {
  Milliseconds now_ms = 1000;
  for (; now_ms <= 1000 + config_.lasts_ms; now_ms += 50) {
    lag_.pinged(900, now_ms);
    ASSERT_FALSE(lag_.lost(now_ms));
  }
  lag_.pinged(900, now_ms);
  EXPECT_TRUE(lag_.lost(now_ms));
  lag_.begin(now_ms);
  EXPECT_FALSE(lag_.lost(now_ms));
}

TEST_F(LinkLagTest, WithABreakDoesNotLast) {
  for (Milliseconds now_ms = 1000; now_ms < 20'000; now_ms += 50) {
    const bool stalls = now_ms % 2000 < 900;
    lag_.pinged(stalls ? 600 : 20, now_ms);
    ASSERT_FALSE(lag_.lost(now_ms)) << now_ms;
  }
}

}  // namespace
}  // namespace homeward::agent::link_lag_test
