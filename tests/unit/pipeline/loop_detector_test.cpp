// SPDX-License-Identifier: Apache-2.0
#include "pipeline/loop_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/landmarks.hpp"

namespace homeward::pipeline::loop_detector_test {
namespace {

constexpr int kGap = 8;

/// A ring of rooms, each with things of its own, through which a robot drives `rounds` times; `step_m` within a room.
struct Walk {
  std::vector<features::Appearance> pictures;
  std::vector<int> room;
  std::vector<double> x_m;
};

constexpr double kStep_m = 0.4;
constexpr int kPerRoom = 5;

std::vector<Pose2> way_through_room(double aside_m, double turn_rad) {
  std::vector<Pose2> way;
  for (int i = 0; i < kPerRoom; ++i) way.push_back({kStep_m * i + 0.05 * aside_m, aside_m, turn_rad});
  return way;
}

Walk walk_in_rounds(int rooms, int rounds) {
  Walk walk;
  std::uint64_t noise = 1;
  for (int round = 0; round < rounds; ++round) {
    for (int room = 0; room < rooms; ++room) {
      const auto things = testing::landmarks_around(way_through_room(0.0, 0.0), 120, 100 + static_cast<unsigned>(room));
      for (const Pose2& pose : way_through_room(0.1 * round, 0.8 * round)) {
        walk.pictures.push_back(testing::seen_from(things, pose, ++noise, 0.3));
        walk.room.push_back(room);
        walk.x_m.push_back(pose.x_m);
      }
    }
  }
  return walk;
}

std::vector<std::optional<Loop>> loops_of(const Walk& walk, const LoopConfig& config) {
  auto detector = LoopDetector::create(config);
  EXPECT_TRUE(detector);
  std::vector<std::optional<Loop>> found;
  for (const features::Appearance& picture : walk.pictures) {
    const auto loop = detector->see(picture);
    EXPECT_TRUE(loop);
    found.push_back(*loop);
  }
  return found;
}

TEST(LoopDetector, FindsTheSameRoomAgainAndNothingOnTheFirstRound) {
  const Walk walk = walk_in_rounds(4, 2);
  // All of a room's things are seen from everywhere in it: matches alone do not tell which picture is the nearest.
  const auto found = loops_of(walk, {.gap = kGap, .verified = kPerRoom});
  const std::size_t round = walk.pictures.size() / 2;
  for (std::size_t i = 0; i < round; ++i) EXPECT_FALSE(found[i]) << i;
  for (std::size_t i = round; i < walk.pictures.size(); ++i) {
    ASSERT_TRUE(found[i]) << i;
    EXPECT_EQ(walk.room[found[i]->picture], walk.room[i]) << i;
    // The nearest of the room's pictures or the one beside it.
    EXPECT_LT(std::abs(walk.x_m[found[i]->picture] - walk.x_m[i]), 1.5 * kStep_m) << i;
    EXPECT_GT(found[i]->score, 0.0);
  }
}

TEST(LoopDetector, ForgetsTheOldestPicturesAndCountsOn) {
  const Walk walk = walk_in_rounds(3, 3);
  const int round = static_cast<int>(walk.pictures.size()) / 3;
  const auto all = loops_of(walk, {.gap = kGap});
  const int kept = round + 2;  // of the round before, hardly more than the same place
  const auto found = loops_of(walk, {.gap = kGap, .most_kept = kept});
  int matches = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i < static_cast<std::size_t>(kept)) {
      ASSERT_EQ(found[i].has_value(), all[i].has_value()) << i;
      EXPECT_EQ(found[i] ? found[i]->picture : 0, all[i] ? all[i]->picture : 0) << i;
    }
    if (!found[i]) continue;
    ++matches;
    EXPECT_GE(found[i]->picture + static_cast<std::size_t>(kept), i + 1) << i;
    EXPECT_EQ(walk.room[found[i]->picture], walk.room[i]) << i;
  }
  EXPECT_GT(matches, round);
  EXPECT_FALSE(LoopDetector::create({.gap = 20, .most_kept = 20}));
}

