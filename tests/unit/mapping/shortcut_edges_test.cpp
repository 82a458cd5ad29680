// SPDX-License-Identifier: Apache-2.0
#include "mapping/shortcut_edges.hpp"

#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "support/horseshoe.hpp"

namespace homeward::mapping::shortcut_edges_test {
namespace {

using map::EditKind;
using map::ShortcutState;

/// The horseshoe with a proposed shortcut between its ends.
map::TopologicalMap with_shortcut() {
  map::TopologicalMap map = testing::Horseshoe().map;
  map::Shortcut shortcut;
  shortcut.image_a = ImageId("tour/100");
  shortcut.image_b = ImageId("tour/110");
  shortcut.bearing_rad = 1.57;
  shortcut.turn_rad = 3.14;
  shortcut.back_bearing_rad = 1.5;
  shortcut.length_m = 2.4;
  shortcut.confidence = 0.9;
  shortcut.inliers = 40;
  map.shortcuts = {shortcut};
  return map;
}

map::Edit decide(const char* text, const char* a = "tour/100", const char* b = "tour/110") {
  map::Edit edit;
  edit.kind = EditKind::kDecideShortcut;
  edit.image_a = ImageId(a);
  edit.image_b = ImageId(b);
  edit.text = text;
  edit.by = "anna";
  return edit;
}

map::Edit edit_of(EditKind kind, const char* a, const char* b, const char* text = "") {
  map::Edit edit = decide(text, a, b);
  edit.kind = kind;
  return edit;
}

const map::Edge* edge(const map::TopologicalMap& map, bool back = false) {
  return back ? map::find_edge(map, PlaceId("p11"), PlaceId("p1")) : map::find_edge(map, PlaceId("p1"), PlaceId("p11"));
}

TEST(ShortcutEdges, AProposalIsNoEdge) {
  map::TopologicalMap map = with_shortcut();
  settle_shortcuts(map);
  EXPECT_EQ(edge(map), nullptr);
  EXPECT_EQ(map.shortcuts.size(), 1U);
}

TEST(ShortcutEdges, OneThatIsAcceptedIsAnEdgeBothWays) {
  map::TopologicalMap map = with_shortcut();
  ASSERT_TRUE(apply_edit(map, decide("accept")));
  EXPECT_EQ(map.revision, 2);
  EXPECT_EQ(map.shortcuts[0].state, ShortcutState::kAccepted);
  EXPECT_EQ(map.shortcuts[0].by, "anna");
  ASSERT_NE(edge(map), nullptr);
  ASSERT_NE(edge(map, true), nullptr);
  EXPECT_TRUE(edge(map)->shortcut);
  EXPECT_FALSE(edge(map)->weak);
  EXPECT_EQ(edge(map)->bearing_rad, 1.57);
  EXPECT_EQ(edge(map, true)->bearing_rad, 1.5);
  EXPECT_NEAR(*edge(map, true)->turn_rad, -3.14, 1e-9);
  EXPECT_EQ(edge(map)->length_m, 2.4);
  EXPECT_EQ(edge(map)->length_from, map::LengthSource::kOdometry);
  settle_shortcuts(map);
  EXPECT_EQ(map.edges.size(), 22U) << "not twice";
}

TEST(ShortcutEdges, ADecisionCanBeChangedAndTakenBack) {
  map::TopologicalMap map = with_shortcut();
  ASSERT_TRUE(apply_edit(map, decide("accept", "tour/110", "tour/100")));
  ASSERT_TRUE(apply_edit(map, decide("reject")));
  EXPECT_EQ(edge(map), nullptr);
  EXPECT_EQ(map.shortcuts[0].state, ShortcutState::kRejected);
  ASSERT_TRUE(undo_change(map));
  EXPECT_NE(edge(map), nullptr);
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(edge(map), nullptr);
  EXPECT_EQ(map.shortcuts[0].state, ShortcutState::kProposed);
  EXPECT_EQ(map.shortcuts[0].by, "method");
}

TEST(ShortcutEdges, ADecisionTakenBackDuringABuildIsNotBroughtBackByIt) {
  map::TopologicalMap present = with_shortcut();
  ASSERT_TRUE(apply_edit(present, decide("accept")));
  map::TopologicalMap built = present;
  ASSERT_TRUE(undo_change(present));
  replay_edits(built, present.edits);
  EXPECT_EQ(built.shortcuts[0].state, ShortcutState::kProposed);
  EXPECT_EQ(edge(built), nullptr);
  // And one that stands, does.
  ASSERT_TRUE(apply_edit(present, decide("accept")));
  replay_edits(built, present.edits);
  EXPECT_EQ(built.shortcuts[0].state, ShortcutState::kAccepted);
  EXPECT_NE(edge(built), nullptr);
  replay_edits(built, present.edits);
  EXPECT_EQ(built.edges.size(), 22U);
}

TEST(ShortcutEdges, SaysWhatIsWrongWithADecision) {
  map::TopologicalMap map = with_shortcut();
  EXPECT_EQ(apply_edit(map, decide("perhaps")).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(apply_edit(map, decide("accept", "tour/101")).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(map.edits.empty());
}

TEST(ShortcutEdges, IsNotAcceptedWhereATourHasDriven) {
  testing::Horseshoe tour;
  tour.map = with_shortcut();
  ASSERT_TRUE(apply_edit(tour.map, decide("reject")));
  tour.join(0, 10);
  EXPECT_EQ(apply_edit(tour.map, decide("accept")).error().code, ErrorCode::kConflict);
  EXPECT_EQ(tour.map.shortcuts[0].state, ShortcutState::kRejected);
  EXPECT_EQ(tour.map.edits.size(), 1U);
}

TEST(ShortcutEdges, BlocksLikeAnyEdgeAndStaysBlocked) {
  map::TopologicalMap map = with_shortcut();
  ASSERT_TRUE(apply_edit(map, decide("accept")));
  ASSERT_TRUE(apply_edit(map, edit_of(EditKind::kBlockEdge, "tour/100", "tour/110", "true")));
  ASSERT_TRUE(apply_edit(map, edit_of(EditKind::kRename, "tour/103", "tour/103", "bay")));
  EXPECT_TRUE(edge(map)->blocked);
  EXPECT_FALSE(edge(map, true)->blocked);
}

TEST(ShortcutEdges, TakingTheEdgeAwayRejectsIt) {
  map::TopologicalMap map = with_shortcut();
  ASSERT_TRUE(apply_edit(map, decide("accept")));
  ASSERT_TRUE(apply_edit(map, edit_of(EditKind::kRemoveEdge, "tour/110", "tour/100")));
  EXPECT_EQ(edge(map), nullptr);
  EXPECT_EQ(map.shortcuts[0].state, ShortcutState::kRejected);
}

TEST(ShortcutEdges, GoesWithThePlacesItJoins) {
  map::TopologicalMap map = with_shortcut();
  ASSERT_TRUE(apply_edit(map, decide("accept")));
  map::TopologicalMap merged = map;
  // p11 joins p10: its picture is no prototype any more, and nobody looked whether the way to p10 is free.
  ASSERT_TRUE(apply_edit(merged, edit_of(EditKind::kMerge, "tour/109", "tour/110")));
  EXPECT_TRUE(merged.shortcuts.empty());
  EXPECT_EQ(map::find_edge(merged, PlaceId("p1"), PlaceId("p10")), nullptr);
  ASSERT_TRUE(apply_edit(map, edit_of(EditKind::kDelete, "tour/110", "")));
  EXPECT_TRUE(map.shortcuts.empty());
  EXPECT_EQ(map.edges.size(), 18U);
}

TEST(ShortcutEdges, GivesWayToAnEdgeThatATourDrove) {
  testing::Horseshoe tour;
  tour.map = with_shortcut();
  ASSERT_TRUE(decide_shortcut(tour.map, decide("accept")));
  tour.join(0, 10);
  settle_shortcuts(tour.map);
  EXPECT_TRUE(tour.map.shortcuts.empty());
  ASSERT_NE(edge(tour.map), nullptr);
  EXPECT_FALSE(edge(tour.map)->shortcut);
  EXPECT_EQ(edge(tour.map, true), nullptr);
}

}  // namespace
}  // namespace homeward::mapping::shortcut_edges_test
