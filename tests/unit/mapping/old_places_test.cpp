// SPDX-License-Identifier: Apache-2.0
#include "mapping/old_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/new_tour.hpp"
#include "support/sample_map.hpp"

namespace homeward::mapping::old_places_test {
namespace {

constexpr double kStep_m = 0.4;

/// A straight drive of old and the same drive again, both with odometry; each third image of old is a place, whose
/// edges lead to the next.
struct TwoDrives {
  explicit TwoDrives(int count, bool edges = true) : images(count), pairs(0) {
    for (int i = 0; i < count; ++i) {
      old.images.push_back({ImageId("old/" + std::to_string(1000 + i)), std::nullopt, Pose2{kStep_m * i, 0.0, 0.0}});
    }
    for (int i = 0; i < count; i += 3) {
      old.places.push_back(
          homeward::testing::place_of_image("p" + std::to_string(i / 3), old.images[static_cast<std::size_t>(i)].id,
                                            homeward::testing::random_appearance(3, static_cast<unsigned>(i))));
    }
    for (std::size_t p = 1; p < old.places.size() && edges; ++p) {
      map::Edge edge;
      edge.from = old.places[p - 1].id;
      edge.to = old.places[p].id;
      edge.bearing_rad = 0.0;
      edge.turn_rad = 0.0;
      edge.length_m = 3.0 * kStep_m;
      edge.length_from = map::LengthSource::kOdometry;
      edge.confidence = 0.9;
      edge.inliers = 60;
      old.edges.push_back(edge);
    }
    NewTours tours = homeward::testing::new_tour(count);
    for (int i = 0; i < count; ++i) tours.images[static_cast<std::size_t>(i)].odometry = Pose2{kStep_m * i, 0.0, 0.0};
    input = growth_input(old, std::move(tours)).value();
    pairs = PairTable(static_cast<int>(input.images.size()));
    for (int i = 0; i + 1 < count; ++i) pairs.set(i, i + 1, seen());  // the pictures know the turns
    for (int i = 0; i + 2 < count; ++i) pairs.set(i, i + 2, seen());
    for (int anchor = count; anchor < pairs.images(); ++anchor) {
      for (int i = 0; i < count; ++i) pairs.set(i, anchor, seen());
    }
  }
  static PairRelation seen() {
    PairRelation relation;
    relation.distance = 0.1F;
    relation.inliers = 60;
    relation.match_share = 0.3F;
    return relation;
  }
  /// "New image `image` shows the place of old image `old_image`".
  [[nodiscard]] OldPlaces::Claim claim(int image, int old_image) const { return {image, images + old_image / 3}; }
  [[nodiscard]] TourTrack track() const {
    return {input.images, input.tour_of, pairs, true, config.place_extent_m, config.track};
  }

