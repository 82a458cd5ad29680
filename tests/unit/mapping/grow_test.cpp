// SPDX-License-Identifier: Apache-2.0
#include "mapping/grow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "map/lookup.hpp"
#include "map/parts.hpp"
#include "mapping/edit_log.hpp"
#include "support/corridor_tour.hpp"
#include "support/new_tour.hpp"

namespace homeward::mapping::grow_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::new_tour;
using homeward::testing::walk;

/// The map of a corridor of 12 m, and what becomes of it when it is driven again.
class Grow : public ::testing::Test {
 protected:
  void SetUp() override { map_ = make_map(old_.input(), {}, nullptr); }

  using Tweak = std::function<void(PairTable&, const GrowthInput&)>;
  [[nodiscard]] GrownMap grow(const std::vector<double>& position_m, std::vector<MarkedImage> marks = {},
                              const Tweak& tweak = {}, const MappingConfig& config = {}) const {
    NewTours tours = new_tour(static_cast<int>(position_m.size()));
    tours.marks = std::move(marks);
    const GrowthInput input = growth_input(map_, std::move(tours)).value();
    std::vector<double> all_m = position_m;
    for (int image = input.new_images; image < static_cast<int>(input.images.size()); ++image) {
      all_m.push_back(position_of(input.images[static_cast<std::size_t>(image)].id));
    }
    PairTable pairs = corridor_tour(all_m, {static_cast<int>(all_m.size())}).pairs;
    for (int b = input.new_images; b < pairs.images(); ++b) {
      for (int a = input.new_images; a < b; ++a) pairs.set(a, b, {});
    }
    if (tweak) tweak(pairs, input);
    return grow_map(map_, input, pairs, config);
  }

  /// Changes what new images and old places say of each other.
  static Tweak between(const std::function<void(PairRelation&)>& change) {
    return [change](PairTable& pairs, const GrowthInput& input) {
      for (int anchor = input.new_images; anchor < pairs.images(); ++anchor) {
        for (int image = 0; image < input.new_images; ++image) {
          PairRelation relation = pairs.relation(image, anchor);
          if (!relation.verified()) continue;
          change(relation);
          pairs.set(image, anchor, relation);
        }
      }
    };
  }

  [[nodiscard]] double position_of(const ImageId& old_image) const {
    return old_.position_m[static_cast<std::size_t>(map::image_indices(map_).at(old_image))];
  }
  [[nodiscard]] ImageId image(int index) const { return old_.images[static_cast<std::size_t>(index)].id; }
  void edit(map::EditKind kind, int a, int b, const std::string& text = {}) {
    map::Edit edit;
    edit.kind = kind;
    edit.image_a = image(a);
    if (b >= 0) edit.image_b = image(b);
    edit.text = text;
    edit.by = "anna";
    const Status applied = apply_edit(map_, edit);
    ASSERT_TRUE(applied) << applied.error().message;
  }

  /// Whatever comes, the map has all that it had.
  void expect_kept(const map::TopologicalMap& grown) const {
    ASSERT_GE(grown.places.size(), map_.places.size());
    for (std::size_t p = 0; p < map_.places.size(); ++p) {
      const map::Place& before = map_.places[p];
      const map::Place& after = grown.places[p];
      EXPECT_EQ(after.id, before.id);
      EXPECT_EQ(after.prototype, before.prototype);
      ASSERT_GE(after.members.size(), before.members.size());
      EXPECT_TRUE(std::ranges::equal(before.members, std::span(after.members).first(before.members.size())));
      ASSERT_EQ(after.appearances.size(), before.appearances.size());
      EXPECT_EQ(after.appearances[0].sift.descriptors, before.appearances[0].sift.descriptors);
    }
    ASSERT_GE(grown.edges.size(), map_.edges.size());
    for (std::size_t e = 0; e < map_.edges.size(); ++e) {
      EXPECT_EQ(grown.edges[e].from, map_.edges[e].from);
      EXPECT_EQ(grown.edges[e].to, map_.edges[e].to);
      EXPECT_EQ(grown.edges[e].length_m, map_.edges[e].length_m);
      EXPECT_EQ(grown.edges[e].blocked, map_.edges[e].blocked);
    }
    EXPECT_EQ(grown.edits.size(), map_.edits.size());
    EXPECT_EQ(grown.revision, map_.revision + 1);
    std::set<PlaceId> ids;
    for (const map::Place& place : grown.places) EXPECT_TRUE(ids.insert(place.id).second) << place.id.str();
  }

  CorridorTour old_ = corridor_tour(walk(30, false), {30});
  map::TopologicalMap map_;
};

std::vector<double> stretch(double from_m, double to_m) {
  std::vector<double> position_m;
  for (double x_m = from_m; x_m < to_m; x_m += 0.4) position_m.push_back(x_m);
  return position_m;
}

