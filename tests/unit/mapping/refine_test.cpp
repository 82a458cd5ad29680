// SPDX-License-Identifier: Apache-2.0
#include "mapping/refine.hpp"

#include <gtest/gtest.h>

#include "mapping/edit_log.hpp"
#include "support/sample_map.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::mapping::refine_test {
namespace {

constexpr std::int64_t kPlenty = 100'000'000;

features::Appearance look(unsigned seed) { return testing::random_appearance(120, seed); }

/// Two places by day; night pictures that have nothing in common with them.
class Refine : public ::testing::Test {
 protected:
  Refine() {
    map_ = testing::sample_map();
    map_.edits.clear();
    map_.places[0].appearances = {look(1)};
    map_.places[1].appearances = {look(2)};
    map_.motion.distance_scale = 0.5;
  }

  Refinement refine(const std::vector<std::pair<int, const features::Appearance*>>& seen,
                    std::int64_t spare_bytes = kPlenty) {
    std::vector<Sighting> sightings;
    for (const auto& [place, appearance] : seen) {
      sightings.push_back({place, static_cast<int>(sightings.size()), appearance});
    }
    return refine_places(map_, sightings, config_, spare_bytes, threads_, {}).value();
  }

  map::TopologicalMap map_;
  RefineConfig config_;
  int threads_ = 2;
  const features::Appearance day_ = look(1);
  const features::Appearance night_ = look(10);
  const features::Appearance dusk_ = look(11);
  const features::Appearance fog_ = look(12);
};

TEST_F(Refine, APlaceGainsWhatItDoesNotKnow) {
  const map::TopologicalMap before = map_;
  const Refinement refinement = refine({{0, &day_}, {0, &night_}});
  ASSERT_EQ(refinement.gained.size(), 1U);
  EXPECT_EQ(refinement.gained[0].place.str(), "p1");
  EXPECT_EQ(refinement.gained[0].picture, 1);
  EXPECT_GT(refinement.gained[0].gain, 5.0);
  EXPECT_FALSE(refinement.gained[0].replaced);
  EXPECT_EQ(map_.revision, before.revision + 1);
  ASSERT_EQ(map_.places[0].appearances.size(), 2U);
  EXPECT_EQ(map_.places[0].appearances[0].sift.descriptors, before.places[0].appearances[0].sift.descriptors);
  EXPECT_EQ(map_.places[0].appearances[1].sift.descriptors, night_.sift.descriptors);
  EXPECT_EQ(map_.places[1].appearances.size(), 1U);
  EXPECT_EQ(map_.places[0].members, before.places[0].members);
  EXPECT_EQ(map_.images.size(), before.images.size());
}

TEST_F(Refine, TheSameOnceMoreSaysNothing) {
  refine({{0, &night_}});
  const std::int64_t revision = map_.revision;
  EXPECT_TRUE(refine({{0, &night_}, {0, &day_}}).gained.empty());
  EXPECT_EQ(map_.revision, revision);
}

TEST_F(Refine, AtMostSoManyAndTheMostTellingFirst) {
  config_.most_appearances = 2;
  const Refinement refinement = refine({{0, &dusk_}, {0, &night_}, {0, &night_}, {0, &fog_}});
  ASSERT_EQ(refinement.gained.size(), 1U);
  EXPECT_EQ(map_.places[0].appearances.size(), 2U);
  EXPECT_EQ(map_.places[0].appearances[1].sift.descriptors, night_.sift.descriptors);  // it explains two
}

TEST_F(Refine, AFullPlaceExchangesWhatSaysLeastButNeverThePrototype) {
  config_.most_appearances = 2;
  refine({{0, &dusk_}});
  const Refinement refinement = refine({{0, &night_}, {0, &night_}, {0, &night_}});
  ASSERT_EQ(refinement.gained.size(), 1U);
  EXPECT_TRUE(refinement.gained[0].replaced);
  ASSERT_EQ(map_.places[0].appearances.size(), 2U);
  EXPECT_EQ(map_.places[0].appearances[0].sift.descriptors, day_.sift.descriptors);
  EXPECT_EQ(map_.places[0].appearances[1].sift.descriptors, night_.sift.descriptors);
  config_.most_appearances = 1;
  EXPECT_TRUE(refine({{1, &fog_}, {1, &fog_}, {1, &fog_}}).gained.empty());
}

TEST_F(Refine, WhatAPersonMergedIsNotExchanged) {
  map::Edit merge;
  merge.kind = map::EditKind::kMerge;
  merge.image_a = map_.places[0].prototype;
  merge.image_b = map_.places[1].prototype;
  ASSERT_TRUE(apply_edit(map_, merge));
  ASSERT_EQ(map_.places[0].appearances.size(), 2U);
  config_.most_appearances = 2;
  EXPECT_TRUE(refine({{0, &night_}, {0, &night_}, {0, &night_}}).gained.empty());
  config_.most_appearances = 3;  // there is room for one more
  EXPECT_EQ(refine({{0, &night_}}).gained.size(), 1U);
}

TEST_F(Refine, BytesAreSpentWhereTheyTellMost) {
  const std::int64_t one = kept_bytes(thinned(night_, config_.most_features));
  const Refinement refinement = refine({{0, &night_}, {1, &dusk_}, {1, &dusk_}}, one + one / 2);
  ASSERT_EQ(refinement.gained.size(), 1U);
  EXPECT_EQ(refinement.gained[0].place.str(), "p2");
  EXPECT_EQ(refinement.over_budget, 1);
  EXPECT_EQ(refinement.bytes, one);
  EXPECT_TRUE(refine({{0, &night_}}, 0).gained.empty());
}

TEST_F(Refine, DoesNotDependOnThreads) {
  const map::TopologicalMap before = map_;
  const std::vector<std::pair<int, const features::Appearance*>> seen = {
      {0, &night_}, {1, &dusk_}, {0, &fog_}, {1, &fog_}, {1, &day_}};
  threads_ = 1;
  refine(seen);
  const map::TopologicalMap one = map_;
  map_ = before;
  threads_ = 4;
  refine(seen);
  for (std::size_t p = 0; p < 2; ++p) {
    ASSERT_EQ(map_.places[p].appearances.size(), one.places[p].appearances.size());
    for (std::size_t a = 0; a < one.places[p].appearances.size(); ++a) {
      EXPECT_EQ(map_.places[p].appearances[a].sift.descriptors, one.places[p].appearances[a].sift.descriptors);
    }
  }
}

TEST_F(Refine, CanBeCancelled) {
  std::stop_source stop;
  stop.request_stop();
  const std::vector<Sighting> sightings = {{0, 0, &night_}};
  const auto cut = refine_places(map_, sightings, config_, kPlenty, 1, stop.get_token());
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(map_.places[0].appearances.size(), 1U);
}

TEST(Thinned, KeepsTheFirstAndItsBytesAreThoseOfTheFile) {
  const features::Appearance all = look(5);
  const features::Appearance few = thinned(all, 50);
  EXPECT_EQ(few.sift.size(), 50);
  EXPECT_EQ(few.sift.descriptors, all.sift.descriptors.topRows(50));
  EXPECT_EQ(thinned(all, 1000).sift.size(), all.sift.size());
  const auto bytes = static_cast<std::int64_t>(wire::encode_appearance(few).size());
  EXPECT_GE(kept_bytes(few), bytes);
  EXPECT_LE(kept_bytes(few), bytes + 1024);
}

}  // namespace
}  // namespace homeward::mapping::refine_test
