// SPDX-License-Identifier: Apache-2.0
#include "driving/exploration_over.hpp"

#include <gtest/gtest.h>

#include "support/reason_printing.hpp"

namespace homeward::driving {
namespace {

using exploration::SurveyEnd;
using wire::ReasonCode;

TEST(ExplorationOverTest, WhoHasSeenAllHasArrivedAndSaysWhatItCouldNotGetTo) {
  EXPECT_FALSE(exploration_over(SurveyEnd::kAllSeen, 0).failed);
  EXPECT_FALSE(exploration_over(SurveyEnd::kAllSeen, 0).reason);
  const ExplorationOver over = exploration_over(SurveyEnd::kAllSeen, 2);
  EXPECT_FALSE(over.failed);
  EXPECT_EQ(over.reason, (wire::Reason{ReasonCode::kExplorationUnreached, {{"places", std::int64_t{2}}}}));
}

TEST(ExplorationOverTest, OnlyWhoIsStuckHasFailed) {
  EXPECT_TRUE(exploration_over(SurveyEnd::kStuck, 1).failed);
  EXPECT_EQ(exploration_over(SurveyEnd::kStuck, 1).reason, wire::Reason{ReasonCode::kExplorationStuck});
  EXPECT_FALSE(exploration_over(SurveyEnd::kBack, 1).failed);
  EXPECT_EQ(exploration_over(SurveyEnd::kBack, 1).reason, wire::Reason{ReasonCode::kExplorationBack});
  EXPECT_FALSE(exploration_over(SurveyEnd::kLimit, 1).failed);
  EXPECT_EQ(exploration_over(SurveyEnd::kLimit, 1).reason, wire::Reason{ReasonCode::kExplorationLimit});
}

}  // namespace
}  // namespace homeward::driving