TEST_F(Grow, TheSameWayAgainJoinsThePlacesThatAreThere) {
  const std::vector<double> position_m = stretch(0.1, 11.7);
  const GrownMap grown = grow(position_m);
  expect_kept(grown.map);
  EXPECT_EQ(grown.added.images, static_cast<int>(position_m.size()));
  EXPECT_GE(grown.added.joined_images, 24) << "of " << position_m.size();
  EXPECT_EQ(grown.map.images.size(), 30 + position_m.size());
  EXPECT_EQ(grown.map.places.size(), map_.places.size() + static_cast<std::size_t>(grown.added.places));
  const auto index = map::image_indices(grown.map);
  std::size_t held = 0;
  for (std::size_t p = 0; p < grown.map.places.size(); ++p) {
    held += grown.map.places[p].members.size();
    if (p >= map_.places.size()) continue;
    for (const ImageId& member : grown.map.places[p].members) {
      const auto i = static_cast<std::size_t>(index.at(member));
      const double at_m = i < 30 ? old_.position_m[i] : position_m[i - 30];
      EXPECT_LT(std::abs(at_m - position_of(grown.map.places[p].prototype)), 2.0);
    }
  }
  EXPECT_EQ(held, grown.map.images.size());
  EXPECT_EQ(map::parts(grown.map).size(), 1U);
  EXPECT_GT(grown.added.hypotheses, 0);
}

TEST_F(Grow, ANewStretchBecomesNewPlacesBehindTheOldOnes) {
  const GrownMap grown = grow(stretch(6.0, 20.0));
  expect_kept(grown.map);
  EXPECT_GE(grown.added.joined_images, 8);
  EXPECT_GE(grown.added.places, 4);
  EXPECT_EQ(grown.added.appearances, grown.added.places);
  EXPECT_GE(grown.added.edges, 2 * grown.added.places);
  EXPECT_EQ(grown.map.places[map_.places.size()].id.str(), "p" + std::to_string(map_.next_place_number));
  EXPECT_EQ(grown.map.next_place_number, map_.next_place_number + grown.added.places);
  EXPECT_EQ(map::parts(grown.map).size(), 1U);
  EXPECT_EQ(map::tell_parts(map::parts(grown.map)), "");
}

TEST_F(Grow, ATourElsewhereStaysAPartOfItsOwnAndThatIsTold) {
  const GrownMap grown = grow(stretch(100.0, 110.0));
  expect_kept(grown.map);
  EXPECT_EQ(grown.added.joined_images, 0);
  const std::vector<map::MapPart> parts = map::parts(grown.map);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].tours, std::vector<std::string>{"t0"});
  EXPECT_EQ(parts[1].tours, std::vector<std::string>{"new"});
  EXPECT_EQ(parts[0].places.size(), map_.places.size());
  const std::string text = map::tell_parts(parts);
  EXPECT_NE(text.find("2 parts"), std::string::npos) << text;
  EXPECT_NE(text.find("of new"), std::string::npos) << text;
  EXPECT_NE(text.find("Drive a tour that passes through both"), std::string::npos) << text;
}

TEST_F(Grow, APersonsWordStands) {
  edit(map::EditKind::kRename, 0, -1, "kitchen");
  const map::Edge removed = map_.edges[2];
  const auto middle_of = [&](const PlaceId& id) { return map::find_place(map_, id)->prototype; };
  map::Edit remove;
  remove.kind = map::EditKind::kRemoveEdge;
  remove.image_a = middle_of(removed.from);
  remove.image_b = middle_of(removed.to);
  ASSERT_TRUE(apply_edit(map_, remove));
  map::Edit block;
  block.kind = map::EditKind::kBlockEdge;
  block.image_a = middle_of(map_.edges[0].from);
  block.image_b = middle_of(map_.edges[0].to);
  block.text = "true";
  ASSERT_TRUE(apply_edit(map_, block));
  const GrownMap grown = grow(stretch(0.0, 11.7));
  expect_kept(grown.map);
  EXPECT_EQ(grown.map.places[0].label, "kitchen");
  EXPECT_EQ(map::find_edge(grown.map, removed.from, removed.to), nullptr);
  EXPECT_EQ(map::find_edge(grown.map, removed.to, removed.from), nullptr);
  EXPECT_TRUE(grown.map.edges[0].blocked);
}

