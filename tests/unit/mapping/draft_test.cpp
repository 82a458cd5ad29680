// SPDX-License-Identifier: Apache-2.0
#include "mapping/draft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/difference.hpp"
#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::draft_test {
namespace {

using map::Edit;
using map::EditKind;
using ::testing::ElementsAre;

/// Four places of two images each, joined in a chain.
map::TopologicalMap chain() {
  map::TopologicalMap map;
  for (int i = 0; i < 8; ++i) map.images.push_back({ImageId("t/" + std::to_string(i)), std::nullopt, std::nullopt});
  for (std::size_t i = 0; i < 4; ++i) {
    map::Place place;
    place.id = PlaceId("p" + std::to_string(i + 1));
    place.prototype = map.images[2 * i].id;
    place.members = {map.images[2 * i].id, map.images[2 * i + 1].id};
    place.appearances.resize(1);
    map.places.push_back(place);
  }
  map.next_place_number = 5;
  for (std::size_t i = 0; i + 1 < 4; ++i) {
    for (const auto& [from, to] : {std::pair(i, i + 1), std::pair(i + 1, i)}) {
      map::Edge edge;
      edge.from = map.places[from].id;
      edge.to = map.places[to].id;
      map.edges.push_back(edge);
    }
  }
  map.revision = 7;
  return map;
}

Edit make(EditKind kind, std::int64_t change, int a, int b = -1, const std::string& text = {}) {
  Edit edit;
  edit.kind = kind;
  edit.change = change;
  edit.image_a = ImageId("t/" + std::to_string(a));
  if (b >= 0) edit.image_b = ImageId("t/" + std::to_string(b));
  edit.text = text;
  return edit;
}

Result<features::Appearance> look(const ImageId& image) {
  return testing::random_appearance(7, static_cast<unsigned>(image.str().back()));
}

TEST(Draft, IsTheMapWithItsEditsAndLeavesTheMapAlone) {
  const map::TopologicalMap base = chain();
  DraftedMap draft = apply_draft(base, {}, look);
  ASSERT_TRUE(edit_draft(draft, base, make(EditKind::kRename, 1, 0, -1, "porch"), look));
  ASSERT_TRUE(edit_draft(draft, base, make(EditKind::kMerge, 2, 2, 4), look));
  EXPECT_EQ(draft.map.revision, 7);
  EXPECT_EQ(draft.map.places.size(), 3U);
  EXPECT_EQ(draft.map.places.front().label, "porch");
  EXPECT_EQ(base.places.size(), 4U);
  EXPECT_TRUE(base.places.front().label.empty());
  EXPECT_THAT(changed_places(base, draft.map), ElementsAre(PlaceId("p1"), PlaceId("p2"), PlaceId("p3"), PlaceId("p4")));
}

TEST(Draft, AppliedAgainIsTheSame) {
  const map::TopologicalMap base = chain();
  DraftedMap draft = apply_draft(base, {}, look);
  Edit split = make(EditKind::kSplit, 1, 0);
  split.images = {ImageId("t/1")};
  ASSERT_TRUE(edit_draft(draft, base, split, look));
  ASSERT_TRUE(edit_draft(draft, base, make(EditKind::kMerge, 2, 2, 1), look));
  const DraftedMap again = apply_draft(base, draft.edits, look);
  EXPECT_TRUE(map::difference(draft.map, again.map).empty());
  EXPECT_EQ(draft.edits, again.edits);
}

TEST(Draft, ChangesAreUndoneAndRedoneWhole) {
  const map::TopologicalMap base = chain();
  std::vector<Edit> edits = {make(EditKind::kRename, 1, 0, -1, "porch"), make(EditKind::kRename, 2, 2, -1, "hall"),
                             make(EditKind::kRename, 2, 4, -1, "study")};
  EXPECT_EQ(next_change(edits), 3);
  ASSERT_TRUE(undo_in_draft(edits));
  const DraftedMap one = apply_draft(base, edits, look);
  EXPECT_EQ(one.map.places[0].label, "porch");
  EXPECT_EQ(one.map.places[1].label, "");
  EXPECT_EQ(one.map.places[2].label, "");
  ASSERT_TRUE(undo_in_draft(edits));
  EXPECT_EQ(undo_in_draft(edits).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(changed_places(base, apply_draft(base, edits, look).map).empty());
  ASSERT_TRUE(redo_in_draft(edits));
  EXPECT_EQ(apply_draft(base, edits, look).map.places[1].label, "") << "the first change comes back first";
  ASSERT_TRUE(redo_in_draft(edits));
  EXPECT_EQ(apply_draft(base, edits, look).map.places[2].label, "study");
  EXPECT_EQ(redo_in_draft(edits).error().code, ErrorCode::kNotFound);
}

TEST(Draft, AnEditEndsWhatCouldBeRedone) {
  const map::TopologicalMap base = chain();
  std::vector<Edit> edits = {make(EditKind::kRename, 1, 0, -1, "porch")};
  ASSERT_TRUE(undo_in_draft(edits));
  DraftedMap draft = apply_draft(base, edits, look);
  ASSERT_TRUE(edit_draft(draft, base, make(EditKind::kRename, 2, 2, -1, "hall"), look));
  EXPECT_EQ(redo_in_draft(draft.edits).error().code, ErrorCode::kNotFound);
}

TEST(Draft, SaysWhichEditsTheMapDoesNotTakeAnyMore) {
  const map::TopologicalMap base = chain();
  const std::vector<Edit> edits = {make(EditKind::kMerge, 1, 0, 2), make(EditKind::kRename, 2, 6, -1, "study")};
  map::TopologicalMap changed = base;
  ASSERT_TRUE(apply_edit(changed, make(EditKind::kDelete, 0, 2), look));
  const DraftedMap draft = apply_draft(changed, edits, look);
  EXPECT_FALSE(draft.edits[0].lost.empty());
  EXPECT_TRUE(draft.edits[1].lost.empty());
  EXPECT_EQ(map::find_place(draft.map, PlaceId("p4"))->label, "study");
  EXPECT_EQ(draft.map.revision, changed.revision);
  EXPECT_TRUE(apply_draft(base, draft.edits, look).edits[0].lost.empty()) << "it is not lost for ever";
}

TEST(Draft, RefusesWhatTheMapWouldRefuseAndStaysAsItWas) {
  const map::TopologicalMap base = chain();
  DraftedMap draft = apply_draft(base, {}, look);
  EXPECT_FALSE(edit_draft(draft, base, make(EditKind::kMerge, 1, 0, 0), look));
  EXPECT_TRUE(draft.edits.empty());
  EXPECT_TRUE(map::difference(base, draft.map).empty());
}

TEST(Draft, TouchesThePlacesOfItsWaysDestinationsAndDecisions) {
  map::TopologicalMap base = chain();
  map::Hypothesis hypothesis;
  hypothesis.prototype_a = base.places[0].prototype;
  hypothesis.prototype_b = base.places[3].prototype;
  base.hypotheses.push_back(hypothesis);
  const auto touched = [&](const Edit& edit) { return changed_places(base, apply_draft(base, {edit}, look).map); };
  EXPECT_THAT(touched(make(EditKind::kBlockEdge, 1, 0, 2, "true")), ElementsAre(PlaceId("p1"), PlaceId("p2")));
  EXPECT_THAT(touched(make(EditKind::kAddDestination, 1, 5, -1, "desk")), ElementsAre(PlaceId("p3")));
  EXPECT_THAT(touched(make(EditKind::kDecide, 1, 0, 6, "reject")), ElementsAre(PlaceId("p1"), PlaceId("p4")));
}

}  // namespace
}  // namespace homeward::mapping::draft_test
