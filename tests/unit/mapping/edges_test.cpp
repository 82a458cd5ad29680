// SPDX-License-Identifier: Apache-2.0
#include "mapping/edges.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "map/lookup.hpp"
#include "mapping/extra_places.hpp"
#include "mapping/tour_path.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::edges_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::walk;

PairRelation seen(double direction_rad, double turn_rad, double confidence) {
  PairRelation relation;
  relation.distance = 0.1F;
  relation.inliers = 40;
  relation.direction_rad = static_cast<float>(direction_rad);
  relation.turn_rad = static_cast<float>(turn_rad);
  relation.confidence = static_cast<float>(confidence);
  return relation;
}

TEST(Sights, TwoWaysThatAgreeKeepTheirOwn) {
  // Ahead the other lies at 0.4 and is turned by 1.0: looking back it lies at 0.4 + pi - 1.0, turned by -1.0.
  const MutualSight joined = join_sights(seen(0.4, 1.0, 0.9), seen(0.4 + kPi - 1.0 + 0.1, -1.05, 0.7));
  ASSERT_TRUE(joined.ahead && joined.back);
  EXPECT_FALSE(joined.disagreed);
  EXPECT_NEAR(joined.ahead->bearing_rad, 0.4, 1e-6);
  EXPECT_NEAR(joined.back->bearing_rad, 0.5 + kPi - 1.0, 1e-6);
  EXPECT_NEAR(joined.back->turn_rad, -1.05, 1e-6);
  EXPECT_NEAR(joined.ahead->confidence, 0.9, 1e-6);
  EXPECT_NEAR(joined.back->confidence, 0.7, 1e-6);
}

TEST(Sights, OneWaySaysWhatTheOtherIs) {
  const MutualSight joined = join_sights({}, seen(0.4, 1.0, 0.9));
  ASSERT_TRUE(joined.ahead && joined.back);
  EXPECT_NEAR(joined.ahead->bearing_rad, wrap_angle(0.4 + kPi - 1.0), 1e-6);
  EXPECT_NEAR(joined.ahead->turn_rad, -1.0, 1e-6);
  EXPECT_NEAR(joined.ahead->confidence, 0.9, 1e-6);
  EXPECT_FALSE(join_sights({}, {}).ahead);
  EXPECT_FALSE(join_sights({}, {}).back);
}

TEST(Sights, OfTwoThatDisagreeTheSurerOneStaysAndIsLessSure) {
  const MutualSight joined = join_sights(seen(0.0, 0.0, 0.6), seen(0.0, 0.0, 0.8));  // both "ahead": impossible
  ASSERT_TRUE(joined.ahead && joined.back);
  EXPECT_TRUE(joined.disagreed);
  EXPECT_NEAR(joined.back->bearing_rad, 0.0, 1e-6);
  EXPECT_NEAR(std::abs(joined.ahead->bearing_rad), kPi, 1e-6);
  const double left = 0.8 * 0.4 / (0.8 * 0.4 + 0.6 * 0.2 + 0.4 * 0.2);
  EXPECT_NEAR(joined.ahead->confidence, left, 1e-6);
  EXPECT_NEAR(joined.back->confidence, left, 1e-6);
  EXPECT_TRUE(join_sights(seen(0.0, 0.0, 0.9), seen(kPi, 0.5, 0.9)).disagreed);  // the turns do not fit
}