  int images;
  map::TopologicalMap old;
  GrowthInput input;
  PairTable pairs;
  MappingConfig config;
};

/// A map whose looks were never right: claims need to be borne out by others.
void doubt(map::TopologicalMap& map) {
  map::Hypothesis wrong;
  wrong.similarity = 1.0;
  wrong.masses_before = wrong.masses_after = {0.0, 0.99, 0.01};
  wrong.decision = map::Decision::kRejected;
  map.hypotheses.assign(20, wrong);
}

TEST(OldPlaces, KnowsWhatTheMapIsMadeOf) {
  const TwoDrives drives(12);
  const OldPlaces old(drives.old, drives.input, drives.pairs, true, drives.config);
  EXPECT_FALSE(old.is_old(11));
  EXPECT_TRUE(old.is_old(12));
  EXPECT_EQ(old.place(13), 1);
  EXPECT_EQ(old.adjoining(1), (std::vector<int>{0, 2}));
  EXPECT_EQ(old.positions()[13] - old.positions()[12], 3.0);  // images of the old tour
  EXPECT_GT(old.positions()[0] - old.positions()[12], 1e5);
}

TEST(OldPlaces, EdgesOfTheMapHoldItsWayTogether) {
  TwoDrives drives(120);
  doubt(drives.old);
  // Of those further apart odometry alone does not know where the old way led from one to the other.
  const std::vector<OldPlaces::Claim> claims = {drives.claim(0, 0), drives.claim(18, 18), drives.claim(36, 36),
                                                drives.claim(54, 54), drives.claim(72, 72)};
  const TourTrack track = drives.track();
  const OldPlaces with(drives.old, drives.input, drives.pairs, true, drives.config);
  const std::vector<OldPlaces::Trust> trust = with.trust(claims, track, nullptr);
  EXPECT_GT(trust[2].factor, 0.9);
  EXPECT_TRUE(trust[2].borne_out);
  TwoDrives loose(120, false);
  doubt(loose.old);
  const OldPlaces without(loose.old, loose.input, loose.pairs, true, loose.config);
  EXPECT_LT(without.trust(claims, track, nullptr)[2].factor, 0.2);
}

TEST(OldPlaces, EdgesThatTheOdometryExcludesDoNotBendTheWay) {
  TwoDrives drives(60);
  doubt(drives.old);
  map::Edge wrong = drives.old.edges.front();
  wrong.length_m = 0.5;
  for (std::size_t p = 0; p < 9; ++p) {  // twelve metres on they start again
    wrong.from = drives.old.places[p].id;
    wrong.to = drives.old.places[p + 10].id;
    drives.old.edges.push_back(wrong);
  }
  const OldPlaces old(drives.old, drives.input, drives.pairs, true, drives.config);
  const std::vector<OldPlaces::Claim> claims = {drives.claim(6, 6), drives.claim(18, 18), drives.claim(30, 30),
                                                drives.claim(42, 42)};
  for (const auto& trust : old.trust(claims, drives.track(), nullptr)) EXPECT_GT(trust.factor, 0.9);
}

TEST(OldPlaces, WhatTheOthersExcludeIsTakenBack) {
  const TwoDrives drives(60);
  const OldPlaces old(drives.old, drives.input, drives.pairs, true, drives.config);
  std::vector<OldPlaces::Claim> claims;
  for (const int image : {3, 9, 15, 33, 39, 45, 51}) claims.push_back(drives.claim(image, image));
  claims.push_back(drives.claim(24, 48));
  const std::vector<char> excluded = old.excluded(claims, drives.track(), nullptr);
  EXPECT_EQ(std::ranges::count(excluded, 1), 1);
  EXPECT_EQ(excluded.back(), 1);
}

TEST(OldPlaces, WithoutOdometryLooksCountAsFarAsTheyWereRight) {
  TwoDrives drives(60);
  const std::vector<OldPlaces::Claim> claims = {drives.claim(6, 6), drives.claim(30, 57)};
  const OldPlaces trusted(drives.old, drives.input, drives.pairs, false, drives.config);
  EXPECT_EQ(trusted.trust(claims, drives.track(), nullptr), std::vector<OldPlaces::Trust>(2));
  EXPECT_EQ(std::ranges::count(trusted.excluded(claims, drives.track(), nullptr), 1), 0);
  doubt(drives.old);
  const OldPlaces doubted(drives.old, drives.input, drives.pairs, false, drives.config);
  EXPECT_LT(doubted.trust(claims, drives.track(), nullptr)[0].factor, 0.01);
}

TEST(OldPlaces, WhatWasTakenBackInTheOldMapCountsAgainstLooks) {
  TwoDrives drives(12);
  map::Hypothesis taken_back;
  taken_back.similarity = 1.0;
  taken_back.masses_before = {0.7, 0.0, 0.3};
  taken_back.masses_after = {0.0, 0.99, 0.01};
  taken_back.decision = map::Decision::kRejected;
  drives.old.hypotheses.assign(20, taken_back);
  const OldPlaces old(drives.old, drives.input, drives.pairs, false, drives.config);
  EXPECT_LT(old.trust(std::vector{drives.claim(0, 0)}, drives.track(), nullptr)[0].factor, 0.1);
}

}  // namespace
}  // namespace homeward::mapping::old_places_test
