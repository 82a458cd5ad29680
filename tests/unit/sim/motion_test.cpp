// SPDX-License-Identifier: Apache-2.0
#include "sim/motion.hpp"

#include <gtest/gtest.h>

#include "sim/floor.hpp"
#include "support/box_world.hpp"

namespace homeward::sim::motion_test {
namespace {

constexpr double kTick_s = 0.05;

TEST(Vehicle, SpeedsUpSlowsDownAndKeepsItsLimits) {
  World world = homeward::testing::box_world();
  const Obstacles obstacles(world);
  RobotProfile profile = disc_profile();
  Vehicle vehicle(profile, {-1.6, 0.0, 0.0}, 1);
  double before = 0.0;
  for (int k = 0; k < 20; ++k) {
    vehicle.advance(kTick_s, {5.0, 0.0}, obstacles, {});
    EXPECT_LE(vehicle.motion().speed_mps - before, profile.acceleration_mps2 * kTick_s + 1e-12);
    EXPECT_LE(vehicle.motion().speed_mps, profile.max_speed_mps);
    before = vehicle.motion().speed_mps;
  }
  EXPECT_NEAR(before, 0.5, 1e-9);  // 1 s at 0.5 m/s^2
  int ticks = 0;
  while (vehicle.motion().speed_mps > 1e-9 && ticks < 100) {
    vehicle.advance(kTick_s, {}, obstacles, {});
    EXPECT_LE(before - vehicle.motion().speed_mps, profile.deceleration_mps2 * kTick_s + 1e-12);
    before = vehicle.motion().speed_mps;
    ++ticks;
  }
  EXPECT_EQ(ticks, 10);  // 0.5 s at 1 m/s^2
  EXPECT_EQ(vehicle.collisions(), 0);
}

TEST(Vehicle, DrivesAnArcAsItIsTold) {
  const World world = homeward::testing::box_world();
  const Obstacles obstacles(world);
  RobotProfile profile = disc_profile();
  profile.acceleration_mps2 = profile.turn_acceleration_radps2 = 1e6;
  Vehicle vehicle(profile, {0.0, -0.5, 0.0}, 1);
  for (int k = 0; k < 40; ++k) vehicle.advance(kTick_s, {0.2, 0.5 * kPi / 2.0}, obstacles, {});  // 2 s: a quarter
  const double radius_m = 0.2 / (0.5 * kPi / 2.0);
  EXPECT_NEAR(vehicle.pose().x_m, radius_m, 1e-6);
  EXPECT_NEAR(vehicle.pose().y_m, -0.5 + radius_m, 1e-6);
  EXPECT_NEAR(vehicle.pose().theta_rad, kPi / 2.0, 1e-9);
  EXPECT_NEAR(vehicle.path_m(), 0.4, 1e-9);
}

TEST(Vehicle, IsCarriedWithoutItsOdometryNoticing) {
  const World world = homeward::testing::box_world();
  const Obstacles obstacles(world);
  Vehicle vehicle(disc_profile(), {-1.2, 0.7, 0.0}, 1);
  for (int k = 0; k < 20; ++k) vehicle.advance(kTick_s, {0.4, 0.0}, obstacles, {});
  const Pose2 odometry = vehicle.odometry();
  const double path_m = vehicle.path_m();
  vehicle.carry_to({1.0, -0.8, 2.0});
  EXPECT_DOUBLE_EQ(vehicle.pose().x_m, 1.0);
  EXPECT_DOUBLE_EQ(vehicle.pose().y_m, -0.8);
  EXPECT_DOUBLE_EQ(vehicle.pose().theta_rad, 2.0);
  EXPECT_DOUBLE_EQ(vehicle.odometry().x_m, odometry.x_m);
  EXPECT_DOUBLE_EQ(vehicle.odometry().theta_rad, odometry.theta_rad);
  vehicle.advance(kTick_s, {0.4, 0.0}, obstacles, {});
  EXPECT_LT(std::hypot(vehicle.odometry().x_m - odometry.x_m, vehicle.odometry().y_m - odometry.y_m), 0.01);
  EXPECT_LT(vehicle.path_m() - path_m, 0.01) << "the lift is no way driven";
  EXPECT_EQ(vehicle.collisions(), 0);
}

TEST(Vehicle, NeverPassesThroughWallsAndCountsOneCollision) {
  const World world = homeward::testing::box_world();
  const Obstacles obstacles(world);
  Vehicle vehicle(disc_profile(), {0.0, 0.0, 0.0}, 1);
  for (int k = 0; k < 200; ++k) {
    vehicle.advance(kTick_s, {0.8, 0.0}, obstacles, {});
    EXPECT_LE(vehicle.pose().x_m, 2.0 - 0.35 + 1e-9);  // touching is the most
  }
  EXPECT_EQ(vehicle.collisions(), 1);  // leaning on the wall is one collision
  EXPECT_LE(vehicle.min_clearance_m(), 0.0);
  for (int k = 0; k < 40; ++k) vehicle.advance(kTick_s, {-0.2, 0.0}, obstacles, {});
  EXPECT_LT(vehicle.pose().x_m, 1.5);  // away is possible
  for (int k = 0; k < 200; ++k) vehicle.advance(kTick_s, {0.8, 0.0}, obstacles, {});
  EXPECT_EQ(vehicle.collisions(), 2);
  vehicle.reset_counts();
  EXPECT_EQ(vehicle.collisions(), 0);
  EXPECT_EQ(vehicle.path_m(), 0.0);
}

TEST(Vehicle, RandomDrivingStaysOutsideThings) {
  const World world = homeward::testing::box_world(true);
  const Obstacles obstacles(world);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> speed(-1.0, 1.0);
  std::uniform_real_distribution<double> turn(-2.0, 2.0);
  for (const RobotProfile& profile : {disc_profile(), chair_profile()}) {
    Vehicle vehicle(profile, world.start, 1);
    for (int k = 0; k < 1500; ++k) {
      vehicle.advance(kTick_s, {speed(random), turn(random)}, obstacles, {});
      EXPECT_GT(obstacles.clearance_m(profile, vehicle.pose(), {}), 0.0) << profile.name;
    }
  }
}

TEST(Obstacles, AreMeasuredExactlyAndInCellsNearlySo) {
  const World world = homeward::testing::box_world(true);
  const Obstacles obstacles(world);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> across_m(-1.2, 1.2);
  std::uniform_real_distribution<double> heading_rad(-kPi, kPi);
  // The walls of the room and of the half wall.
  const std::array<std::array<Eigen::Vector2d, 2>, 7> walls = {{{{{-2.0, -1.5}, {2.0, -1.5}}},
                                                                {{{2.0, -1.5}, {2.0, 1.5}}},
                                                                {{{2.0, 1.5}, {-2.0, 1.5}}},
                                                                {{{-2.0, 1.5}, {-2.0, -1.5}}},
                                                                {{{-0.05, 1.5}, {-0.05, 0.0}}},
                                                                {{{-0.05, 0.0}, {0.05, 0.0}}},
                                                                {{{0.05, 0.0}, {0.05, 1.5}}}}};
  int clear = 0;
  for (int k = 0; k < 400; ++k) {
    const Pose2 pose{across_m(random), across_m(random), heading_rad(random)};
    const Pose2 robot_from_world = inverse(pose);
    for (const RobotProfile& robot : {disc_profile(), chair_profile()}) {
      double nearest_m = 1e9;
      for (const auto& [from_m, to_m] : walls) {
        const auto from_robot_m = [&](double share) {
          const Eigen::Vector2d at_m = from_m + (to_m - from_m) * share;
          return distance_m(robot.outline, position_m(robot_from_world * Pose2{at_m.x(), at_m.y(), 0.0}));
        };
        // The outline is convex, and so is its distance along a straight line.
        double low = 0.0;
        double high = 1.0;
        for (int i = 0; i < 40; ++i) {
          const double third = (high - low) / 3.0;
          if (from_robot_m(low + third) < from_robot_m(high - third)) {
            high -= third;
          } else {
            low += third;
          }
        }
        nearest_m = std::min({nearest_m, from_robot_m(0.0), from_robot_m(low), from_robot_m(1.0)});
      }
      if (nearest_m < -0.02) continue;  // how deep in a wall does not matter
      ++clear;
      EXPECT_NEAR(obstacles.clearance_m(robot, pose, {}), nearest_m, 1e-3) << robot.name;
      const double cells_m = obstacles.clearance_of_cells_m(robot, pose);
      EXPECT_GT(cells_m, nearest_m - 0.07) << robot.name;
      EXPECT_LT(cells_m, nearest_m + 0.012) << robot.name;
    }
  }
  EXPECT_GT(clear, 150);
}

TEST(Obstacles, AreFeltAtTheRearCornersAndWherePeopleAndBoxesAre) {
  const RobotProfile chair = chair_profile();
  // Its rear corners count, which no disc along its middle reaches, and so do people beside its front.
  const std::vector<Person> beside = {{0.85, 0.325 + kPersonRadius_m + 0.02, 7}};
  Obstacles obstacles(homeward::testing::box_world());
  EXPECT_NEAR(obstacles.clearance_m(chair, {0.0, 0.0, 0.0}, beside), 0.02, 1e-9);
  EXPECT_NEAR(obstacles.clearance_m(chair, {0.0, 1.5 - 0.335, 0.0}, {}), 0.01, 1e-6);
  EXPECT_NEAR(obstacles.clearance_m(chair, {0.0, 0.0, 0.0}, {}), 2.0 - 0.85, 1e-6);
  obstacles.set_boxes({Box{{-0.55, 0.0, 0.0}}});
  EXPECT_NEAR(obstacles.clearance_m(chair, {0.0, 0.0, 0.0}, {}), 0.05, 1e-6);
  obstacles.set_boxes({});
  EXPECT_NEAR(obstacles.clearance_m(chair, {0.0, 0.0, 0.0}, {}), 2.0 - 0.85, 1e-6);
}

TEST(Vehicle, SomebodyWhoWalksIntoAStandingRobotIsNoCollision) {
  const World world = homeward::testing::box_world();
  const Obstacles obstacles(world);
  Vehicle vehicle(disc_profile(), {0.0, 0.0, 0.0}, 1);
  const std::vector<Person> touching = {{0.5, 0.0, 7}};
  ASSERT_LT(obstacles.clearance_m(vehicle.profile(), vehicle.pose(), touching), 0.0);
  for (int k = 0; k < 10; ++k) vehicle.advance(kTick_s, {}, obstacles, touching);
  EXPECT_EQ(vehicle.collisions(), 0);
  vehicle.advance(kTick_s, {0.8, 0.0}, obstacles, touching);  // driving on into them is one
  EXPECT_EQ(vehicle.collisions(), 1);
  EXPECT_EQ(vehicle.pose().x_m, 0.0);
}

TEST(WheelOdometry, DriftsALittleAndTheSameForTheSameSeed) {
  WheelOdometry one(3);
  WheelOdometry two(3);
  Pose2 pose;
  for (int k = 0; k < 200; ++k) {
    const Pose2 next = pose * Pose2{0.05, 0.0, k < 100 ? 0.01 : -0.01};
    one.follow(pose, next);
    two.follow(pose, next);
    pose = next;
  }
  const double off_m = std::hypot(one.reading().x_m - pose.x_m, one.reading().y_m - pose.y_m);
  EXPECT_GT(off_m, 0.001);
  EXPECT_LT(off_m, 0.8);  // of 10 m
  EXPECT_EQ(one.reading().x_m, two.reading().x_m);
  EXPECT_EQ(one.reading().theta_rad, two.reading().theta_rad);
}

TEST(Walkers, StayOnTheFloorAndKeepAwayFromTheRobot) {
  const World world = homeward::testing::box_world();
  const Pose2 robot{-1.3, 0.0, 0.0};
  Walkers walkers(world, 2, 9, robot);
  ASSERT_EQ(walkers.people().size(), 2U);
  double walked_m = 0.0;
  for (int k = 0; k < 400; ++k) {
    const auto before = walkers.people();
    walkers.advance(0.1, robot);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Person& person = walkers.people()[i];
      const double step_m = std::hypot(person.x_m - before[i].x_m, person.y_m - before[i].y_m);
      walked_m += step_m;
      EXPECT_LE(step_m, 1.1 * 0.1 + 1e-9);
      EXPECT_TRUE(is_set(world.drivable, {person.x_m, person.y_m}));
      const double now_m = std::hypot(person.x_m - robot.x_m, person.y_m - robot.y_m);
      if (step_m > 0.0 && now_m < 0.9) {
        EXPECT_GE(now_m, std::hypot(before[i].x_m - robot.x_m, before[i].y_m - robot.y_m) - 1e-9);
      }
    }
  }
  EXPECT_GT(walked_m, 2.0);
}

/// Nothing but a floor of so many metres, free from wall to wall.
World bare_floor(double length_m, double width_m) {
  World world;
  world.drivable.width = static_cast<int>(std::lround(length_m / world.drivable.resolution_m));
  world.drivable.height = static_cast<int>(std::lround(width_m / world.drivable.resolution_m));
  world.drivable.cells.assign(
      static_cast<std::size_t>(world.drivable.width) * static_cast<std::size_t>(world.drivable.height), 255);
  return world;
}

/// How often anybody gets from one side of the robot to the other along x in so many seconds.
int passes(Walkers& walkers, const Pose2& robot, double seconds) {
  constexpr double kPast_m = 1.5;
  std::vector<int> sides(walkers.people().size(), 0);
  int count = 0;
  for (double t_s = 0.0; t_s < seconds; t_s += 0.1) {
    walkers.advance(0.1, robot);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double along_m = walkers.people()[i].x_m - robot.x_m;
      if (std::abs(along_m) < kPast_m) continue;
      const int side = along_m > 0.0 ? 1 : -1;
      if (side + sides[i] == 0) ++count;
      sides[i] = side;
    }
  }
  return count;
}

