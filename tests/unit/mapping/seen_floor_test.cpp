// SPDX-License-Identifier: Apache-2.0
#include "mapping/seen_floor.hpp"

#include <gtest/gtest.h>

#include "support/walled_floor.hpp"

namespace homeward::mapping::seen_floor_test {
namespace {

using testing::sweep_at;
using testing::Wall;
using Vector2 = Eigen::Vector2d;

constexpr double kHalf_m = 0.45;
constexpr double kWithin_m = 6.0;
const std::vector<Wall> kRoom = testing::walls_around({-1.0, -1.0}, {5.0, 2.0});

/// Sweeps at these poses, and a layout that has them there.
struct Seen {
  explicit Seen(const std::vector<Pose2>& poses, const std::vector<Wall>& walls, bool metric = true) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const ImageId image("t/" + std::to_string(i));
      layout.emplace(image, map::LaidOutImage{poses[i], 0, metric});
      sweeps.push_back({image, sweep_at(poses[i], walls)});
    }
  }
  [[nodiscard]] SeenFloor floor() const { return {sweeps, layout}; }
  map::MetricLayout layout;
  std::vector<TourSweep> sweeps;
};

TEST(SeenFloor, AStripInAnEmptyRoomIsFree) {
  const SeenStrip strip =
      Seen({{0.0, 0.5, 0.3}, {4.0, 0.5, 2.0}}, kRoom).floor().strip(0, {0.0, 0.5}, {4.0, 0.5}, kHalf_m, kWithin_m);
  EXPECT_TRUE(strip.free);
  EXPECT_NEAR(strip.clear_m, 2.0, 0.1);  // the ends are a metre from the walls
}

TEST(SeenFloor, AThingInTheStripIsInTheWay) {
  std::vector<Wall> walls = kRoom;
  walls.push_back({{2.0, 0.7}, {2.1, 0.7}});
  const SeenStrip strip =
      Seen({{0.0, 0.5, 0.0}, {4.0, 0.5, 0.0}}, walls).floor().strip(0, {0.0, 0.5}, {4.0, 0.5}, kHalf_m, kWithin_m);
  EXPECT_FALSE(strip.free);
  EXPECT_NEAR(strip.clear_m, 0.4, 0.1);
}

TEST(SeenFloor, UnknownIsNotFree) {
  std::vector<Wall> walls = kRoom;
  walls.push_back({{2.0, -1.0}, {2.0, 2.0}});  // what lies behind this wall nobody has seen
  const SeenFloor floor = Seen({{0.0, 0.5, 0.0}}, walls).floor();
  EXPECT_TRUE(floor.strip(0, {-0.2, 0.5}, {1.2, 0.5}, kHalf_m, kWithin_m).free);
  EXPECT_FALSE(floor.strip(0, {2.7, 0.5}, {4.2, 0.5}, kHalf_m, kWithin_m).free);
}

TEST(SeenFloor, AWallHidesASpotBehindItAndADoorDoesNot) {
  std::vector<Wall> walls = kRoom;
  walls.push_back({{2.0, -1.0}, {2.0, 2.0}});
  const ImageId here("t/0");
  const ImageId there("t/1");
  const std::vector<Pose2> poses = {{1.0, 0.5, 0.4}, {3.0, 0.5, -2.0}};
  EXPECT_TRUE(Seen(poses, walls).floor().hides(here, there, 0.3, 0.2));
  EXPECT_TRUE(Seen(poses, walls).floor().hides(there, here, 0.3, 0.2));
  EXPECT_FALSE(Seen(poses, kRoom).floor().hides(here, there, 0.3, 0.2));
  walls.back() = {{2.0, -1.0}, {2.0, 0.5}};  // half of the wall
  EXPECT_FALSE(Seen(poses, walls).floor().hides(here, there, 0.3, 0.2));
}

TEST(SeenFloor, NothingIsKnownToHideWhatHasNoSweep) {
  EXPECT_FALSE(Seen({{0.0, 0.5, 0.0}}, kRoom).floor().hides(ImageId("t/0"), ImageId("t/1"), 0.3, 0.2));
  EXPECT_FALSE(Seen({{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}}, {}).floor().hides(ImageId("t/0"), ImageId("t/1"), 0.3, 0.2));
}

