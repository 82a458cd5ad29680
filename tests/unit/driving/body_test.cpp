// SPDX-License-Identifier: Apache-2.0
#include "driving/body.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/pose2.hpp"

namespace homeward::driving::body_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Body chair() {
  Body body;
  body.outline = {0.0, 0.25, 0.85, 0.325};
  return body;
}

Points seen_by(const Points& world, const Pose2& robot) {
  Points seen;
  for (const Eigen::Vector2d& point : world) {
    const Pose2 at = inverse(robot) * Pose2{point.x(), point.y(), 0.0};
    seen.emplace_back(at.x_m, at.y_m);
  }
  return seen;
}

/// Walls of random length and single posts around a robot that stands free at the origin.
Points cluttered(const Body& body, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across_m(-3.0, 3.0);
  std::uniform_real_distribution<double> angle_rad(-kPi, kPi);
  Points points;
  const auto add = [&](const Eigen::Vector2d& point) {
    if (clearance_m(body, Points{point}) > 0.1) points.push_back(point);
  };
  for (int wall = 0; wall < 5; ++wall) {
    const Eigen::Vector2d from(across_m(random), across_m(random));
    const double angle = angle_rad(random);
    for (int i = 0; i < 40; ++i) add(from + 0.06 * i * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (int post = 0; post < 15; ++post) add({across_m(random), across_m(random)});
  return points;
}

/// What a robot of that body does with commands: bounded acceleration, each command a little late.
struct SimulatedBody {
  Pose2 pose;
  Motion motion;

  void advance(const Motion& command, const Body& body, double dt_s) {
    const auto nearer = [&](double now, double wanted, double rise, double fall) {
      const double step = std::abs(wanted) < std::abs(now) || now * wanted < 0.0 ? fall : rise;
      return now + std::clamp(wanted - now, -step, step);
    };
    motion.speed_mps = nearer(motion.speed_mps, command.speed_mps, 0.5 * dt_s, body.deceleration_mps2 * dt_s);
    motion.turn_radps = nearer(motion.turn_radps, command.turn_radps, 2.5 * dt_s, 5.0 * dt_s);
    pose = pose * Pose2{motion.speed_mps * dt_s, 0.0, motion.turn_radps * dt_s};
  }
};

/// Least clearance of a body that is to drive at random through clutter, a sweep every 100 ms.
double least_clearance_m(const Body& body, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Points world = cluttered(body, random);
  std::uniform_real_distribution<double> speed_mps(-0.2, 1.5);
  std::uniform_real_distribution<double> turn_radps(-2.0, 2.0);
  SimulatedBody robot;
  Motion wanted;
  double least_m = 100.0;
  for (int tick = 0; tick < 120; ++tick) {
    if (tick % 15 == 0) wanted = {speed_mps(random), turn_radps(random)};
    const Motion safe = made_safe(wanted, body, seen_by(world, robot.pose));
    for (int k = 0; k < 5; ++k) {
      robot.advance(safe, body, 0.02);
      least_m = std::min(least_m, clearance_m(body, seen_by(world, robot.pose)));
    }
  }
  return least_m;
}

TEST(MadeSafe, NeverLetsADiscTouchAnything) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) EXPECT_GT(least_clearance_m({}, seed), 0.0) << "seed " << seed;
}

TEST(MadeSafe, NeverLetsAChairTouchAnything) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) EXPECT_GT(least_clearance_m(chair(), seed), 0.0) << "seed " << seed;
}

TEST(MadeSafe, LeavesAFreeMotionAlone) {
  const Motion wanted{0.6, 0.3};
  const Motion safe = made_safe(wanted, {}, {});
  EXPECT_DOUBLE_EQ(safe.speed_mps, 0.6);
  EXPECT_DOUBLE_EQ(safe.turn_radps, 0.3);
}

TEST(MadeSafe, KeepsToTheBodysOwnLimits) {
  const Body body;
  const Motion safe = made_safe({9.0, -9.0}, body, {});
  EXPECT_DOUBLE_EQ(safe.speed_mps, body.max_speed_mps);
  EXPECT_DOUBLE_EQ(safe.turn_radps, -body.max_turn_radps);
  EXPECT_GE(made_safe({-9.0, 0.0}, body, {}).speed_mps, -0.2);
}

TEST(MadeSafe, BackwardsASlowBodyKeepsToItsOwnLimitToo) {
  Body body;
  EXPECT_DOUBLE_EQ(made_safe({-1.0, 0.0}, body, {}).speed_mps, -0.2);
  body.max_speed_mps = 0.05;
  EXPECT_DOUBLE_EQ(made_safe({-1.0, 0.0}, body, {}).speed_mps, -0.05);
}