TEST(LoopDetector, AMatchIsOldEnough) {
  const Walk walk = walk_in_rounds(1, 6);  // every picture is like every other one
  for (const int gap : {1, 7, 12}) {
    const auto found = loops_of(walk, {.gap = gap});
    int some = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) continue;
      ++some;
      EXPECT_LE(found[i]->picture + static_cast<std::size_t>(gap), i);
    }
    EXPECT_EQ(some, static_cast<int>(walk.pictures.size()) - gap) << gap;
  }
}

TEST(LoopDetector, ADoubtfulPlaceScoresLowerThanAClearOne) {
  // The second round's first room has most of its things exchanged; the second room is as it was.
  Walk walk = walk_in_rounds(2, 1);
  const auto things = testing::landmarks_around(way_through_room(0.0, 0.0), 120, 100);
  const auto others = testing::landmarks_around(way_through_room(0.0, 0.0), 120, 101);
  walk.pictures.push_back(testing::seen_from(things, {kStep_m, 0.1, 0.0}, 71, 0.8));
  walk.pictures.push_back(testing::seen_from(others, {kStep_m, 0.1, 0.0}, 72, 0.1));
  const auto found = loops_of(walk, {.gap = 3});
  const auto& doubtful = found[2 * kPerRoom];
  const auto& clear = found[2 * kPerRoom + 1];
  ASSERT_TRUE(clear);
  if (doubtful) {
    EXPECT_LT(doubtful->score, clear->score);
  }
}

TEST(LoopDetector, PicturesWithoutFeaturesAreLikeNone) {
  Walk walk = walk_in_rounds(2, 2);
  features::Appearance nothing = walk.pictures.front();
  nothing.sift.bearings.resize(0, 3);
  nothing.sift.scales_rad.resize(0);
  nothing.sift.descriptors.resize(0, 128);
  nothing.sift.colours.resize(0, 3);
  for (const std::size_t dark : {0, 3, 12, 17}) walk.pictures[dark] = nothing;
  const auto found = loops_of(walk, {.gap = kGap});
  EXPECT_FALSE(found[12]);
  EXPECT_FALSE(found[17]);
  EXPECT_TRUE(found[16]);
  for (const auto& loop : found) {
    if (loop) {
      EXPECT_TRUE(loop->picture != 0 && loop->picture != 3);
    }
  }

  auto all_dark = LoopDetector::create({.gap = 2});
  for (int i = 0; i < 6; ++i) {
    const auto loop = all_dark->see(nothing);
    ASSERT_TRUE(loop);
    EXPECT_FALSE(*loop);
  }
}

TEST(LoopDetector, SaysTheSameAgain) {
  const Walk walk = walk_in_rounds(3, 2);
  const auto once = loops_of(walk, {.gap = kGap});
  const auto again = loops_of(walk, {.gap = kGap});
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_EQ(once[i].has_value(), again[i].has_value());
    if (!once[i]) continue;
    EXPECT_EQ(once[i]->picture, again[i]->picture);
    EXPECT_EQ(once[i]->score, again[i]->score);
  }
}

TEST(LoopDetector, RefusesSettingsWithoutMeaning) {
  for (const LoopConfig& config : {LoopConfig{.gap = 0}, LoopConfig{.shortlist = 0}, LoopConfig{.verified = 0},
                                   LoopConfig{.least_score = -0.1}, LoopConfig{.least_score = 1.1}}) {
    const auto detector = LoopDetector::create(config);
    ASSERT_FALSE(detector);
    EXPECT_EQ(detector.error().code, ErrorCode::kInvalidInput);
  }
}

TEST(LoopDetector, FeaturesOfOneLengthOnly) {
  Walk walk = walk_in_rounds(2, 1);
  auto detector = LoopDetector::create({.gap = 1});
  for (const features::Appearance& picture : walk.pictures) ASSERT_TRUE(detector->see(picture));
  features::Appearance other = walk.pictures.front();
  other.sift.descriptors.conservativeResize(other.sift.descriptors.rows(), 32);
  const auto refused = detector->see(other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::pipeline::loop_detector_test
