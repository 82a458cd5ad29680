// SPDX-License-Identifier: Apache-2.0
#include "mapping/doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "mapping/doubt_kinds.hpp"
#include "mapping/edit_log.hpp"
#include "support/sample_map.hpp"

namespace homeward::mapping::doubts_test {
namespace {

using homeward::testing::place_of_image;
using homeward::testing::random_appearance;
using map::Doubt;
using map::DoubtKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ImageId image(int number) { return ImageId("tour/" + std::to_string(1000 + number) + ".jpg"); }
PlaceId place(int number) { return PlaceId("p" + std::to_string(number)); }

void join(map::TopologicalMap& map, int a, int b, double confidence) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    map::Edge edge;
    edge.from = place(from);
    edge.to = place(to);
    edge.bearing_rad = from < to ? 0.0 : kPi;
    edge.turn_rad = 0.0;
    edge.length_m = 1.0;
    edge.length_from = map::LengthSource::kOdometry;
    edge.confidence = confidence;
    map.edges.push_back(edge);
  }
}

/// A tour straight ahead, a picture and a place every metre, joined as it was driven.
map::TopologicalMap straight_tour(int places) {
  map::TopologicalMap map;
  for (int i = 0; i < places; ++i) {
    map.images.push_back({image(i), std::nullopt, Pose2{1.0 * i, 0.0, 0.0}});
    map.places.push_back(place_of_image("p" + std::to_string(i), image(i), random_appearance(60, 100U + unsigned(i))));
    if (i > 0) join(map, i - 1, i, 0.98);
  }
  map.next_place_number = places;
  return map;
}

std::vector<Doubt> doubts(const map::TopologicalMap& map, int threads = 1) { return *doubts_of(map, {}, threads); }

/// Of this kind, that a person has not decided.
std::vector<Doubt> asked(const map::TopologicalMap& map, DoubtKind kind) {
  std::vector<Doubt> all = doubts(map);
  std::erase_if(all, [&](const Doubt& one) { return one.kind != kind || one.by == map::Decider::kPerson; });
  return all;
}

/// The pictures of place 9 and of a visit near place 2 as one place.
map::TopologicalMap mixed_map() {
  map::TopologicalMap map = straight_tour(10);
  map.places[9].members.insert(map.places[9].members.begin(), image(2));
  map.places.erase(map.places.begin() + 2);
  for (map::Edge& edge : map.edges) {
    for (PlaceId* end : {&edge.from, &edge.to}) {
      if (*end != place(2)) continue;
      *end = place(9);
      edge.confidence = 0.0;
      edge.bearing_rad = edge.turn_rad = std::nullopt;
    }
  }
  return map;
}

TEST(Doubts, ThereAreNoneInAMapThatHoldsTogether) {
  EXPECT_THAT(doubts({}), IsEmpty());
  EXPECT_THAT(doubts(straight_tour(1)), IsEmpty());
  EXPECT_THAT(doubts(straight_tour(12)), IsEmpty());
}

TEST(Doubts, AWayThatNoTourDroveIsAskedAbout) {
  map::TopologicalMap map = straight_tour(12);
  join(map, 1, 9, 0.98);
  const std::vector<Doubt> found = asked(map, DoubtKind::kWay);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].place_a, place(1));
  EXPECT_EQ(found[0].place_b, place(9));
  EXPECT_EQ(found[0].state, map::Decision::kAccepted);
  EXPECT_GT(found[0].probability, 0.9);
  EXPECT_GT(found[0].effect, 0.5);  // 7 m more to drive without it
  ASSERT_TRUE(apply_edit(map, found[0].if_no.front()));
  EXPECT_THAT(doubts(map), IsEmpty());
}

TEST(Doubts, AWayThatAPersonSaidThereIsIsAskedAboutNoMore) {
  map::TopologicalMap map = straight_tour(12);
  join(map, 1, 9, 0.98);
  ASSERT_TRUE(apply_edit(map, asked(map, DoubtKind::kWay).front().if_yes.front()));
  EXPECT_THAT(asked(map, DoubtKind::kWay), IsEmpty());
  EXPECT_EQ(doubts(map).back().by, map::Decider::kPerson);
}

