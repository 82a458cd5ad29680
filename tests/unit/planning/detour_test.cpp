// SPDX-License-Identifier: Apache-2.0
#include "planning/detour.hpp"

#include <gtest/gtest.h>

namespace homeward::planning {
namespace {

using Ways = std::vector<Way>;

Way way(const char* from, const char* to) { return {PlaceId(from), PlaceId(to)}; }

FailedDrive failed(std::int64_t index, const char* here) {
  return {{PlaceId("p1"), PlaceId("p2"), PlaceId("p3"), PlaceId("p4")}, index, PlaceId(here), PlaceId("p4"), 0};
}

TEST(Detour, ClosesTheEdgeThatWasDrivenAndTheNextWhereTheRobotIsFurther) {
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

TEST(Detour, IsLookedForThreeTimesAtMost) {
  FailedDrive drive = failed(1, "p1");
  for (drive.detours = 0; drive.detours < 3; ++drive.detours) {
    EXPECT_EQ(detour_after(drive), failed_ways(drive)) << drive.detours;
  }
  EXPECT_FALSE(detour_after(drive));
}

TEST(Detour, IsNotLookedForAtTheDestinationOrWithoutAnEdgeToBlame) {
  EXPECT_FALSE(detour_after(failed(3, "p4")));
  EXPECT_FALSE(detour_after(failed(0, "p9")));
}

}  // namespace
}  // namespace homeward::planning