TEST(MadeSafe, StopsBeforeAWallAndSlowsOnTheWayToIt) {
  double before_mps = 100.0;
  for (const double ahead_m : {3.0, 1.0, 0.7, 0.55, 0.45}) {
    Points wall;
    for (int i = -30; i <= 30; ++i) wall.emplace_back(ahead_m, 0.05 * i);
    const Motion safe = made_safe({0.8, 0.0}, {}, wall);
    EXPECT_LE(safe.speed_mps, before_mps) << ahead_m;
    EXPECT_LE(safe.speed_mps * 0.25 + 0.5 * safe.speed_mps * safe.speed_mps, ahead_m - 0.35) << ahead_m;
    before_mps = safe.speed_mps;
  }
  EXPECT_DOUBLE_EQ(made_safe({0.8, 0.0}, {}, Points{{0.36, 0.0}}).speed_mps, 0.0);
}

TEST(MadeSafe, SlowsBesideThingsToo) {
  Points wall;
  for (int i = -40; i <= 40; ++i) wall.emplace_back(0.05 * i, 0.5);
  const double beside_mps = made_safe({0.8, 0.0}, {}, wall).speed_mps;
  EXPECT_GT(beside_mps, 0.05);
  EXPECT_LT(beside_mps, 0.4);
}

TEST(MadeSafe, LetsABodyThatStandsTooNearDriveAway) {
  const Points behind = {{-0.36, 0.0}};
  EXPECT_GT(made_safe({0.3, 0.0}, {}, behind).speed_mps, 0.05);
  EXPECT_GE(made_safe({-0.2, 0.0}, {}, behind).speed_mps, 0.0);
}

TEST(MadeSafe, TurnsAChairOnlyWhereItsNoseHasRoom) {
  // A post beside the footrest: turning towards it would hit it, turning away is fine.
  const Points post = {{0.6, 0.385}};
  EXPECT_DOUBLE_EQ(made_safe({0.0, 0.8}, chair(), post).turn_radps, 0.0);
  EXPECT_LT(made_safe({0.0, -0.8}, chair(), post).turn_radps, -0.2);
}

TEST(MadeSafe, LetsAChairBesideAWallGetOnByAnotherBend) {
  Points wall;  // 6 cm beside it; the bend that is wanted would bring a corner into the margin
  for (int i = -60; i <= 60; ++i) wall.emplace_back(0.03 * i, 0.385);
  const Motion safe = made_safe({0.2, 0.6}, chair(), wall);
  EXPECT_GT(safe.speed_mps, 0.02);
  EXPECT_LT(std::abs(safe.turn_radps), 0.3);
  // Between two walls so near that no bend is free it may still go straight, either way.
  for (int i = -60; i <= 60; ++i) wall.emplace_back(0.03 * i, -0.385);
  EXPECT_GT(made_safe({0.2, 0.6}, chair(), wall).speed_mps, 0.02);
  EXPECT_LT(made_safe({-0.2, 0.6}, chair(), wall).speed_mps, -0.02);
}

TEST(MadeSafe, LetsAChairInADoorGoOnStraightWhereEveryBendLeadsNearer) {
  Points door;  // 4 cm to each side: nearer than the margin
  for (int i = -60; i <= 60; ++i) {
    door.emplace_back(0.03 * i, 0.365);
    door.emplace_back(0.03 * i, -0.365);
  }
  for (const double speed_mps : {0.2, -0.2}) {
    const Motion safe = made_safe({speed_mps, 0.17}, chair(), door);
    EXPECT_GT(safe.speed_mps / speed_mps, 0.1);
    EXPECT_EQ(safe.turn_radps, 0.0);
  }
}

TEST(MadeSafe, KeepsTheBendOfALongBodyThatItSlows) {
  const Points beside = {{0.3, 0.6}};
  const Motion safe = made_safe({0.8, -0.8}, chair(), beside);
  ASSERT_LT(safe.speed_mps, 0.7);
  EXPECT_NEAR(safe.turn_radps / safe.speed_mps, -1.0, 1e-9);
}

TEST(MadeSafe, BendsALongBodyPastAPostOnlyWhereItTurnsThatWayAlready) {
  // Before the left corner of its front, 5 cm on: straight ahead leads to it, a sharp bend to the right past it.
  const Points post = {{0.90, 0.33}};
  const Motion wanted{0.1, -0.3};
  const Motion turning_right = made_safe(wanted, chair(), post, -0.4);
  EXPECT_GT(turning_right.speed_mps, 0.02);
  EXPECT_LT(turning_right.turn_radps, -0.2);
  EXPECT_EQ(made_safe(wanted, chair(), post, 0.0).speed_mps, 0.0);
}

