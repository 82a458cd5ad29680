// SPDX-License-Identifier: Apache-2.0
#include "exploration/open_directions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/angles.hpp"

namespace homeward::exploration::open_directions_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kRays = 360;
constexpr float kNothing_m = std::numeric_limits<float>::infinity();

/// A sweep all round, one ray a degree; ranges as a function of the angle, -179 to 180 degrees.
RangeSweep sweep_of(const std::function<double(double degrees)>& range_m) {
  RangeSweep sweep;
  sweep.angle_step_rad = 2.0 * kPi / kRays;
  sweep.range_max_m = 30.0;
  for (int i = 0; i < kRays; ++i) {
    sweep.ranges_m.push_back(static_cast<float>(range_m(i <= 180 ? i : i - 360)));
  }
  return sweep;
}

/// `range_m` within `half` degrees of `at`, and `else_m` elsewhere.
RangeSweep one_gap(double at, double half, double range_m, double else_m) {
  return sweep_of([=](double angle) {
    const double off = degrees(wrap_angle(radians(angle - at)));
    return std::abs(off) <= half + 1e-6 ? range_m : else_m;
  });
}

std::vector<OpenDirection> directions(const RangeSweep& sweep, const OpenDirectionsConfig& config = {}) {
  const auto found = open_directions(sweep, config);
  EXPECT_TRUE(found) << (found ? "" : found.error().message);
  return found ? *found : std::vector<OpenDirection>();
}

float& ray_at(RangeSweep& sweep, int angle) { return sweep.ranges_m[static_cast<std::size_t>((angle + 360) % 360)]; }

TEST(OpenDirections, AreTheMiddlesOfOpenSegments) {
  const auto found = directions(one_gap(40.0, 15.0, 8.0, 2.0));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(degrees(found[0].bearing_rad), 40.0, 1e-6);
  EXPECT_NEAR(degrees(found[0].width_rad), 31.0, 1e-6);  // each ray stands for its degree
  EXPECT_NEAR(found[0].range_m, 8.0, 1e-6);
}

TEST(OpenDirections, GoOnAcrossTheSweepsEnds) {
  for (const double at : {0.0, 3.0, -3.0, 179.0}) {
    const auto found = directions(one_gap(at, 10.0, 8.0, 2.0));
    ASSERT_THAT(found, SizeIs(1)) << at;
    EXPECT_NEAR(degrees(found[0].bearing_rad), at, 1e-6);
    EXPECT_NEAR(degrees(found[0].width_rad), 21.0, 1e-6);
  }
}

TEST(OpenDirections, EndWhereASweepDoesThatIsNotClosed) {
  RangeSweep sweep;
  sweep.angle_min_rad = -0.5 * kPi;
  sweep.angle_step_rad = kPi / 180.0;
  sweep.ranges_m.assign(181, 2.0F);
  for (std::size_t i = 0; i < 20; ++i) sweep.ranges_m[i] = sweep.ranges_m[180 - i] = 8.0F;
  const auto found = directions(sweep);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_NEAR(degrees(found[0].bearing_rad), -80.5, 1e-6);  // equal widths: the smallest bearing first
  EXPECT_NEAR(degrees(found[1].bearing_rad), 80.5, 1e-6);
}

TEST(OpenDirections, AreSortedByWidthAndTheBestAreKept) {
  const auto sweep = sweep_of([](double angle) {
    for (int gap = 0; gap < 6; ++gap) {  // at -150, -100, ... 100; each 2 degrees wider than the one before
      if (std::abs(angle - (-150.0 + 50.0 * gap)) <= 6.0 + gap) return 8.0;
    }
    return 2.0;
  });
  const auto found = directions(sweep);
  ASSERT_THAT(found, SizeIs(4));
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(degrees(found[static_cast<std::size_t>(i)].bearing_rad), 100.0 - 50.0 * i, 1e-6);
  }
  EXPECT_THAT(directions(sweep, {.most = 3}), SizeIs(3));
  EXPECT_THAT(directions(sweep, {.most = 9}), SizeIs(6));
}

TEST(OpenDirections, AreAsWideAsTheBody) {
  // 13 degrees at 4 m are 0.91 m wide, 9 degrees 0.63 m.
  EXPECT_THAT(directions(one_gap(90.0, 6.0, 4.0, 1.0)), SizeIs(1));
  EXPECT_THAT(directions(one_gap(90.0, 4.0, 4.0, 1.0)), IsEmpty());
  EXPECT_THAT(directions(one_gap(90.0, 4.0, 4.0, 1.0), {.least_width_m = 0.6}), SizeIs(1));
}

TEST(OpenDirections, ReachAsFarAsTheIntervalSays) {
  auto sweep = one_gap(-60.0, 15.0, 8.0, 2.0);
  for (int angle = 60; angle <= 100; ++angle) ray_at(sweep, angle) = 5.0F;
  EXPECT_THAT(directions(sweep), SizeIs(2));
  EXPECT_THAT(directions(sweep, {.interval_share = 0.3}), SizeIs(1));
  EXPECT_THAT(directions(sweep, {.least_open_m = 6.0}), SizeIs(1));
}