/// Ten images 0.4 m apart; images 0 to 4 are place 0 with prototype 2, images 5 to 9 place 1 with prototype 7.
struct TwoPlaces {
  CorridorTour tour = corridor_tour(walk(10, false), {10}, 0.0);
  std::vector<map::Place> places;
  std::vector<int> place_of_image{0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
  MappingConfig config;

  TwoPlaces() {
    for (int p = 0; p < 2; ++p) {
      map::Place place;
      place.id = PlaceId("new" + std::to_string(p));
      place.prototype = image(p == 0 ? 2 : 7);
      for (int i = 0; i < 5; ++i) place.members.push_back(image(5 * p + i));
      place.appearances.resize(1);
      places.push_back(place);
    }
  }
  [[nodiscard]] ImageId image(int i) const { return tour.images[static_cast<std::size_t>(i)].id; }
  void see(int a, int b, double confidence) { tour.pairs.set(a, b, seen(0.0, 0.0, confidence)); }
  ExtraPlaces insert(const std::vector<int>& pinned = {}) {
    Sights sights(tour.input());
    return insert_extra_places(tour.input(), config, pinned, sights, places, place_of_image);
  }
  std::vector<map::Edge> edges() {
    Sights sights(tour.input());
    const TourPath path(tour.input());
    const TourTrack track(tour.images, tour.tour_of, tour.pairs, path.metric(), 1.0, config.track);
    return form_edges(tour.input(), path, track, config, places, place_of_image, sights);
  }
};

TEST(ExtraPlaces, AreNotPutIntoSoundWays) {
  TwoPlaces two;
  two.see(2, 7, 0.5);
  const ExtraPlaces extra = two.insert();
  EXPECT_TRUE(extra.prototypes.empty());
  EXPECT_EQ(extra.weak_before, 0);
  EXPECT_EQ(two.places.size(), 2U);
}

TEST(ExtraPlaces, TakeTheImageThatBothEndsSeeBest) {
  TwoPlaces two;
  two.see(2, 7, 0.1);
  two.see(2, 4, 0.9);
  two.see(4, 7, 0.6);
  two.see(2, 5, 0.5);
  two.see(5, 7, 0.95);
  const ExtraPlaces extra = two.insert();
  EXPECT_EQ(extra.prototypes, std::vector<int>{4});
  EXPECT_EQ(extra.weak_before, 1);
  EXPECT_EQ(extra.weak_after, 0);
  ASSERT_EQ(two.places.size(), 3U);
  EXPECT_EQ(two.places[2].prototype, two.image(4));
  EXPECT_EQ(two.places[2].members, std::vector<ImageId>{two.image(4)});
  EXPECT_EQ(two.places[0].members.size(), 4U);
  EXPECT_EQ(two.place_of_image, (std::vector<int>{0, 0, 0, 0, 2, 1, 1, 1, 1, 1}));
  const std::vector<map::Edge> edges = two.edges();
  ASSERT_EQ(edges.size(), 4U);
  for (const map::Edge& edge : edges) EXPECT_FALSE(edge.weak);
}

TEST(ExtraPlaces, ImagesBeyondANewPrototypeGoWithIt) {
  TwoPlaces two;
  two.see(2, 3, 0.9);
  two.see(3, 7, 0.6);
  two.insert();
  EXPECT_EQ(two.place_of_image, (std::vector<int>{0, 0, 0, 2, 2, 1, 1, 1, 1, 1}));
  EXPECT_EQ(two.places[2].members, (std::vector<ImageId>{two.image(3), two.image(4)}));
}

TEST(ExtraPlaces, AreSoughtOnBothSidesWhereOneDoesNotDo) {
  TwoPlaces two;
  two.see(2, 4, 0.05);
  two.see(4, 7, 0.3);
  two.see(2, 3, 0.9);
  two.see(3, 4, 0.8);
  const ExtraPlaces extra = two.insert();
  EXPECT_EQ(extra.prototypes, (std::vector<int>{3, 4}));
  EXPECT_EQ(extra.weak_after, 0);
  EXPECT_EQ(two.place_of_image, (std::vector<int>{0, 0, 0, 2, 3, 1, 1, 1, 1, 1}));
}

TEST(ExtraPlaces, StayOutWhereTheyDoNotHelpAndTheWayStaysWeak) {
  TwoPlaces two;
  two.see(2, 7, 0.1);
  two.see(2, 4, 0.15);  // both edges would be weak
  two.see(4, 7, 0.15);
  const ExtraPlaces extra = two.insert();
  EXPECT_TRUE(extra.prototypes.empty());
  EXPECT_EQ(extra.weak_before, 1);
  EXPECT_EQ(extra.weak_after, 1);
  const std::vector<map::Edge> edges = two.edges();
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_TRUE(edges[0].weak && edges[1].weak);
}

TEST(ExtraPlaces, OneWeakEdgeLeftIsBetterThanAWeakerOne) {
  TwoPlaces two;
  two.see(2, 6, 0.15);
  two.see(6, 7, 0.9);
  const ExtraPlaces extra = two.insert();
  EXPECT_EQ(extra.prototypes, std::vector<int>{6});
  EXPECT_EQ(extra.weak_after, 1);
}

TEST(ExtraPlaces, LeavePinnedImagesWhereTheyAre) {
  TwoPlaces two;
  two.see(2, 4, 0.9);
  two.see(4, 7, 0.9);
  EXPECT_TRUE(two.insert({4, 6}).prototypes.empty());  // between them only image 5, which nothing sees
  two.config.extra_place_depth = 0;
  EXPECT_TRUE(two.insert().prototypes.empty());
}

TEST(Edges, LengthsComeFromOdometryElseTimeElseImages) {
  TwoPlaces two;
  two.see(2, 7, 0.9);
  std::vector<map::Edge> edges = two.edges();
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0].length_from, map::LengthSource::kTourImages);
  EXPECT_DOUBLE_EQ(edges[0].length_m, 5.0);  // images
  EXPECT_EQ(edges[0].inliers, 40);
  // One picture every 2 s, but a minute's rest before the seventh.
  for (int i = 0; i < 10; ++i) {
    two.tour.images[static_cast<std::size_t>(i)].t_us = 2'000'000LL * i + (i >= 6 ? 60'000'000 : 0);
  }
  edges = two.edges();
  EXPECT_EQ(edges[0].length_from, map::LengthSource::kTourTime);
  EXPECT_DOUBLE_EQ(edges[0].length_m, 0.5 * (4.0 + 2.0 + (6.0 + 2.0 * 3.0) / 2.0));
  for (int i = 0; i < 10; ++i) two.tour.images[static_cast<std::size_t>(i)].odometry = Pose2{0.4 * i, 0.0, 0.0};
  edges = two.edges();
  EXPECT_EQ(edges[0].length_from, map::LengthSource::kOdometry);
  EXPECT_NEAR(edges[0].length_m, 2.0, 1e-9);
  EXPECT_EQ(edges[1].length_m, edges[0].length_m);
  // A picture without odometry and time breaks both.
  two.tour.images[4].odometry.reset();
  two.tour.images[4].t_us.reset();
  EXPECT_EQ(two.edges()[0].length_from, map::LengthSource::kTourImages);
}

