// SPDX-License-Identifier: Apache-2.0
#include "mapping/track.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.hpp"
#include "support/posed_drive.hpp"

namespace homeward::mapping::track_test {
namespace {

using homeward::testing::PosedDrive;
using homeward::testing::seen_between;

/// A drive with what pictures and odometry tell of it: both exact unless a test spoils one.
struct Drive : PosedDrive {
  [[nodiscard]] TourTrack track(bool metric, double place_extent) const {
    return TourTrack(images, tour_of, pairs, metric, place_extent, {});
  }
};

Drive drive(const std::vector<Pose2>& truth) {
  Drive result;
  result.pairs = PairTable(static_cast<int>(truth.size()));
  for (std::size_t b = 0; b < truth.size(); ++b) {
    result.add(truth[b], truth[b]);
    for (std::size_t a = b < 2 ? 0 : b - 2; a < b; ++a) {
      result.pairs.set(static_cast<int>(a), static_cast<int>(b), seen_between(truth[a], truth[b]));
    }
  }
  return result;
}

/// Around a square of this many 0.4 m steps a side, turning on the spot in the corners, back to the start.
std::vector<Pose2> around_a_square(int steps) {
  std::vector<Pose2> poses{{}};
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < steps; ++i) poses.push_back(poses.back() * Pose2{0.4, 0.0, 0.0});
    for (int i = 0; i < 3; ++i) poses.push_back(poses.back() * Pose2{0.0, 0.0, kPi / 6.0});
  }
  return poses;
}

/// Odometry whose heading drifts by so much a step.
void drift(Drive& drive, double per_step_rad) {
  for (std::size_t i = 1; i < drive.images.size(); ++i) {
    Pose2 step = inverse(drive.truth[i - 1]) * drive.truth[i];
    step.theta_rad += per_step_rad;
    drive.images[i].odometry = *drive.images[i - 1].odometry * step;
  }
}

TEST(TourTrack, TurnsOfThePicturesUndoTheDriftOfOdometry) {
  Drive square = drive(around_a_square(10));
  drift(square, 0.01);
  const int last = static_cast<int>(square.images.size()) - 1;
  const Pose2& drifted = *square.images.back().odometry;
  ASSERT_GT(std::hypot(drifted.x_m, drifted.y_m), 0.7);  // odometry alone misses the start
  const TrackPrediction closed = square.track(true, 1.0).predict(0, last);
  EXPECT_TRUE(closed.known);
  EXPECT_LT(closed.distance, 0.05);
  EXPECT_NEAR(wrap_angle(closed.turn_rad), 0.0, 1e-5);
  EXPECT_GT(closed.distance_sigma, 0.0);
  EXPECT_EQ(square.track(true, 1.0).judge(0, last).verdict, TrackVerdict::kAgrees);
}

TEST(TourTrack, KeepsFarImagesApartHoweverAlikeTheyAre) {
  Drive square = drive(around_a_square(10));
  PairRelation alike = seen_between(square.truth[5], square.truth[5]);
  square.pairs.set(5, 31, alike);  // the middle of two opposite sides, 4 m apart
  const TourTrack track = square.track(true, 1.0);
  EXPECT_EQ(track.judge(5, 31).verdict, TrackVerdict::kContradicts);
  EXPECT_EQ(track.judge(31, 5).verdict, TrackVerdict::kContradicts);
}

TEST(TourTrack, AVerifiedTurnThatTheWayExcludesContradicts) {
  Drive square = drive(around_a_square(10));
  const int last = static_cast<int>(square.images.size()) - 1;
  PairRelation turned = seen_between(square.truth.front(), square.truth.back());
  EXPECT_EQ(square.track(true, 1.0).judge(0, last).verdict, TrackVerdict::kAgrees);
  turned.turn_rad = 3.1F;  // the room on the other side of the corridor, seen entering
  square.pairs.set(0, last, turned);
  EXPECT_EQ(square.track(true, 1.0).judge(0, last).verdict, TrackVerdict::kContradicts);
}

TEST(TourTrack, SeesTheSameFromBothEnds) {
  const Drive square = drive(around_a_square(6));
  const TourTrack track = square.track(true, 1.0);
  const TrackPrediction there = track.predict(2, 11);
  const TrackPrediction back = track.predict(11, 2);
  EXPECT_EQ(there.distance, back.distance);
  EXPECT_EQ(there.distance_sigma, back.distance_sigma);
  EXPECT_DOUBLE_EQ(there.turn_rad, -back.turn_rad);
  const Pose2 between = inverse(square.truth[2]) * square.truth[11];
  EXPECT_NEAR(there.distance, std::hypot(between.x_m, between.y_m), 1e-4);
}

