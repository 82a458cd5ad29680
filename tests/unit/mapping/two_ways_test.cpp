// SPDX-License-Identifier: Apache-2.0
#include "mapping/two_ways.hpp"

#include <gtest/gtest.h>

namespace homeward::mapping {
namespace {

/// A straight drive with odometry, 0.4 m a step.
struct Drive {
  explicit Drive(int count) : tour_of(static_cast<std::size_t>(count), 0), pairs(count) {
    for (int i = 0; i < count; ++i) {
      images.push_back({ImageId("t/" + std::to_string(i)), std::nullopt, Pose2{0.4 * i, 0.0, 0.0}});
    }
  }
  [[nodiscard]] TourTrack track() const { return {images, tour_of, pairs, true, 1.0, {}}; }
  std::vector<map::MapImage> images;
  std::vector<int> tour_of;
  PairTable pairs;
};

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
  for (const double trust : meeting_trust(meetings, now.track(), before.track(), 1.0, 60)) EXPECT_EQ(trust, 1.0);
}

TEST(MeetingTrust, ALookAlikeAwayFromTheWayIsNotTrusted) {
  const Drive now(30);
  const Drive before(40);
  const std::vector<Meeting> meetings = {
      {2, 2, turned(0.0F)}, {9, 9, turned(0.0F)}, {12, 27, turned(0.0F)}, {16, 16, turned(0.0F)}};
  const std::vector<double> trust = meeting_trust(meetings, now.track(), before.track(), 1.0, 60);
  EXPECT_EQ(trust[2], 0.0);
  EXPECT_GT(trust[0], 0.0);
  EXPECT_GT(trust[1], trust[2]);
}

TEST(MeetingTrust, ARoomTurnedRoundIsNotTrusted) {
  const Drive now(30);
  const Drive before(30);
  const std::vector<Meeting> meetings = {
      {2, 2, turned(0.0F)}, {9, 9, turned(3.0F)}, {14, 14, turned(0.0F)}, {16, 16, turned(0.0F)}};
  const std::vector<double> trust = meeting_trust(meetings, now.track(), before.track(), 1.0, 60);
  EXPECT_EQ(trust[1], 0.0);
  EXPECT_GT(trust[0], 0.3);
}

TEST(MeetingTrust, WhatIsTooNearOrTooFarSaysNothing) {
  const Drive now(200);
  const Drive before(200);
  // One metre apart; then more pictures apart than `reach`.
  EXPECT_EQ(meeting_trust(std::vector<Meeting>{{2, 2, turned(0.0F)}, {4, 5, turned(0.0F)}}, now.track(), before.track(),
                          1.0, 60),
            (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(meeting_trust(std::vector<Meeting>{{2, 2, turned(0.0F)}, {90, 20, turned(0.0F)}}, now.track(),
                          before.track(), 1.0, 60),
            (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(meeting_trust(std::vector<Meeting>{{2, -1, turned(0.0F)}, {9, 30, turned(0.0F)}}, now.track(),
                          before.track(), 1.0, 60),
            (std::vector<double>{1.0, 1.0}));
}

}  // namespace
}  // namespace homeward::mapping
