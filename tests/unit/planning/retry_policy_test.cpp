// SPDX-License-Identifier: Apache-2.0
#include "planning/retry_policy.hpp"

#include <gtest/gtest.h>

#include "support/ascii_map.hpp"

namespace homeward::planning::retry_policy_test {
namespace {

using Ways = std::vector<Way>;

Way way(const char* from, const char* to) { return {PlaceId(from), PlaceId(to)}; }

FailedDrive failed(std::int64_t index, const char* here) {
  return {{PlaceId("p1"), PlaceId("p2"), PlaceId("p3"), PlaceId("p4")}, index, PlaceId(here), PlaceId("p4"), 0};
}

TEST(RetryPolicy, ClosesTheEdgeThatWasDrivenAndTheNextWhereTheRobotIsFurther) {
  EXPECT_EQ(failed_ways(failed(1, "p1")), (Ways{way("p1", "p2"), way("p2", "p1")}));
  EXPECT_EQ(failed_ways(failed(2, "p9")), (Ways{way("p2", "p3"), way("p3", "p2")}));
  EXPECT_EQ(failed_ways(failed(2, "p3")), (Ways{way("p2", "p3"), way("p3", "p2"), way("p3", "p4"), way("p4", "p3")}));
  EXPECT_EQ(failed_ways(failed(0, "p1")), (Ways{way("p1", "p2"), way("p2", "p1")}));
  EXPECT_EQ(failed_ways(failed(3, "p4")), (Ways{way("p3", "p4"), way("p4", "p3")}));
  EXPECT_TRUE(failed_ways(failed(0, "p9")).empty());
  FailedDrive short_one = failed(0, "p1");
  short_one.path.resize(1);
  EXPECT_TRUE(failed_ways(short_one).empty());
}

TEST(RetryPolicy, IsLookedForThreeTimesAtMost) {
  FailedDrive drive = failed(1, "p1");
  for (drive.detours = 0; drive.detours < 3; ++drive.detours) {
    EXPECT_EQ(detour_after(drive), failed_ways(drive)) << drive.detours;
  }
  EXPECT_FALSE(detour_after(drive));
}

TEST(RetryPolicy, IsNotLookedForAtTheDestinationOrWithoutAnEdgeToBlame) {
  EXPECT_FALSE(detour_after(failed(3, "p4")));
  FailedDrive short_one = failed(0, "p1");
  short_one.path.resize(1);
  EXPECT_FALSE(detour_after(short_one));
}

TEST(RetryPolicy, ClosesNothingWhereTheRobotWasSentFromElsewhereThanItStood) {
  EXPECT_EQ(detour_after(failed(0, "p9")), Ways());
  FailedDrive often = failed(0, "p9");
  often.detours = 3;
  EXPECT_FALSE(detour_after(often));
}

TEST(RetryPolicy, OfARobotThatWentAstrayClosesNothingAndIsNoDetour) {
  FailedDrive astray = failed(2, "p9");
  astray.astray = true;
  astray.detours = 3;
  for (astray.restarts = 0; astray.restarts < 20; ++astray.restarts) {
    EXPECT_EQ(detour_after(astray), Ways()) << astray.restarts;
  }
  EXPECT_FALSE(detour_after(astray)) << "but not without end";
  FailedDrive there = failed(2, "p4");
  there.astray = true;
  EXPECT_EQ(detour_after(there), Ways()) << "somebody has lifted it there";
}

TEST(RetryPolicy, OfARobotThatIsUnsureIsLookedForThreeTimesAtMost) {
  FailedDrive unsure = failed(3, "p4");
  unsure.unsure = true;
  for (unsure.unsure_restarts = 0; unsure.unsure_restarts < 3; ++unsure.unsure_restarts) {
    EXPECT_EQ(detour_after(unsure), Ways()) << unsure.unsure_restarts;
  }
  EXPECT_FALSE(detour_after(unsure));
}

TEST(RetryPolicy, GoesRoundWhatIsClosed) {
  const auto map = homeward::testing::ascii_map(R"(
A-B
| |
C-D
)");
  const auto detour =
      plan_detour(map, {.from = PlaceId("A"), .to = PlaceId("B"), .avoid = {}, .closed = {way("A", "B")}}, true);
  ASSERT_TRUE(detour);
  EXPECT_EQ(homeward::testing::spelled(detour->route.places), "A C D B");
  EXPECT_FALSE(detour->again);
}

TEST(RetryPolicy, FailsAgainWhereAllThatFailedIsClosedAlready) {
  const Ways closed = {way("A", "B"), way("B", "A"), way("C", "D"), way("D", "C")};
  EXPECT_FALSE(fails_again({}, Ways{way("A", "B"), way("B", "A")}));
  EXPECT_TRUE(fails_again(closed, Ways{way("C", "D"), way("D", "C")}));
  EXPECT_FALSE(fails_again(closed, Ways{way("B", "C"), way("C", "B")}));
  EXPECT_FALSE(fails_again(closed, Ways{way("A", "B"), way("B", "A"), way("B", "C"), way("C", "B")}));
  EXPECT_FALSE(fails_again(closed, {})) << "nothing is to blame";
}

TEST(RetryPolicy, TriesTheOnlyWayOnceMore) {
  const auto map = homeward::testing::ascii_map("A-B-C");
  const RouteRequest request{
      .from = PlaceId("A"), .to = PlaceId("C"), .avoid = {}, .closed = {way("A", "B"), way("B", "A")}};
  const auto again = plan_detour(map, request, true);
  ASSERT_TRUE(again);
  EXPECT_EQ(homeward::testing::spelled(again->route.places), "A B C");
  EXPECT_TRUE(again->again);
  const auto enough = plan_detour(map, request, false);
  ASSERT_FALSE(enough);
  EXPECT_EQ(enough.error().code, ErrorCode::kNoRoute);
}

TEST(RetryPolicy, DoesNotTryAgainWhereThereWasNeverAWay) {
  const auto map = homeward::testing::ascii_map("A-B C-D");
  const auto none =
      plan_detour(map, {.from = PlaceId("A"), .to = PlaceId("D"), .avoid = {}, .closed = {way("A", "B")}}, true);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNoRoute);
}

TEST(LongestMission, IsTenMinutesAndMoreForLongWays) {
  EXPECT_DOUBLE_EQ(longest_mission_s(5.0), 600.0);
  EXPECT_NEAR(longest_mission_s(90.0), 1500.0, 1.0);
}

}  // namespace
}  // namespace homeward::planning::retry_policy_test
