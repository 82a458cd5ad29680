// SPDX-License-Identifier: Apache-2.0
#include "sim/tour_path.hpp"

#include <gtest/gtest.h>

#include "sim/floor.hpp"
#include "support/box_world.hpp"

namespace homeward::sim::tour_path_test {
namespace {

TEST(PlanTour, StepsEvenlyOverTheFloorFromRoomToRoom) {
  const World world = homeward::testing::box_world(true);
  const auto stops = plan_tour(world, {"west", "east"}, 0.4);
  ASSERT_TRUE(stops) << stops.error().message;
  ASSERT_GT(stops->size(), 6U);
  for (std::size_t i = 0; i < stops->size(); ++i) {
    const Pose2& pose = (*stops)[i].pose;
    EXPECT_TRUE(is_set(world.drivable, {pose.x_m, pose.y_m}));
    EXPECT_EQ((*stops)[i].room, pose.x_m < 0.0 ? "west" : "east");
    if (i == 0) continue;
    const Pose2& before = (*stops)[i - 1].pose;
    EXPECT_LT(std::hypot(pose.x_m - before.x_m, pose.y_m - before.y_m), 0.5);
    EXPECT_LT(std::abs(wrap_angle(pose.theta_rad - before.theta_rad)), 0.8);
  }
  EXPECT_LT(std::hypot(stops->front().pose.x_m + 1.0, stops->front().pose.y_m - 0.7), 0.06);
  EXPECT_LT(std::hypot(stops->back().pose.x_m - 1.0, stops->back().pose.y_m - 0.7), 0.06);
}

TEST(PlanTour, MarksEachRoomOnceWhereItsPointIsReached) {
  const World world = homeward::testing::box_world(true);
  const auto stops = plan_tour(world, {"west", "east", "west", "east"}, 0.4);
  ASSERT_TRUE(stops);
  std::vector<std::string> arrived;
  for (const TourStop& stop : *stops) {
    if (!stop.arrived) continue;
    arrived.push_back(*stop.arrived);
    EXPECT_LT(std::hypot(stop.pose.x_m - (*stop.arrived == "west" ? -1.0 : 1.0), stop.pose.y_m - 0.7), 0.06);
  }
  EXPECT_EQ(arrived, (std::vector<std::string>{"west", "east"}));
}

TEST(PlanTour, LooksWhereItGoesAndShowsTurnsOnTheSpot) {
  const World world = homeward::testing::box_world(false);
  const auto stops = plan_tour(world, {"west", "east", "west"}, 0.4);
  ASSERT_TRUE(stops);
  int on_the_spot = 0;
  bool looked_back = false;
  for (std::size_t i = 1; i < stops->size(); ++i) {
    const Pose2& pose = (*stops)[i].pose;
    const Pose2& before = (*stops)[i - 1].pose;
    EXPECT_LT(std::abs(wrap_angle(pose.theta_rad - before.theta_rad)), 0.8);
    on_the_spot += std::hypot(pose.x_m - before.x_m, pose.y_m - before.y_m) < 1e-9 ? 1 : 0;
    looked_back = looked_back || std::abs(pose.theta_rad) > 3.0;
  }
  EXPECT_NEAR(stops->front().pose.theta_rad, 0.0, 0.3);
  EXPECT_TRUE(looked_back);
  EXPECT_GE(on_the_spot, 3);  // half a turn in pieces of 0.7
}

TEST(PlanTour, SaysWhatIsWrong) {
  World world = homeward::testing::box_world(false);
  const auto unknown = plan_tour(world, {"west", "cellar"}, 0.4);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_NE(unknown.error().message.find("cellar"), std::string::npos);
  EXPECT_NE(unknown.error().message.find("west, east"), std::string::npos);
  EXPECT_EQ(plan_tour(world, {"west"}, 0.4).error().code, ErrorCode::kTooFewImages);
  EXPECT_EQ(plan_tour(world, {"west", "east"}, 0.0).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(plan_tour(world, {"west", "east"}, std::nan("")).error().code, ErrorCode::kInvalidInput);
  const int column = cell_of(world.drivable, {0.0, 0.0}).x();
  for (int row = 0; row < world.drivable.height; ++row) {
    world.drivable.cells[static_cast<std::size_t>(row * world.drivable.width + column)] = 0;
  }
  EXPECT_EQ(plan_tour(world, {"west", "east"}, 0.4).error().code, ErrorCode::kNoRoute);
}

Room room_with_point(const std::string& name, double x_m, double y_m) {
  Room room;
  room.name = name;
  room.x_m = x_m;
  room.y_m = y_m;
  return room;
}

TEST(AllRooms, EachIsFollowedByTheNearestOfThoseThatAreLeft) {
  World world;
  world.rooms = {room_with_point("hall", 0.0, 0.0), room_with_point("far", 9.0, 0.0), room_with_point("near", 0.0, 2.0),
                 room_with_point("middle", 5.0, 0.0)};
  EXPECT_EQ(all_rooms(world), (std::vector<std::string>{"hall", "near", "middle", "far", "hall"}));
}

TEST(AllRooms, OfFewRoomsThereIsNothingToComeBackTo) {
  World world;
  EXPECT_TRUE(all_rooms(world).empty());
  world.rooms = {room_with_point("hall", 0.0, 0.0)};
  EXPECT_EQ(all_rooms(world), std::vector<std::string>{"hall"});
}

}  // namespace
}  // namespace homeward::sim::tour_path_test
