// SPDX-License-Identifier: Apache-2.0
// What tours and drives bring to an edited map stays when its edits are taken back.
#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "mapping/common_features.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/grow.hpp"
#include "mapping/refine.hpp"
#include "support/corridor_tour.hpp"
#include "support/new_tour.hpp"
#include "support/same_state.hpp"

namespace homeward::mapping::carry_over_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::new_tour;
using homeward::testing::random_appearance;
using homeward::testing::same_state;
using homeward::testing::walk;
using map::EditKind;

/// A corridor of 12 m that was taught and then edited.
class CarryOver : public ::testing::Test {
 protected:
  void SetUp() override { map_ = make_map(old_.input(), {}, nullptr); }

  void edit(EditKind kind, const ImageId& a, const ImageId& b, const std::string& text = {},
            std::vector<ImageId> images = {}) {
    map::Edit edit;
    edit.kind = kind;
    edit.image_a = a;
    edit.image_b = b;
    edit.text = text;
    edit.images = std::move(images);
    const Status applied = apply_edit(map_, edit, [&](const ImageId& image) -> Result<features::Appearance> {
      return old_.appearances[static_cast<std::size_t>(map::image_indices(map_).at(image))];
    });
    ASSERT_TRUE(applied) << applied.error().message;
  }
  /// The images of the first place with three or more.
  [[nodiscard]] const map::Place& large_place() const {
    return *std::ranges::find_if(map_.places, [](const map::Place& place) { return place.members.size() >= 3; });
  }

  /// The corridor driven again.
  [[nodiscard]] map::TopologicalMap grown(const map::TopologicalMap& map) const {
    std::vector<double> position_m;
    for (double x_m = 0.1; x_m < 14.0; x_m += 0.4) position_m.push_back(x_m);
    const GrowthInput input = growth_input(map, new_tour(static_cast<int>(position_m.size()))).value();
    const auto index = map::image_indices(map);
    for (int image = input.new_images; image < static_cast<int>(input.images.size()); ++image) {
      const ImageId& prototype = input.images[static_cast<std::size_t>(image)].id;
      position_m.push_back(old_.position_m[static_cast<std::size_t>(index.at(prototype))]);
    }
    PairTable pairs = corridor_tour(position_m, {static_cast<int>(position_m.size())}).pairs;
    for (int b = input.new_images; b < pairs.images(); ++b) {
      for (int a = input.new_images; a < b; ++a) pairs.set(a, b, {});
    }
    return grow_map(map, input, pairs, {}).map;
  }

  CorridorTour old_ = corridor_tour(walk(30, false), {30});
  map::TopologicalMap map_;
};

TEST_F(CarryOver, NewToursStayWhereEditsAreTakenBackAndTheEditsHoldUntilThen) {
  const map::TopologicalMap taught = map_;
  const map::Place place = large_place();
  const ImageId leaves = place.members.front() == place.prototype ? place.members.back() : place.members.front();
  edit(EditKind::kRename, map_.places[0].prototype, {}, "porch");
  edit(EditKind::kSplit, place.prototype, {}, {}, {leaves});
  const PlaceId made = map::find_place_of(map_, leaves)->id;
  edit(EditKind::kMerge, map_.places[0].prototype,
       map_.places.back().id == made ? map_.places[map_.places.size() - 2].prototype : map_.places.back().prototype);
  map::TopologicalMap after = grown(map_);
  ASSERT_GT(after.images.size(), map_.images.size());
  for (const map::Edit& edit : after.edits) EXPECT_EQ(edit.lost, "");
  std::size_t held = 0;
  for (const map::Place& one : after.places) held += one.members.size();
  EXPECT_EQ(held, after.images.size()) << "each image is in one place";
  for (const map::Place& before : map_.places) {
    const map::Place* now = map::find_place(after, before.id);
    ASSERT_NE(now, nullptr) << before.id.str();
    EXPECT_EQ(now->prototype, before.prototype);
    EXPECT_EQ(now->label, before.label);
    for (const ImageId& member : before.members) {
      EXPECT_NE(std::ranges::find(now->members, member), now->members.end()) << member.str();
    }
  }
  const map::TopologicalMap with_edits = after;
  while (undo_change(after)) {
  }
  held = 0;
  for (const map::Place& one : after.places) held += one.members.size();
  EXPECT_EQ(held, after.images.size()) << "what the tour brought stays";
  for (const map::Place& before : taught.places) {
    const map::Place* now = map::find_place(after, before.id);
    ASSERT_NE(now, nullptr) << before.id.str();
    EXPECT_EQ(now->prototype, before.prototype);
    EXPECT_EQ(now->label, before.label);
  }
  EXPECT_EQ(map::find_place(after, made), nullptr);
  for (std::size_t e = 0; e < taught.edges.size(); ++e) {
    EXPECT_NE(map::find_edge(after, taught.edges[e].from, taught.edges[e].to), nullptr);
  }
  while (redo_change(after)) {
  }
  EXPECT_TRUE(same_state(after, with_edits));
}

