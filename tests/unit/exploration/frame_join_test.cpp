// SPDX-License-Identifier: Apache-2.0
#include "exploration/frame_join.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/drawn_walls.hpp"
#include "support/landmarks.hpp"

namespace homeward::exploration::frame_join_test {
namespace {

/// Two robots in two rooms; each begins an odometry and a floor of its own.
class FrameJoinTest : public ::testing::Test {
 protected:
  FrameJoinTest() {
    for (const double x_m : {1.0, 1.8, 2.6, 3.4, 4.2}) take(first_, kFirst, {x_m, 2.0, 0.2}, landmarks_);
  }
  static homeward::testing::Landmarks landmarks(std::uint64_t seed) {
    return homeward::testing::landmarks_around({{1.0, 2.0, 0.0}, {2.5, 2.0, 0.0}, {4.0, 2.0, 0.0}}, 150, seed, 2.0);
  }
  static void take(Explorer& explorer, const Pose2& start, const Pose2& pose,
                   const homeward::testing::Landmarks& landmarks) {
    explorer.take(sweep_of(testing::two_rooms(), pose), inverse(start) * pose,
                  std::make_shared<const features::Appearance>(homeward::testing::seen_from(landmarks, pose, 9)));
  }
  void second_drives(const std::vector<double>& to_m, const homeward::testing::Landmarks& landmarks) {
    for (const double x_m : to_m) {
      take(second_, kSecond, {x_m, 1.8, 2.9}, landmarks);
      join_.second_looks(first_, second_, kAway);
    }
  }

  /// Nobody is in the other's way.
  const Pose2 kAway{100.0, 0.0, 0.0};
  const Pose2 kFirst{1.0, 2.0, 0.2};
  const Pose2 kSecond{4.3, 1.8, 2.9};
  homeward::testing::Landmarks landmarks_ = landmarks(5);
  Explorer first_{ExplorerConfig{}};
  Explorer second_{ExplorerConfig{}};
  FrameJoin join_;
};

TEST_F(FrameJoinTest, TwoAgreementsSomeWayApartJoinTheFloors) {
  second_drives({4.3, 3.2, 2.8}, landmarks_);
  EXPECT_GE(join_.agreements(), 1U);
  EXPECT_FALSE(join_.first_from_second(first_, second_)) << "too near to each other to be independent";
  second_drives({1.4, 1.0}, landmarks_);
  const auto joined = join_.first_from_second(first_, second_);
  ASSERT_TRUE(joined);
  const Pose2 off = inverse(inverse(kFirst) * kSecond) * *joined;
  EXPECT_LT(position_m(off).norm(), 0.1);
  EXPECT_LT(std::abs(off.theta_rad), 0.03);
}

TEST_F(FrameJoinTest, ItIsTheSameWhicheverLooks) {
  for (const double x_m : {4.3, 3.2, 2.8, 1.4, 1.0}) {
    take(second_, kSecond, {x_m, 1.8, 2.9}, landmarks_);
    join_.first_looks(second_, first_, kAway);
  }
  const auto joined = join_.first_from_second(second_, first_);
  ASSERT_TRUE(joined);
  EXPECT_LT(position_m(inverse(inverse(kSecond) * kFirst) * *joined).norm(), 0.1);
}

TEST_F(FrameJoinTest, WhoeverIsNotSeenWhereItWouldStandInPlainViewIsElsewhere) {
  for (const double x_m : {4.3, 3.0, 2.0, 1.0}) {
    take(second_, kSecond, {x_m, 1.8, 2.9}, landmarks_);
    // The first one, by this, stands 1 m before the second one, which sees the far wall there.
    const Pose2 stands = inverse(kFirst) * Pose2{x_m, 1.8, 2.9} * Pose2{1.0, 0.0, 0.0};
    join_.second_looks(first_, second_, stands);
  }
  EXPECT_GE(join_.agreements(), 2U);
  EXPECT_FALSE(join_.first_from_second(first_, second_));
}

TEST_F(FrameJoinTest, InRoomsOfTheSameShapeThatLookOtherwiseNothingIsJoined) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks(77));
  EXPECT_EQ(join_.agreements(), 0U);
  EXPECT_FALSE(join_.first_from_second(first_, second_));
}

