// SPDX-License-Identifier: Apache-2.0
#include "driving/mission.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::mission_test {
namespace {

TEST_F(StepTest, TheWaysOfAMissionLieBetweenTheViewsThatTheyName) {
  wire::MissionOrder order = mission("m1", 1, 1);
  wire::Surroundings around;
  around.path = {{0.0, 1.0, 0.0}, {2.0, 1.0, 0.5}};
  around.final_pose = {3.0, 1.0, 0.0};
  around.nearby.push_back({PlaceId("p7"), ImageId("tour/7.jpg"), {2.0, 5.0, 1.0}, order.path[0].appearance});
  around.ways = {{0, 1}, {2, 1}};
  order.surroundings = around;
  const auto decoded = decode_mission(order, config_);
  ASSERT_TRUE(decoded) << decoded.error().message;
  ASSERT_EQ(decoded->path.ways.size(), 2U);
  EXPECT_EQ(decoded->path.ways[0].from_m, Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(decoded->path.ways[0].to_m, Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(decoded->path.ways[1].from_m, Eigen::Vector2d(2.0, 5.0)) << "nearby views count on after the path's";
  EXPECT_EQ(decoded->path.ways[1].to_m, Eigen::Vector2d(2.0, 1.0));
}

}  // namespace
}  // namespace homeward::driving::mission_test
