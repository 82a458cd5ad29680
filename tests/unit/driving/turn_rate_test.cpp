// SPDX-License-Identifier: Apache-2.0
#include "driving/turn_rate.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"

namespace homeward::driving::turn_rate_test {
namespace {

TEST(TurnRate, IsTheTurnOverTheTimeBetweenHeadings) {
  TurnRate turning;
  EXPECT_DOUBLE_EQ(turning.radps(), 0.0);
  turning.observe(1.0, 1000);
  EXPECT_DOUBLE_EQ(turning.radps(), 0.0) << "one heading says nothing";
  turning.observe(1.05, 1100);
  EXPECT_NEAR(turning.radps(), 0.5, 1e-9);
  turning.observe(1.03, 1200);
  EXPECT_NEAR(turning.radps(), -0.2, 1e-9);
}

TEST(TurnRate, GoesOnPastTheHeadingBehind) {
  TurnRate turning;
  turning.observe(kPi - 0.02, 0);
  turning.observe(-kPi + 0.02, 100);
  EXPECT_NEAR(turning.radps(), 0.4, 1e-9);
}

TEST(TurnRate, StepsBetweenTwoMessagesOfOdometryChangeNothing) {
  TurnRate turning;
  turning.observe(0.0, 0);
  turning.observe(0.03, 100);
  for (std::int64_t ms = 110; ms < 180; ms += 10) turning.observe(0.03, ms);
  EXPECT_NEAR(turning.radps(), 0.3, 1e-9);
  turning.observe(0.03, 180);
  EXPECT_DOUBLE_EQ(turning.radps(), 0.0);
}

TEST(TurnRate, IsUnknownAfterAGapOrAClockThatWentBack) {
  TurnRate turning;
  turning.observe(0.0, 0);
  turning.observe(0.03, 100);
  turning.observe(1.0, 700);
  EXPECT_DOUBLE_EQ(turning.radps(), 0.0);
  turning.observe(1.05, 800);
  EXPECT_NEAR(turning.radps(), 0.5, 1e-9);
  turning.observe(1.1, 300);
  EXPECT_DOUBLE_EQ(turning.radps(), 0.0);
}

}  // namespace
}  // namespace homeward::driving::turn_rate_test