TEST(TourTrack, UncertaintyIsThatOfTurnsTimesTheirLeverArms) {
  std::vector<Pose2> poses;
  for (int i = 0; i <= 50; ++i) poses.push_back({0.4 * i, 0.0, 0.0});
  TrackConfig config;
  config.odometry_length_sigma = 0.0;
  const Drive straight = drive(poses);
  const TourTrack track(straight.images, straight.tour_of, straight.pairs, true, 1.0, config);
  double expected = 0.0;
  for (int k = 1; k <= 50; ++k) expected += std::pow(config.least_turn_sigma_rad * 0.4 * (50 - k), 2);
  EXPECT_NEAR(track.predict(0, 50).distance_sigma, std::sqrt(expected), 1e-9);
  EXPECT_NEAR(track.predict(0, 50).turn_sigma_rad, config.least_turn_sigma_rad * std::sqrt(50.0), 1e-9);
}

TEST(TourTrack, TurnsThatDoNotAddUpMakeItUnsure) {
  Drive square = drive(around_a_square(20));
  const int last = static_cast<int>(square.images.size()) - 1;
  const double sigma_m = square.track(true, 1.0).predict(0, last).distance_sigma;
  for (int i = 0; i < last; ++i) {
    PairRelation poor = square.pairs.relation(i, i + 1);
    poor.turn_rad += i % 2 == 0 ? 0.06F : -0.06F;
    if (i % 3 == 0) square.pairs.set(i, i + 1, poor);
  }
  const TourTrack track = square.track(true, 1.0);
  EXPECT_GT(track.turn_sigma_rad(), 0.02);
  EXPECT_GT(track.predict(0, last).distance_sigma, 3.0 * sigma_m);
  EXPECT_EQ(track.judge(0, last).verdict, TrackVerdict::kUnknown);
}

TEST(TourTrack, ACarriedRobotBreaksTheWay) {
  Drive square = drive(around_a_square(10));
  PairRelation carried = square.pairs.relation(20, 21);
  carried.turn_rad += 1.0F;  // the picture turned, the wheels did not
  square.pairs.set(20, 21, carried);
  const TourTrack track = square.track(true, 1.0);
  EXPECT_FALSE(track.predict(0, 50).known);
  EXPECT_EQ(track.judge(0, 50).verdict, TrackVerdict::kUnknown);
  EXPECT_TRUE(track.predict(0, 20).known);
  EXPECT_TRUE(track.predict(21, 50).known);
}

TEST(TourTrack, ToursAreNotJoined) {
  Drive two = drive(around_a_square(10));
  for (std::size_t i = 30; i < two.tour_of.size(); ++i) two.tour_of[i] = 1;
  const TourTrack track = two.track(true, 1.0);
  EXPECT_FALSE(track.predict(29, 30).known);
  EXPECT_TRUE(track.predict(30, 40).known);
}

TEST(TourTrack, WithoutOdometryCountsStepsAndLeavesOutTurnsOnTheSpot) {
  const Drive square = drive(around_a_square(10));
  const TourTrack track = square.track(false, 3.0);
  EXPECT_NEAR(track.predict(0, 10).distance, 10.0, 1e-6);
  EXPECT_NEAR(track.predict(10, 13).distance, 0.0, 1e-3);
  EXPECT_NEAR(track.predict(0, static_cast<int>(square.images.size()) - 1).distance, 0.0, 1e-3);
  EXPECT_EQ(track.judge(5, 31).verdict, TrackVerdict::kContradicts);
}

TEST(TourTrack, WithoutOdometryAndParallaxItKnowsNothing) {
  Drive square = drive(around_a_square(10));
  for (int i = 0; i + 1 < static_cast<int>(square.images.size()); ++i) {
    PairRelation flat = square.pairs.relation(i, i + 1);
    flat.parallax_rad = 0.0F;
    square.pairs.set(i, i + 1, flat);
  }
  EXPECT_FALSE(square.track(false, 3.0).predict(0, 10).known);
}

}  // namespace
}  // namespace homeward::mapping::track_test