TEST(SeenFloor, RaysThatCameBackWithNothingSayNothing) {
  const SeenStrip strip =
      Seen({{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}}, {}).floor().strip(0, {0.0, 0.0}, {4.0, 0.0}, kHalf_m, kWithin_m);
  EXPECT_FALSE(strip.free);
}

TEST(SeenFloor, LooksOnlyWhereTheScannerLooks) {
  Seen seen({{0.0, 0.5, 0.0}}, kRoom);
  RangeSweep& sweep = seen.sweeps[0].sweep;  // the half ahead: rays from -90 to 90 degrees
  const std::vector<float> all = sweep.ranges_m;
  sweep.ranges_m.clear();
  for (int i = -90; i <= 90; ++i) sweep.ranges_m.push_back(all[static_cast<std::size_t>((i + 360) % 360)]);
  sweep.angle_min_rad = -kPi / 2.0;
  EXPECT_TRUE(seen.floor().strip(0, {1.0, 0.5}, {3.0, 0.5}, 0.4, kWithin_m).free);
  EXPECT_FALSE(seen.floor().strip(0, {-0.5, 0.5}, {3.0, 0.5}, 0.4, kWithin_m).free);
}

TEST(SeenFloor, KnowsWhereTheScannerStandsOnTheRobot) {
  Seen seen({{0.5, 0.5, kPi}}, kRoom);
  // The same sweep by a scanner that looks the other way, half a metre ahead of the robot's middle.
  seen.sweeps[0].sweep = sweep_at({0.0, 0.5, 0.0}, kRoom);
  seen.sweeps[0].sweep.robot_from_scan = {0.5, 0.0, kPi};
  const SeenStrip strip = seen.floor().strip(0, {0.0, 0.5}, {3.5, 0.5}, kHalf_m, kWithin_m);
  EXPECT_TRUE(strip.free);
  EXPECT_NEAR(strip.clear_m, 2.0, 0.1);
}

TEST(SeenFloor, LeavesOutWhatTheLayoutDoesNotHaveInMetres) {
  const std::vector<Pose2> poses = {{0.0, 0.5, 0.0}, {4.0, 0.5, 0.0}};
  EXPECT_FALSE(Seen(poses, kRoom, false).floor().strip(0, {0.0, 0.5}, {4.0, 0.5}, kHalf_m, kWithin_m).free);
  EXPECT_FALSE(Seen(poses, kRoom).floor().strip(1, {0.0, 0.5}, {4.0, 0.5}, kHalf_m, kWithin_m).free);
  Seen without(poses, kRoom);
  without.layout.clear();
  EXPECT_FALSE(without.floor().strip(0, {0.0, 0.5}, {4.0, 0.5}, kHalf_m, kWithin_m).free);
}

TEST(SeenFloor, SweepsAgreeWhereTheLayoutIsRight) {
  std::vector<Wall> walls = kRoom;
  walls.push_back({{2.0, 1.2}, {2.6, 1.2}});
  Seen seen({{0.0, 0.0, 0.4}, {4.0, 0.0, -2.0}}, walls);
  const ImageId a("t/0");
  const ImageId b("t/1");
  ASSERT_TRUE(seen.floor().agreement(a, b, 30));
  EXPECT_GT(*seen.floor().agreement(a, b, 30), 0.95);
  EXPECT_GT(*seen.floor().agreement(b, a, 30), 0.95);
  seen.layout.at(b).map_from_robot.x_m -= 1.0;
  EXPECT_LT(std::min(*seen.floor().agreement(a, b, 30), *seen.floor().agreement(b, a, 30)), 0.8);
  EXPECT_FALSE(seen.floor().agreement(a, b, 1000));
  EXPECT_FALSE(seen.floor().agreement(a, ImageId("t/9"), 1));
}

}  // namespace
}  // namespace homeward::mapping::seen_floor_test