TEST(ExtraPlaces, MendAWholeMap) {
  CorridorTour tour = corridor_tour(walk(40, true), {80});
  // Only what is less than 0.9 m away is seen well enough to home to.
  for (int b = 0; b < 80; ++b) {
    for (int a = 0; a < b; ++a) {
      const double apart_m =
          std::abs(tour.position_m[static_cast<std::size_t>(a)] - tour.position_m[static_cast<std::size_t>(b)]);
      PairRelation relation = tour.pairs.relation(a, b);
      if (!relation.verified()) continue;
      relation.confidence = apart_m < 0.9 ? 0.9F : 0.1F;
      tour.pairs.set(a, b, relation);
    }
  }
  MappingConfig config;
  config.place_extent_images = 4.0;
  config.extra_place_depth = 0;
  const NotedMap before = make_noted_map(tour.input(), config, nullptr);
  config.extra_place_depth = 3;
  const NotedMap after = make_noted_map(tour.input(), config, nullptr);
  const auto weak = [](const map::TopologicalMap& map) {
    return std::ranges::count_if(map.edges, [](const map::Edge& edge) { return edge.weak; });
  };
  EXPECT_GE(weak(before.map), 10);
  EXPECT_EQ(weak(before.map), 2 * before.notes.weak_before);
  EXPECT_EQ(before.notes.weak_after, before.notes.weak_before);
  EXPECT_EQ(after.notes.weak_before, before.notes.weak_before);
  EXPECT_EQ(weak(after.map), 0);
  EXPECT_EQ(after.notes.weak_after, 0);
  EXPECT_EQ(after.map.places.size(), before.map.places.size() + after.notes.extra.size());
  std::set<ImageId> held;
  for (const map::Place& place : after.map.places) {
    EXPECT_TRUE(std::ranges::is_sorted(place.members));
    EXPECT_NE(std::ranges::find(place.members, place.prototype), place.members.end());
    for (const ImageId& member : place.members) EXPECT_TRUE(held.insert(member).second);
  }
  EXPECT_EQ(held.size(), 80U);
  for (const ImageId& extra : after.notes.extra) {
    EXPECT_EQ(map::find_place_of(after.map, extra)->prototype, extra);
  }
  const NotedMap again = make_noted_map(tour.input(), config, nullptr);
  ASSERT_EQ(again.map.places.size(), after.map.places.size());
  for (std::size_t i = 0; i < again.map.places.size(); ++i) {
    EXPECT_EQ(again.map.places[i].members, after.map.places[i].members);
  }
}

}  // namespace
}  // namespace homeward::mapping::edges_test
