// SPDX-License-Identifier: Apache-2.0
#include "scenario/known_plan.hpp"

#include <gtest/gtest.h>

namespace homeward::scenario::known_plan_test {
namespace {

/// A corridor of 10 m by 1 m with nothing in it.
sim::World corridor() {
  sim::World world;
  for (sim::FloorGrid* grid : {&world.occupied, &world.drivable}) {
    grid->width = 200;
    grid->height = 20;
    grid->resolution_m = 0.05;
    grid->cells.assign(200UL * 20UL, 0);
  }
  world.drivable.cells.assign(200UL * 20UL, 255);
  return world;
}

TEST(KnownPlanTest, ACorridorIsDrivenOnceFromItsEnd) {
  const double way_m = known_plan_m(corridor(), {0.1, 0.5}, 1.5);
  EXPECT_GT(way_m, 6.5) << "the last view has to see the far end";
  EXPECT_LT(way_m, 10.5);
}

TEST(KnownPlanTest, FromTheMiddleTheNearerEndIsSeenFirst) {
  const double way_m = known_plan_m(corridor(), {4.0, 0.5}, 1.5);
  EXPECT_LT(way_m, 13.0) << "to the left end and back past the middle";
  EXPECT_GT(way_m, 8.0);
}

TEST(KnownPlanTest, WhoSeesFartherDrivesLess) {
  EXPECT_LT(known_plan_m(corridor(), {0.1, 0.5}, 3.0), known_plan_m(corridor(), {0.1, 0.5}, 1.0));
}

}  // namespace
}  // namespace homeward::scenario::known_plan_test