TEST_F(Grow, MarksNameWhatHasNoNameAndNeverRename) {
  edit(map::EditKind::kRename, 0, -1, "kitchen");
  const std::vector<double> position_m = stretch(0.0, 11.7);
  const GrownMap grown = grow(position_m, {{0, "bath"}, {15, "table"}});
  expect_kept(grown.map);
  EXPECT_EQ(grown.map.places[0].label, "kitchen");
  const map::Place* bath = map::find_place_of(grown.map, ImageId("new/1000.jpg"));
  ASSERT_NE(bath, nullptr);
  EXPECT_NE(bath->id, grown.map.places[0].id);  // another name is another place
  EXPECT_EQ(bath->label, "bath");
  EXPECT_EQ(grown.added.destinations, 2);
  EXPECT_EQ(map::find_place_of(grown.map, ImageId("new/1015.jpg"))->label, "table");
}

TEST_F(Grow, WhereLooksWereWrongBeforeTheyJoinNothing) {
  map::Hypothesis wrong;
  wrong.prototype_a = image(0);
  wrong.prototype_b = image(20);
  wrong.similarity = 1.0;
  wrong.masses_before = wrong.masses_after = {0.0, 0.99, 0.01};
  wrong.decision = map::Decision::kRejected;
  for (int i = 0; i < 20; ++i) map_.hypotheses.push_back(wrong);
  const GrownMap grown = grow(stretch(0.1, 11.7));
  expect_kept(grown.map);
  EXPECT_EQ(grown.added.joined_images, 0);
  EXPECT_EQ(map::parts(grown.map).size(), 2U);
}

TEST_F(Grow, WhatSharesTooLittleToBeOneSpotJoinsNothing) {
  const MappingConfig config;
  const auto little = between([&](PairRelation& relation) {
    relation.match_share = std::min(relation.match_share, 0.9F * config.least_meeting_share);
  });
  const GrownMap grown = grow(stretch(0.1, 11.7), {}, little);
  expect_kept(grown.map);
  EXPECT_EQ(grown.added.joined_images, 0);
  EXPECT_GE(grown.added.hypotheses, 5);  // a person may decide on them
  for (std::size_t h = map_.hypotheses.size(); h < grown.map.hypotheses.size(); ++h) {
    EXPECT_NE(grown.map.hypotheses[h].decision, map::Decision::kAccepted);
  }
}

TEST_F(Grow, OldPlacesAreMetAcrossClusters) {
  // Everything looks a little different from then: images of one pass are always more alike.
  const auto other_light = between([](PairRelation& relation) { relation.distance += 0.35F; });
  MappingConfig config;
  const GrownMap with = grow(stretch(0.1, 11.7), {}, other_light, config);
  expect_kept(with.map);
  config.sources.across = false;
  const GrownMap without = grow(stretch(0.1, 11.7), {}, other_light, config);
  EXPECT_GT(with.added.joined_images, without.added.joined_images + 10);
  for (const map::Place& place : with.map.places) EXPECT_LE(place.members.size(), 10U);
}

/// Prototypes further apart than 0.9 m do not find each other.
void see_less(PairTable& pairs, const GrowthInput&) {
  for (int b = 0; b < pairs.images(); ++b) {
    for (int a = 0; a < b; ++a) {
      PairRelation relation = pairs.relation(a, b);
      if (!relation.verified() || relation.distance < 0.48F) continue;
      relation.confidence = 0.1F;
      pairs.set(a, b, relation);
    }
  }
}

TEST_F(Grow, NewImagesBecomePlacesWhereAnEdgeWouldBeWeak) {
  MappingConfig config;
  config.extra_place_depth = 0;
  const auto weak = [](const map::Edge& edge) { return edge.weak; };
  const GrownMap without = grow(stretch(8.0, 24.0), {}, see_less, config);
  EXPECT_GE(std::ranges::count_if(without.map.edges, weak), 10);
  const GrownMap grown = grow(stretch(8.0, 24.0), {}, see_less);
  expect_kept(grown.map);
  EXPECT_GE(grown.added.places, without.added.places + 5);
  EXPECT_EQ(grown.added.appearances, grown.added.places);
  EXPECT_EQ(std::ranges::count_if(grown.map.edges, weak), 0);
  std::size_t held = 0;
  for (const map::Place& place : grown.map.places) {
    EXPECT_FALSE(place.members.empty());
    EXPECT_NE(std::ranges::find(place.members, place.prototype), place.members.end());
    held += place.members.size();
  }
  EXPECT_EQ(held, grown.map.images.size());
}

TEST_F(Grow, NothingIsPutInWhereAPersonTookAnEdgeAway) {
  for (std::size_t p = 1; p < map_.places.size(); ++p) {
    map::Edit remove;
    remove.kind = map::EditKind::kRemoveEdge;
    remove.image_a = map_.places[p - 1].prototype;
    remove.image_b = map_.places[p].prototype;
    ASSERT_TRUE(apply_edit(map_, remove));
  }
  const GrownMap grown = grow(stretch(0.1, 11.7), {}, see_less);
  expect_kept(grown.map);
  EXPECT_GE(grown.added.joined_images, 24);
  EXPECT_EQ(grown.added.places, 0);
  EXPECT_EQ(grown.added.edges, 0);
}