TEST_F(FrameJoinTest, WhatAnotherFoundJoinsTheFloorsAtTheSamePose) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks_);
  const auto found = join_.first_from_second(first_, second_);
  ASSERT_TRUE(found);
  FrameJoin other;
  other.set_told(join_.found());
  EXPECT_TRUE(other.found().empty()) << "and is not told back as its own";
  const auto joined = other.first_from_second(first_, second_);
  ASSERT_TRUE(joined);
  EXPECT_LT(position_m(inverse(*found) * *joined).norm(), 1e-9);
  EXPECT_LT(position_m(inverse(inverse(kFirst) * kSecond) * *joined).norm(), 0.1);
  other.set_told({});
  EXPECT_FALSE(other.first_from_second(first_, second_)) << "what is told later stands in its place";
}

TEST_F(FrameJoinTest, WhatIsToldOfViewsThatAreNotHereYetCountsOnceTheyAre) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks_);
  FrameJoin other;
  other.set_told(join_.found());
  EXPECT_FALSE(other.first_from_second(first_, Explorer{ExplorerConfig{}}));
  EXPECT_TRUE(other.first_from_second(first_, second_));
}

TEST_F(FrameJoinTest, WhatIsToldOfNowhereIsPassedOver) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks_);
  std::vector<JoinAgreement> told = join_.found();
  for (JoinAgreement& one : told) one.first_from_second.x_m = std::nan("");
  FrameJoin other;
  other.set_told(told);
  EXPECT_FALSE(other.first_from_second(first_, second_));
  told = join_.found();
  for (JoinAgreement& one : told) one.first_from_second.theta_rad = std::nan("");
  other.set_told(told);
  EXPECT_FALSE(other.first_from_second(first_, second_));
  // All the same, so that they would be joined by what they say.
  told = join_.found();
  for (JoinAgreement& one : told) one.first_from_second = {1e3, 0.0, 0.0};
  other.set_told(told);
  EXPECT_FALSE(other.first_from_second(first_, second_));
}

TEST_F(FrameJoinTest, OfMoreThanAreTakenInTheNewestCount) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks_);
  std::vector<JoinAgreement> told(200, JoinAgreement{0, 0, {0.0, 3.0, 1.0}, true});
  for (std::size_t i = 0; i < told.size(); ++i) told[i].first = i;  // none is another one again
  told.insert(told.end(), join_.found().begin(), join_.found().end());
  FrameJoin other;
  other.set_told(told);
  EXPECT_TRUE(other.first_from_second(first_, second_));
}

TEST_F(FrameJoinTest, WhatIsToldOtherwiseThanWasFoundMoreOftenIsOutvoted) {
  second_drives({4.3, 3.2, 2.8, 1.4, 1.0}, landmarks_);
  ASSERT_TRUE(join_.first_from_second(first_, second_));
  join_.set_told(std::vector<JoinAgreement>{{0, 0, {0.0, 3.0, 1.0}, true}});
  const auto joined = join_.first_from_second(first_, second_);
  ASSERT_TRUE(joined);
  EXPECT_LT(position_m(inverse(inverse(kFirst) * kSecond) * *joined).norm(), 0.1);
}

TEST_F(FrameJoinTest, WithoutPicturesNothingIsJoined) {
  second_.take(sweep_of(testing::two_rooms(), kSecond), {}, nullptr);
  join_.second_looks(first_, second_, kAway);
  EXPECT_FALSE(join_.first_from_second(first_, second_));
}

}  // namespace
}  // namespace homeward::exploration::frame_join_test
