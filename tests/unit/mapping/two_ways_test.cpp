// SPDX-License-Identifier: Apache-2.0
#include "mapping/two_ways.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "support/posed_drive.hpp"

namespace homeward::mapping::two_ways_test {
namespace {

/// A straight drive with odometry, 0.4 m a step.
struct Drive : testing::PosedDrive {
  explicit Drive(int count) {
    for (int i = 0; i < count; ++i) add({0.4 * i, 0.0, 0.0}, Pose2{0.4 * i, 0.0, 0.0});
    pairs = PairTable(count);
  }
  [[nodiscard]] TourTrack track() const { return {images, tour_of, pairs, true, 1.0, {}}; }
};

/// With the ways as they were driven, without their loops.
std::vector<MeetingTrust> trust_of(const std::vector<Meeting>& meetings, const Drive& now, const Drive& before) {
  const TourTrack new_way = now.track();
  const TourTrack old_way = before.track();
  return meeting_trust(
      meetings, [&](int a, int b) { return new_way.predict(a, b); },
      [&](int a, int b) { return old_way.predict(a, b); }, 1.0, 60);
}

PairRelation turned(float turn_rad) {
  PairRelation seen;
  seen.distance = 0.1F;
  seen.inliers = 40;
  seen.turn_rad = turn_rad;
  return seen;
}

TEST(MeetingTrust, WaysThatLeadAlikeBearEachOtherOut) {
  const Drive now(30);
  const Drive before(30);
  const std::vector<Meeting> meetings = {{2, 2, turned(0.0F)}, {9, 9, turned(0.0F)}, {16, 16, turned(0.0F)}};
  for (const MeetingTrust& trust : trust_of(meetings, now, before)) {
    EXPECT_DOUBLE_EQ(trust.agreed, 2.0);
    EXPECT_EQ(trust.factor(), 1.0);
  }
}

TEST(MeetingTrust, ALookAlikeAwayFromTheWayIsNotTrusted) {
  const Drive now(30);
  const Drive before(40);
  const std::vector<Meeting> meetings = {
      {2, 2, turned(0.0F)}, {9, 9, turned(0.0F)}, {12, 27, turned(0.0F)}, {16, 16, turned(0.0F)}};
  const auto trust = trust_of(meetings, now, before);
  EXPECT_LT(trust[2].factor(), 0.05);
  EXPECT_GT(trust[0].factor(), 0.6);
  EXPECT_GT(trust[1].factor(), 0.6);
}

TEST(MeetingTrust, TheRoomBesideIsNotTheSameRoom) {
  // Two rooms that look alike, left and right of where a corridor ends: from all of it both are as far away.
  const auto drive_to = [](double room_m) {
    Drive drive(8);
    for (int i = 0; i < 5; ++i) drive.images[static_cast<std::size_t>(i)].odometry = Pose2{1.6 * i, 0.0, 0.0};
    for (int i = 5; i < 8; ++i) {
      drive.images[static_cast<std::size_t>(i)].odometry = Pose2{8.0 + 1.5 * (i - 5), room_m, 0.0};
    }
    return drive;
  };
  const Drive now = drive_to(-2.0);
  const Drive before = drive_to(2.0);
  std::vector<Meeting> meetings;
  for (int image = 0; image < 8; ++image) meetings.push_back({image, image, turned(0.0F)});
  const std::size_t right = 5;
  const auto trust = trust_of(meetings, now, before);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (i < right) {
      EXPECT_GT(trust[i].factor(), 0.6) << i;
    } else {
      EXPECT_LT(trust[i].factor(), 0.2) << i;
    }
  }
}

TEST(MeetingTrust, ARoomTurnedRoundIsNotTrusted) {
  const Drive now(30);
  const Drive before(30);
  const std::vector<Meeting> meetings = {
      {2, 2, turned(0.0F)}, {9, 9, turned(3.0F)}, {14, 14, turned(0.0F)}, {16, 16, turned(0.0F)}};
  const auto trust = trust_of(meetings, now, before);
  EXPECT_LT(trust[1].factor(), 0.05);
  EXPECT_GT(trust[0].factor(), 0.6);
}

TEST(MeetingTrust, LookAlikesThatGoWithNothingDoNotOutvoteWhatGoesTogether) {
  const Drive now(60);
  const Drive before(200);
  std::vector<Meeting> meetings;
  for (const int image : {5, 13, 21, 29}) meetings.push_back({image, image, turned(0.0F)});
  for (const int image : {8, 16, 24, 32, 36, 40}) {
    meetings.push_back({image, (image * 37) % 190, turned(0.1F * static_cast<float>(image))});
  }
  const auto trust = trust_of(meetings, now, before);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    if (i < 4) {
      EXPECT_GT(trust[i].factor(), 0.5) << i;
      EXPECT_GT(trust[i].agreed, 0.8) << i;
    } else {
      EXPECT_LT(trust[i].factor(), 0.3) << i;
    }
  }
}

TEST(MeetingTrust, WhatIsTooNearOrTooFarSaysNothing) {
  const Drive now(200);
  const Drive before(200);
  const auto silent = [&](const Meeting& a, const Meeting& b) {
    const auto trust = trust_of({a, b}, now, before);
    return trust[0].agreed + trust[0].contradicted + trust[1].agreed + trust[1].contradicted == 0.0;
  };
  EXPECT_TRUE(silent({2, 2, turned(0.0F)}, {4, 5, turned(0.0F)}));    // inside one place
  EXPECT_TRUE(silent({2, 2, turned(0.0F)}, {90, 20, turned(0.0F)}));  // beyond reach
  EXPECT_TRUE(silent({2, -1, turned(0.0F)}, {9, 30, turned(0.0F)}));  // an image that the map does not know
  EXPECT_FALSE(silent({2, 2, turned(0.0F)}, {9, 30, turned(0.0F)}));
}

}  // namespace
}  // namespace homeward::mapping::two_ways_test