TEST_F(CarryOver, NewImagesGoAlongThroughOneSplitAfterTheOther) {
  const map::Place place = large_place();
  std::vector<ImageId> leaving = place.members;
  std::erase(leaving, place.prototype);
  ASSERT_GE(leaving.size(), 2U);
  edit(EditKind::kSplit, place.prototype, {}, {}, leaving);
  edit(EditKind::kSplit, leaving.front(), {}, {}, {leaving.back()});
  const map::TopologicalMap after = grown(map_);
  for (const map::Edit& edit : after.edits) EXPECT_EQ(edit.lost, "");
  std::size_t held = 0;
  for (const map::Place& one : after.places) held += one.members.size();
  EXPECT_EQ(held, after.images.size());
  for (const map::Place& before : map_.places) {
    const map::Place* now = map::find_place(after, before.id);
    ASSERT_NE(now, nullptr) << before.id.str();
    EXPECT_EQ(now->prototype, before.prototype);
  }
}

TEST_F(CarryOver, AMapThatNobodyEditedKeepsNoSecondState) { EXPECT_EQ(grown(map_).unedited, nullptr); }

TEST_F(CarryOver, WhatDrivesTaughtAPlaceThatAnEditMadeIsThereWithIt) {
  const map::Place place = large_place();
  const ImageId leaves = place.members.front() == place.prototype ? place.members.back() : place.members.front();
  edit(EditKind::kSplit, place.prototype, {}, {}, {leaves});
  map::TopologicalMap after = map_;
  const features::Appearance night = random_appearance(120, 7);
  const features::Appearance dusk = random_appearance(120, 8);
  const auto index = map::place_indices(after);
  const PlaceId made = map::find_place_of(after, leaves)->id;
  const std::vector<Sighting> sightings = {{index.at(made), 0, &night}, {index.at(place.id), 1, &dusk}};
  ASSERT_EQ(refine_places(after, sightings, {}, 1'000'000, 1, {}).value().gained.size(), 2U);
  EXPECT_EQ(map::find_place(after, made)->appearances.size(), 2U);
  EXPECT_EQ(map::find_place(after, place.id)->appearances.size(), 2U);
  const map::TopologicalMap refined = after;
  ASSERT_TRUE(undo_change(after));
  EXPECT_EQ(map::find_place(after, place.id)->appearances.size(), 2U) << "its own, not that of the place that is gone";
  ASSERT_TRUE(redo_change(after));
  EXPECT_TRUE(same_state(after, refined));
}

TEST_F(CarryOver, WhatIsCountedOverAllPlacesIsCountedInBothStates) {
  edit(EditKind::kMerge, map_.places[0].prototype, map_.places.back().prototype);
  map::TopologicalMap counted = map_;
  ASSERT_TRUE(count_common_features(counted, {}, 1, {}));
  const map::TopologicalMap merged = counted;
  EXPECT_EQ(counted.places[0].appearances.size(), 2U);
  ASSERT_TRUE(undo_change(counted));
  EXPECT_EQ(counted.places[0].appearances[0].sift.document_frequency,
            merged.places[0].appearances[0].sift.document_frequency);
  EXPECT_EQ(counted.places.back().appearances[0].sift.document_frequency,
            merged.places[0].appearances[1].sift.document_frequency);
}

}  // namespace
}  // namespace homeward::mapping::carry_over_test
