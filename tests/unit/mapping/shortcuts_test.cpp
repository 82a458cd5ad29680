// SPDX-License-Identifier: Apache-2.0
#include "mapping/shortcuts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mapping/shortcut_edges.hpp"
#include "support/horseshoe.hpp"

namespace homeward::mapping::shortcuts_test {
namespace {

using testing::Horseshoe;
using testing::Wall;

/// The way over edges and shortcuts between the ends of the horseshoe is no longer than this.
double way_between_ends_m(const Horseshoe& tour, const std::vector<map::Shortcut>& shortcuts) {
  const auto index = [](const ImageId& image) { return std::stoul(image.str().substr(5)) - 100; };
  std::vector<std::vector<double>> way_m(11, std::vector<double>(11, 1e9));
  const auto join = [&](std::size_t a, std::size_t b) {
    const Pose2 step = inverse(tour.poses[a]) * tour.poses[b];
    way_m[a][b] = way_m[b][a] = std::hypot(step.x_m, step.y_m);
  };
  for (std::size_t i = 0; i + 1 < 11; ++i) join(i, i + 1);
  for (const map::Shortcut& one : shortcuts) join(index(one.image_a), index(one.image_b));
  for (std::size_t k = 0; k < 11; ++k)
    for (std::size_t i = 0; i < 11; ++i)
      for (std::size_t j = 0; j < 11; ++j) way_m[i][j] = std::min(way_m[i][j], way_m[i][k] + way_m[k][j]);
  return way_m[0][10];
}

TEST(Shortcuts, AreProposedAcrossFreeFloor) {
  const Horseshoe tour;
  const auto found = propose_shortcuts(tour.map, tour.sweeps);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), 10U) << "few are enough";
  EXPECT_LT(way_between_ends_m(tour, found), 2.4 * 1.7);
  double saves_m = 1e9;
  for (const map::Shortcut& one : found) {
    EXPECT_EQ(one.state, map::ShortcutState::kProposed);
    EXPECT_EQ(one.by, "method");
    EXPECT_GE(one.confidence, 0.8);
    EXPECT_GE(one.clear_m, 0.9);
    EXPECT_GT(one.inliers, 20);
    EXPECT_GT(one.way_m, 1.3 * one.length_m);
    EXPECT_LE(one.way_m - one.length_m, saves_m + 1e-9) << "those that save most come first";
    saves_m = one.way_m - one.length_m;
    const auto at = [&](const ImageId& image) { return tour.poses[std::stoul(image.str().substr(5)) - 100]; };
    const Pose2 seen = inverse(at(one.image_a)) * at(one.image_b);
    EXPECT_NEAR(one.length_m, std::hypot(seen.x_m, seen.y_m), 0.1);
    EXPECT_NEAR(wrap_angle(one.bearing_rad - std::atan2(seen.y_m, seen.x_m)), 0.0, 0.1);
    EXPECT_NEAR(wrap_angle(one.turn_rad - seen.theta_rad), 0.0, 0.1);
    const Pose2 back = inverse(seen);
    EXPECT_NEAR(wrap_angle(one.back_bearing_rad - std::atan2(back.y_m, back.x_m)), 0.0, 0.1);
  }
}

TEST(Shortcuts, AreTheSameForTheSame) {
  const Horseshoe tour;
  const auto one = propose_shortcuts(tour.map, tour.sweeps);
  const auto two = propose_shortcuts(tour.map, tour.sweeps);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].image_a, two[i].image_a);
    EXPECT_EQ(one[i].bearing_rad, two[i].bearing_rad);
  }
}

TEST(Shortcuts, NeverLeadThroughWhatStandsThere) {
  const Horseshoe tour({Wall{{-1.2, 1.2}, {3.4, 1.2}}});
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
}

TEST(Shortcuts, NeedSweepsAndAMetricLayout) {
  Horseshoe tour;
  EXPECT_TRUE(propose_shortcuts(tour.map, {}).empty());
  for (map::MapImage& image : tour.map.images) image.odometry.reset();
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
}

TEST(Shortcuts, NeedPicturesThatAgree) {
  Horseshoe tour;
  const auto found = propose_shortcuts(tour.map, tour.sweeps);
  ASSERT_FALSE(found.empty());
  // Places that see nothing in common, and places whose pictures tell another turn than the layout.
  const auto elsewhere = testing::landmarks_around(tour.poses, 220, 99, 1.0, 5.0);
  for (std::size_t i = 0; i < 5; ++i)
    tour.map.places[i].appearances = {testing::seen_from(elsewhere, tour.poses[i], i)};
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
  const auto landmarks = testing::landmarks_around(tour.poses, 220, 5, 1.0, 5.0);
  for (std::size_t i = 0; i < 5; ++i) {
    const Pose2 turned{tour.poses[i].x_m, tour.poses[i].y_m, tour.poses[i].theta_rad + 0.4};
    tour.map.places[i].appearances = {testing::seen_from(landmarks, turned, 70 + i)};
  }
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
}

TEST(Shortcuts, NeedSweepsThatAgree) {
  Horseshoe tour;
  // The room was another one when the way back was driven: an open door, a wall that is none.
  for (std::size_t i = 6; i < tour.sweeps.size(); ++i) {
    tour.sweeps[i].sweep = testing::sweep_at(tour.poses[i], testing::walls_around({-3.0, -3.0}, {9.0, 6.0}));
  }
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
}

TEST(Shortcuts, AreNotProposedTwiceNorAgainstAPersonsWord) {
  Horseshoe tour;
  const auto found = propose_shortcuts(tour.map, tour.sweeps);
  ASSERT_FALSE(found.empty());
  tour.map.shortcuts = found;
  for (map::Shortcut& one : tour.map.shortcuts) one.state = map::ShortcutState::kAccepted;
  settle_shortcuts(tour.map);
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty()) << "as edges they serve already";
  for (map::Shortcut& one : tour.map.shortcuts) one.state = map::ShortcutState::kRejected;
  settle_shortcuts(tour.map);
  std::set<std::pair<ImageId, ImageId>> rejected;
  for (const map::Shortcut& one : found) rejected.emplace(one.image_a, one.image_b);
  for (const map::Shortcut& one : propose_shortcuts(tour.map, tour.sweeps)) {
    EXPECT_FALSE(rejected.contains({one.image_a, one.image_b})) << one.image_a.str();
  }
}

TEST(Shortcuts, ABlockedEdgeIsNoReasonForOne) {
  Horseshoe tour;
  for (map::Shortcut& one : tour.map.shortcuts = propose_shortcuts(tour.map, tour.sweeps))
    one.state = map::ShortcutState::kAccepted;
  settle_shortcuts(tour.map);
  for (map::Edge& edge : tour.map.edges) edge.blocked = true;
  EXPECT_TRUE(propose_shortcuts(tour.map, tour.sweeps).empty());
}

}  // namespace
}  // namespace homeward::mapping::shortcuts_test