TEST(Doubts, APlaceThatHoldsAVisitToAnotherIsAskedAbout) {
  map::TopologicalMap map = mixed_map();
  map.hypotheses.push_back({image(2), image(9), 0.9, {}, {0.9, 0.0, 0.1}, 0.9, 1.0, map::Decision::kAccepted});
  const std::vector<Doubt> found = asked(map, DoubtKind::kMixedPlace);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].place_a, place(9));
  EXPECT_EQ(found[0].place_b, place(9));
  EXPECT_EQ(found[0].image_a, image(9));
  EXPECT_EQ(found[0].image_b, image(2));
  EXPECT_GT(found[0].probability, 0.9);
  EXPECT_EQ(found[0].hypothesis, 0U);
  ASSERT_EQ(found[0].if_no.size(), 2U);
  EXPECT_EQ(found[0].if_no[0].kind, map::EditKind::kSplit);
  EXPECT_THAT(found[0].if_no[0].images, ElementsAre(image(2)));
  for (const map::Edit& edit : found[0].if_no) {
    ASSERT_TRUE(apply_edit(map, edit, [](const ImageId&) { return random_appearance(60, 102); }));
  }
  EXPECT_THAT(asked(map, DoubtKind::kMixedPlace), IsEmpty());
  EXPECT_THAT(asked(map, DoubtKind::kSamePlace), IsEmpty());
  EXPECT_EQ(map.hypotheses[0].decision, map::Decision::kRejected);
}

TEST(Doubts, APlaceThatAPersonCalledOneIsAskedAboutNoMore) {
  map::TopologicalMap map = mixed_map();
  const std::vector<Doubt> found = asked(map, DoubtKind::kMixedPlace);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].hypothesis);
  ASSERT_EQ(found[0].if_yes.size(), 1U);
  ASSERT_TRUE(apply_edit(map, found[0].if_yes.front()));
  EXPECT_THAT(asked(map, DoubtKind::kMixedPlace), IsEmpty());
  ASSERT_EQ(map.hypotheses.size(), 1U);
  EXPECT_EQ(map.hypotheses[0].decision, map::Decision::kAccepted);
  EXPECT_EQ(map.hypotheses[0].by, map::Decider::kPerson);
}

TEST(Doubts, WhatSomebodyWasNotSureOfComesLast) {
  map::TopologicalMap map = straight_tour(12);
  join(map, 1, 9, 0.98);
  join(map, 4, 7, 0.98);
  const std::vector<Doubt> found = asked(map, DoubtKind::kWay);
  ASSERT_EQ(found.size(), 2U);
  map::Edit aside = edit_of(map::EditKind::kSetAside, found[0].image_b, found[0].image_a, "way");
  aside.by = "anna";
  ASSERT_TRUE(apply_edit(map, aside));
  const std::vector<Doubt> after = asked(map, DoubtKind::kWay);
  ASSERT_EQ(after.size(), 2U);
  EXPECT_EQ(after[0].image_a, found[1].image_a);
  EXPECT_EQ(after[0].set_aside_by, "");
  EXPECT_EQ(after[1].image_a, found[0].image_a);
  EXPECT_EQ(after[1].set_aside_by, "anna");
  map::TopologicalMap answered = map;
  for (const map::Edit& edit : after[1].if_yes) ASSERT_TRUE(apply_edit(answered, edit));
  EXPECT_EQ(doubts(answered).back().by, map::Decider::kPerson);
  EXPECT_EQ(doubts(answered).back().set_aside_by, "") << "somebody was sure since";
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(asked(map, DoubtKind::kWay)[0].image_a, found[0].image_a);
}

TEST(Doubts, AVisitThatGoesTheSameWayIsNone) {
  map::TopologicalMap map = straight_tour(10);
  for (int i = 0; i < 10; ++i) {  // and back again
    map.images.push_back({image(10 + i), std::nullopt, Pose2{1.0 * (9 - i), 0.1, kPi}});
    map.places[static_cast<std::size_t>(9 - i)].members.push_back(image(10 + i));
  }
  EXPECT_THAT(asked(map, DoubtKind::kMixedPlace), IsEmpty());
  EXPECT_THAT(asked(map, DoubtKind::kWay), IsEmpty());
}

TEST(Doubts, WhatAPersonMergedIsAskedAboutNoMore) {
  map::TopologicalMap map = straight_tour(10);
  map::Edit merge;
  merge.kind = map::EditKind::kMerge;
  merge.image_a = image(9);
  merge.image_b = image(2);
  ASSERT_TRUE(apply_edit(map, merge));
  EXPECT_THAT(asked(map, DoubtKind::kMixedPlace), IsEmpty());
  ASSERT_FALSE(doubts(map).empty());
  EXPECT_EQ(doubts(map).back().by, map::Decider::kPerson);
}