TEST(ClearanceOfABody, IsToItsOutline) {
  EXPECT_NEAR(clearance_m(chair(), Points{{1.51, 0.0}}), 0.66, 1e-12);
  EXPECT_NEAR(clearance_m(chair(), Points{{0.3, -0.425}}), 0.1, 1e-12);
  EXPECT_NEAR(clearance_m(chair(), Points{{-0.29, 0.355}}), 0.05, 1e-12);  // off a rear corner
  EXPECT_NEAR(clearance_m(chair(), Points{{0.88, -0.365}}), 0.05, 1e-12);  // off a front corner
  EXPECT_NEAR(clearance_m(chair(), Points{{-0.2, 0.3}}), -0.025, 1e-12);   // inside: to the nearest edge
  EXPECT_NEAR(clearance_m({{0.1, 0.25, 0.85, 0.225}}, Points{{0.88, -0.365}}), std::hypot(0.03, 0.14) - 0.1, 1e-12);
  EXPECT_NEAR(clearance_m({}, Points{{0.1, 0.0}}), -0.25, 1e-12);
  EXPECT_GT(clearance_m({}, {}), 10.0);
}

TEST(HitPoints, AreWhereTheRaysEndAndNowhereElse) {
  Scan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / 2.0;
  scan.range_max_m = 10.0;
  const float infinity = std::numeric_limits<float>::infinity();
  scan.ranges_m = {2.0F, 3.0F, infinity, std::numeric_limits<float>::quiet_NaN(), 10.0F, 0.0F};
  const Points points = hit_points(scan);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_LT((points[0] - Eigen::Vector2d(0.0, -2.0)).norm(), 1e-9);
  EXPECT_LT((points[1] - Eigen::Vector2d(3.0, 0.0)).norm(), 1e-9);
}

TEST(HitPoints, StartWhereTheScannerSits) {
  Scan scan;
  scan.angle_step_rad = kPi / 2.0;
  scan.ranges_m = {2.0F, 3.0F};
  scan.robot_from_scan = {0.5, -0.25, kPi / 2.0};
  const Points points = hit_points(scan);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_LT((points[0] - Eigen::Vector2d(0.5, 1.75)).norm(), 1e-6);
  EXPECT_LT((points[1] - Eigen::Vector2d(-2.5, -0.25)).norm(), 1e-6);
}

Scan scan_of(double from_deg, double to_deg, double scanner_deg = 0.0) {
  Scan scan;
  scan.ranges_m.assign(181, 3.0F);
  scan.angle_min_rad = radians(from_deg);
  scan.angle_step_rad = radians((to_deg - from_deg) / 180.0);
  scan.robot_from_scan.theta_rad = radians(scanner_deg);
  return scan;
}

TEST(LooksBehind, WhoLooksAllAround) {
  EXPECT_TRUE(looks_behind(scan_of(0.0, 360.0)));
  EXPECT_TRUE(looks_behind(scan_of(-180.0, 180.0, 90.0)));
  EXPECT_TRUE(looks_behind(scan_of(180.0, -180.0)));  // clockwise
}

TEST(LooksBehind, NotWhoLooksAhead) {
  EXPECT_FALSE(looks_behind(scan_of(-90.0, 90.0)));
  EXPECT_FALSE(looks_behind(scan_of(-135.0, 135.0)));
  EXPECT_FALSE(looks_behind(scan_of(135.0, -135.0)));
  EXPECT_FALSE(looks_behind(Scan()));
}

TEST(LooksBehind, WhoIsMountedBackwards) {
  EXPECT_TRUE(looks_behind(scan_of(-90.0, 90.0, 180.0)));
  EXPECT_TRUE(looks_behind(scan_of(-61.0, 61.0, 180.0)));
  EXPECT_FALSE(looks_behind(scan_of(-58.0, 58.0, 180.0)));
  EXPECT_FALSE(looks_behind(scan_of(-90.0, 90.0, 140.0)));
}

TEST(LooksBehind, NotByAHandfulOfRays) {
  Scan scan;
  scan.ranges_m.assign(8, 3.0F);
  scan.angle_step_rad = 2.0 * kPi / 8.0;
  EXPECT_FALSE(looks_behind(scan));
}

}  // namespace
}  // namespace homeward::driving::body_test