TEST(OpenDirections, LeaveOutWhatIsTooNearAndTooFar) {
  auto sweep = one_gap(40.0, 15.0, 8.0, 2.0);
  for (int angle = 120; angle < 160; ++angle) ray_at(sweep, angle) = 28.0F;  // the thesis saw 32 m in a room of 12 m
  for (int angle = -90; angle < -80; ++angle) ray_at(sweep, angle) = 0.03F;
  const auto found = directions(sweep);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(degrees(found[0].bearing_rad), 40.0, 1e-6);
  EXPECT_THAT(directions(sweep, {.most_range_m = 29.0}), SizeIs(1));  // then it is the longest range
}

TEST(OpenDirections, AreNotCutByASingleBadReturn) {
  const auto clean = directions(one_gap(40.0, 15.0, 8.0, 2.0));
  for (const float bad_m : {0.02F, 1.3F, 13.0F, 29.0F}) {
    auto sweep = one_gap(40.0, 15.0, 8.0, 2.0);
    ray_at(sweep, 45) = bad_m;
    ray_at(sweep, -100) = bad_m;
    const auto found = directions(sweep);
    ASSERT_THAT(found, SizeIs(1)) << bad_m;
    EXPECT_EQ(found[0].bearing_rad, clean[0].bearing_rad) << bad_m;
    EXPECT_EQ(found[0].width_rad, clean[0].width_rad) << bad_m;
    EXPECT_EQ(found[0].range_m, clean[0].range_m) << bad_m;
  }
}

TEST(OpenDirections, AreCutByAnObstacleOfTwoRays) {
  auto sweep = one_gap(40.0, 15.0, 8.0, 2.0);
  ray_at(sweep, 40) = ray_at(sweep, 41) = 1.3F;
  EXPECT_THAT(directions(sweep), SizeIs(2));
}

TEST(OpenDirections, TakeNothingForFarBesideAFarReturnOnly) {
  // A corridor: its walls are seen up to 12 m away, its end is out of reach.
  RangeSweep corridor = sweep_of([](double angle) {
    const double across = std::abs(std::sin(radians(angle)));
    const double range_m = 1.0 / std::max(1e-9, across);
    return range_m < 12.0 ? range_m : static_cast<double>(kNothing_m);
  });
  corridor.range_max_m = 12.0;
  const auto found = directions(corridor, {.least_width_m = 0.8});
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_NEAR(found[0].bearing_rad, 0.0, 1e-6);
  EXPECT_NEAR(found[1].bearing_rad, kPi, 1e-6);
  EXPECT_GE(found[0].range_m, 6.0);
  // A pane in a wall 3 m away: as many rays that met nothing, and no direction through it.
  RangeSweep pane = one_gap(40.0, 10.0, kNothing_m, 3.0);
  for (int angle = -120; angle < -80; ++angle) ray_at(pane, angle) = 5.0F;
  pane.range_max_m = 12.0;
  for (const OpenDirection& direction : directions(pane)) {
    EXPECT_GT(std::abs(wrap_angle(direction.bearing_rad - radians(40.0))), radians(10.0));
  }
}

TEST(OpenDirections, AreNoneWhereNothingIsKnown) {
  EXPECT_THAT(directions(sweep_of([](double) { return static_cast<double>(kNothing_m); })), IsEmpty());
  EXPECT_THAT(directions(sweep_of([](double) { return 0.01; })), IsEmpty());
}

TEST(OpenDirections, AreOneAlongTheLongestRangeWhereAllIsOpen) {
  const auto found = directions(sweep_of([](double angle) { return 6.0 + std::cos(radians(angle - 70.0)); }));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(degrees(found[0].bearing_rad), 70.0, 1e-6);
  EXPECT_NEAR(found[0].width_rad, 2.0 * kPi, 1e-9);
  EXPECT_NEAR(found[0].range_m, 5.0, 1e-6);
}

TEST(OpenDirections, AreInTheRobotsFrame) {
  RangeSweep turned = one_gap(40.0, 15.0, 8.0, 2.0);
  turned.robot_from_scan.theta_rad = radians(150.0);
  EXPECT_NEAR(degrees(directions(turned)[0].bearing_rad), -170.0, 1e-6);
  // A scanner 0.5 m before the middle: what is 8 m to its left is a little ahead of the robot's left.
  RangeSweep ahead = one_gap(90.0, 15.0, 8.0, 2.0);
  ahead.robot_from_scan.x_m = 0.5;
  EXPECT_NEAR(directions(ahead)[0].bearing_rad, std::atan2(8.0, 0.5), 1e-6);
}

TEST(OpenDirections, RefuseSweepsThatAreNone) {
  EXPECT_EQ(open_directions(RangeSweep{}).error().code, ErrorCode::kEmptyInput);
  RangeSweep still;
  still.ranges_m = {1.0F, 2.0F};
  EXPECT_EQ(open_directions(still).error().code, ErrorCode::kInvalidInput);
  RangeSweep twice;
  twice.ranges_m.assign(720, 1.0F);
  twice.angle_step_rad = 2.0 * kPi / 360;
  EXPECT_EQ(open_directions(twice).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::exploration::open_directions_test