TEST(Walkers, GoRoundTheRobotWhereThereIsRoom) {
  // The middle, where ways keep to, is closed by the robot; beside it is a metre more.
  const World world = bare_floor(8.0, 2.2);
  const Pose2 robot{4.0, 0.8, 0.0};
  Walkers walkers(world, 2, 5, robot);
  EXPECT_GE(passes(walkers, robot, 300.0), 15);
}

TEST(Walkers, KeepAsFarFromAllOfALongBody) {
  const World world = bare_floor(6.0, 6.0);
  const Pose2 robot{3.0, 3.0, 0.7};
  const Outline body = chair_profile().outline;
  Walkers walkers(world, 3, 5, robot);
  double nearest_m = 100.0;
  for (int k = 0; k < 3000; ++k) {
    walkers.advance(0.1, robot, body);
    for (const Person& person : walkers.people()) {
      const Pose2 seen = inverse(robot) * Pose2{person.x_m, person.y_m, 0.0};
      nearest_m = std::min(nearest_m, distance_m(body, {seen.x_m, seen.y_m}));
    }
  }
  EXPECT_GE(nearest_m, 0.9 - 0.35 - 1e-6);
  EXPECT_LT(nearest_m, 0.8) << "nobody came near";
}

TEST(Walkers, DoNotPushPastTheRobotWhereThereIsNone) {
  const World world = bare_floor(8.0, 1.2);
  const Pose2 robot{4.0, 0.6, 0.0};
  Walkers walkers(world, 2, 5, robot);
  EXPECT_EQ(passes(walkers, robot, 300.0), 0);
}

TEST(Walkers, GetPastARobotThatHasComeNearerThanTheyLike) {
  const World world = bare_floor(8.0, 1.6);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Walkers walkers(world, 1, seed, {0.0, 0.8, 0.0});
    const Person& person = walkers.people()[0];
    const Pose2 robot{4.0, person.y_m > 0.8 ? 0.05 : 1.55, 0.0};
    // Nobody can stand farther from it than 0.75 m beside it, in the middle where ways lead.
    double nearest_m = 100.0;
    int crossed = 0;
    for (int k = 0; k < 30; ++k) {
      crossed += passes(walkers, robot, 10.0);
      nearest_m = std::min(nearest_m, std::hypot(person.x_m - robot.x_m, person.y_m - robot.y_m));
    }
    EXPECT_GE(crossed, 1) << seed;
    EXPECT_GE(nearest_m, 0.65 - 1e-6) << seed;
  }
}

}  // namespace
}  // namespace homeward::sim::motion_test