TEST(Doubts, TwoPlacesThatLookAlikeAndLieTogetherAreAskedAbout) {
  map::TopologicalMap map = straight_tour(10);
  const auto seen = random_appearance(200, 7);
  map.places[1].appearances = {seen};
  map.places[8].appearances = {seen};
  for (int i = 5; i < 10; ++i) map.images[static_cast<std::size_t>(i)].odometry = Pose2{9.0 - i, 0.2, kPi};
  const std::vector<Doubt> found = asked(map, DoubtKind::kSamePlace);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(std::minmax(found[0].place_a, found[0].place_b), std::minmax(place(1), place(8)));
  EXPECT_EQ(found[0].state, map::Decision::kUndecided);
  EXPECT_FALSE(found[0].hypothesis);
  map::TopologicalMap apart = map;
  ASSERT_TRUE(apply_edit(apart, found[0].if_no.front()));
  EXPECT_EQ(apart.places.size(), 10U);
  EXPECT_THAT(asked(apart, DoubtKind::kSamePlace), IsEmpty()) << "nobody is asked twice";
  ASSERT_TRUE(apply_edit(map, found[0].if_yes.front()));
  EXPECT_EQ(map.places.size(), 9U);
  EXPECT_THAT(asked(map, DoubtKind::kSamePlace), IsEmpty());
}

TEST(Doubts, AHypothesisIsDecidedByTheAnswer) {
  map::TopologicalMap map = straight_tour(10);
  const auto seen = random_appearance(200, 7);
  map.places[1].appearances = {seen};
  map.places[8].appearances = {seen};
  for (int i = 5; i < 10; ++i) map.images[static_cast<std::size_t>(i)].odometry = Pose2{9.0 - i, 0.2, kPi};
  map.hypotheses.push_back({image(1), image(8), 0.9, {}, {0.2, 0.7, 0.1}, 0.2, 0.3, map::Decision::kRejected});
  map.hypotheses.push_back({image(2), image(7), 0.8, {}, {0.5, 0.2, 0.3}, 0.5, 0.8, map::Decision::kUndecided});
  const std::vector<Doubt> found = asked(map, DoubtKind::kSamePlace);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].state, map::Decision::kRejected);
  ASSERT_EQ(found[0].neighbours.size(), 1U);
  EXPECT_EQ(found[0].neighbours[0].place_a, place(2));
  EXPECT_TRUE(found[0].neighbours[0].speaks_for);
  EXPECT_NEAR(found[0].neighbours[0].weight, 1.0 - std::sin(2.0 * kPi / 48.0), 1e-9);
  map::TopologicalMap left = map;
  for (const map::Edit& edit : found[0].if_no) ASSERT_TRUE(apply_edit(left, edit));
  EXPECT_THAT(asked(left, DoubtKind::kSamePlace), IsEmpty());
  ASSERT_TRUE(apply_edit(map, found[0].if_yes.front()));
  EXPECT_EQ(map.places.size(), 9U);
  EXPECT_EQ(map.hypotheses[0].by, map::Decider::kPerson);
}

TEST(Doubts, AreTheSameWithAnyNumberOfThreads) {
  map::TopologicalMap map = mixed_map();
  join(map, 1, 7, 0.0);
  const std::vector<Doubt> one = doubts(map, 1);
  const std::vector<Doubt> four = doubts(map, 4);
  ASSERT_EQ(one.size(), four.size());
  ASSERT_GE(one.size(), 2U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].image_b, four[i].image_b);
    EXPECT_EQ(one[i].weight(), four[i].weight());
  }
  EXPECT_TRUE(std::ranges::is_sorted(one, std::greater<>(), &Doubt::weight));
}

TEST(Doubts, CanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  const auto found = doubts_of(straight_tour(3), {}, 1, stop.get_token());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

TEST(SamePlaceDoubt, TwinsThatTheLayoutKeepsApartAreTwo) {
  SamePlaceSigns signs;
  signs.distance = 0.3;
  signs.confidence = 0.9;
  signs.apart_m = 0.3;
  signs.way_m = 4.0;
  EXPECT_GT(probability_of_one_place(signs), 0.9);
  signs.apart_m = 17.0;
  EXPECT_LT(probability_of_one_place(signs), 0.1);
  signs.way_m = 400.0;  // so far that the layout may be that wrong
  EXPECT_GT(probability_of_one_place(signs), 0.3);
}

}  // namespace
}  // namespace homeward::mapping::doubts_test