TEST_F(Grow, SpreadsAreThoseOfOldAndNewTours) {
  // Twice as dense as the old tour: half as many steps lead to another place.
  std::vector<double> position_m;
  for (double x_m = 0.05; x_m < 11.6; x_m += 0.2) position_m.push_back(x_m);
  const GrownMap grown = grow(position_m);
  const auto before = static_cast<double>(old_.images.size() - 1);
  const auto now = static_cast<double>(position_m.size() - 1);
  double hops = 0.0;
  for (std::size_t i = 1; i < position_m.size(); ++i) {
    const std::size_t image = old_.images.size() + i;
    const auto place = [&](std::size_t which) { return map::find_place_of(grown.map, grown.map.images[which].id)->id; };
    hops += place(image) == place(image - 1) ? 0.0 : 1.0;
  }
  const double old_square = map_.motion.hop_spread * map_.motion.hop_spread;
  EXPECT_NEAR(grown.map.motion.hop_spread, std::sqrt((old_square * before + hops) / (before + now)), 1e-9);
  EXPECT_LT(grown.map.motion.hop_spread, map_.motion.hop_spread);
  EXPECT_LT(grown.map.motion.distance_scale, map_.motion.distance_scale + 0.1);
  EXPECT_NE(grown.map.motion.distance_scale, map_.motion.distance_scale);
  EXPECT_NE(grown.map.motion.distance_spread, map_.motion.distance_spread);
}

/// A corridor of 24 m driven twice with odometry. The second time, from 16 to 20 m everything looks as it did 12 m
/// before.
struct MovedPoster {
  MovedPoster() : old(corridor_tour(walk(60, false), {60})) {
    for (std::size_t i = 0; i < old.images.size(); ++i) old.images[i].odometry = Pose2{old.position_m[i], 0.0, 0.0};
    map = make_map(old.input(), {}, nullptr);
  }
  [[nodiscard]] GrownMap grow() const {
    std::vector<double> looks_m;
    NewTours tours = new_tour(60);
    for (int i = 0; i < 60; ++i) {
      const double at_m = 0.4 * i + 0.1;
      looks_m.push_back(at_m > 16.0 && at_m < 20.0 ? at_m - 12.0 : at_m);
      tours.images[static_cast<std::size_t>(i)].odometry = Pose2{at_m, 0.0, 0.0};
    }
    const GrowthInput input = growth_input(map, std::move(tours)).value();
    for (int image = input.new_images; image < static_cast<int>(input.images.size()); ++image) {
      looks_m.push_back(input.images[static_cast<std::size_t>(image)].odometry->x_m);
    }
    PairTable pairs = corridor_tour(looks_m, {static_cast<int>(looks_m.size())}).pairs;
    for (int b = 0; b < pairs.images(); ++b) {
      for (int a = 0; a < b; ++a) {
        PairRelation relation = pairs.relation(a, b);
        relation.direction_rad = 0.0F;
        const bool both_old = input.is_anchor(a);
        if (relation.verified()) pairs.set(a, b, both_old ? PairRelation() : relation);
      }
    }
    return grow_map(map, input, pairs, {});
  }
  CorridorTour old;
  map::TopologicalMap map;
};

TEST(GrowWithOdometry, WhatTheTwoWaysKeepApartStaysApart) {
  const MovedPoster corridor;
  const GrownMap grown = corridor.grow();
  EXPECT_GE(grown.added.joined_images, 40);
  for (std::size_t p = 0; p < grown.map.places.size(); ++p) {
    double least_m = 1e9;
    double most_m = -1e9;
    for (const map::MapImage& image : grown.map.images) {
      const auto& members = grown.map.places[p].members;
      if (std::ranges::find(members, image.id) == members.end()) continue;
      least_m = std::min(least_m, image.odometry->x_m);
      most_m = std::max(most_m, image.odometry->x_m);
    }
    EXPECT_LT(most_m - least_m, 3.0) << grown.map.places[p].id.str();
  }
}

TEST_F(Grow, ImagesAreAddedOnce) {
  NewTours again = new_tour(3);
  again.images[1].id = image(3);
  const auto known = growth_input(map_, again);
  ASSERT_FALSE(known);
  EXPECT_EQ(known.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(known.error().where, image(3).str());
  again.images[1].id = again.images[0].id;
  const auto twice = growth_input(map_, again);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().where, "new/1000.jpg");
}

}  // namespace
}  // namespace homeward::mapping::grow_test
