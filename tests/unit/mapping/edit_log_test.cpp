// SPDX-License-Identifier: Apache-2.0
#include "mapping/edit_log.hpp"

#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::edit_log_test {
namespace {

using map::EditKind;

/// Three places: a (images 0 1 2), b (3 4), c (5), joined in a chain.
map::TopologicalMap three_places() {
  map::TopologicalMap map;
  for (int i = 0; i < 6; ++i) map.images.push_back({ImageId("t/" + std::to_string(i)), std::nullopt, std::nullopt});
  const auto place = [&](const char* id, std::vector<std::size_t> members, std::size_t prototype) {
    map::Place made;
    made.id = PlaceId(id);
    made.prototype = map.images[prototype].id;
    for (const std::size_t member : members) made.members.push_back(map.images[member].id);
    made.appearances.resize(1);
    map.places.push_back(made);
  };
  place("p1", {0, 1, 2}, 1);
  place("p2", {3, 4}, 3);
  place("p3", {5}, 5);
  map.next_place_number = 4;
  map.next_destination_number = 2;
  for (const auto& [from, to] : {std::pair("p1", "p2"), {"p2", "p1"}, {"p2", "p3"}, {"p3", "p2"}}) {
    map::Edge edge;
    edge.from = PlaceId(from);
    edge.to = PlaceId(to);
    edge.bearing_rad = 0.1;
    map.edges.push_back(edge);
  }
  map.destinations.push_back({DestinationId("d1"), PlaceId("p2"), map.images[4].id, "table", {}});
  return map;
}

map::Edit make(EditKind kind, int a, int b = -1, const std::string& text = {}, const std::vector<int>& images = {}) {
  map::Edit edit;
  edit.kind = kind;
  edit.image_a = ImageId("t/" + std::to_string(a));
  if (b >= 0) edit.image_b = ImageId("t/" + std::to_string(b));
  edit.text = text;
  for (const int image : images) edit.images.push_back(ImageId("t/" + std::to_string(image)));
  return edit;
}

/// Any picture looks like seven features.
Result<features::Appearance> look(const ImageId& image) {
  return testing::random_appearance(7, static_cast<unsigned>(image.str().back()));
}

std::string members(map::TopologicalMap& map, int image) {
  std::string text;
  const map::Place* place = map::find_place_of(map, ImageId("t/" + std::to_string(image)));
  if (place == nullptr) return "none";
  for (const ImageId& member : place->members) text += member.str().substr(2);
  return text;
}

bool joined(map::TopologicalMap& map, const char* a, const char* b) {
  return map::find_edge(map, PlaceId(a), PlaceId(b)) != nullptr &&
         map::find_edge(map, PlaceId(b), PlaceId(a)) != nullptr;
}

TEST(Edits, RenameAndUndo) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 2, -1, "kitchen")));
  EXPECT_EQ(map.places[0].label, "kitchen");
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "pantry")));
  EXPECT_EQ(map.revision, 3);
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(map.places[0].label, "kitchen");
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(map.places[0].label, "");
  EXPECT_EQ(map.revision, 5);
  EXPECT_EQ(undo_change(map).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(map.edits.size(), 2U);
}

TEST(Edits, MergeTakesEverythingAlong) {
  auto map = three_places();
  map.places[1].label = "hall";
  ASSERT_TRUE(apply_edit(map, make(EditKind::kMerge, 5, 3)));
  EXPECT_EQ(members(map, 5), "345");
  EXPECT_EQ(map.places.size(), 2U);
  const map::Place* kept = map::find_place_of(map, ImageId("t/3"));
  EXPECT_EQ(kept->id.str(), "p3");
  EXPECT_EQ(kept->label, "hall");
  EXPECT_EQ(kept->appearances.size(), 2U);
  EXPECT_TRUE(joined(map, "p1", "p3"));
  EXPECT_EQ(map.edges.size(), 2U);
  EXPECT_FALSE(map.edges[0].bearing_rad);  // it belonged to another prototype
  EXPECT_EQ(map.destinations[0].place.str(), "p3");
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(members(map, 3), "34");
  EXPECT_EQ(map.edges.size(), 4U);
  EXPECT_EQ(map.edges[0].bearing_rad, 0.1);
  EXPECT_EQ(map.destinations[0].place.str(), "p2");
  ASSERT_TRUE(redo_change(map));
  EXPECT_EQ(members(map, 5), "345");
}

TEST(Edits, SplitMakesANewPlaceWithItsEdges) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kSplit, 1, -1, {}, {2}), look));
  EXPECT_EQ(members(map, 2), "2");
  EXPECT_EQ(members(map, 0), "01");
  EXPECT_EQ(map.places.back().id.str(), "p4");
  EXPECT_EQ(map.next_place_number, 5);
  EXPECT_TRUE(joined(map, "p1", "p4"));
  EXPECT_TRUE(joined(map, "p4", "p2"));
  EXPECT_FALSE(joined(map, "p1", "p2")) << "the tour went from image 2 to image 3";
  ASSERT_TRUE(apply_edit(map, make(EditKind::kSplit, 3, -1, {}, {4, 4}), look));  // named twice, gone once
  EXPECT_EQ(members(map, 4), "4");
  EXPECT_EQ(map.destinations[0].place.str(), "p5");
}

TEST(Edits, WhicheverPartLosesThePrototypeGetsAnotherWithItsAppearances) {
  auto map = three_places();
  map.places[0].appearances = {};
  map.places[0].appearances.push_back(testing::random_appearance(4, 1), ImageId("t/1"));
  map.places[0].appearances.push_back(testing::random_appearance(5, 2), ImageId("t/0"));
  map.places[0].appearances.push_back(testing::random_appearance(6, 3));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kSplit, 0, -1, {}, {1, 2}), look));
  const map::Place* stays = map::find_place_of(map, ImageId("t/0"));
  const map::Place* fresh = map::find_place_of(map, ImageId("t/2"));
  EXPECT_EQ(stays->id.str(), "p1");
  EXPECT_EQ(stays->prototype.str(), "t/0");
  EXPECT_EQ(stays->appearances.at(0).size(), 5) << "it was known already";
  EXPECT_EQ(stays->appearances.size(), 1U);
  EXPECT_EQ(fresh->prototype.str(), "t/2");
  EXPECT_EQ(fresh->appearances.at(0).size(), 7) << "it was looked at";
  EXPECT_EQ(fresh->appearances.at(1).size(), 4) << "that of image 1 came along";
}

TEST(Edits, NothingBecomesAPlaceByAPictureThatIsNotKept) {
  auto map = three_places();
  const Status status = apply_edit(map, make(EditKind::kSplit, 1, -1, {}, {2}));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kConflict);
  EXPECT_EQ(status.error().where, "t/2");
  EXPECT_EQ(members(map, 0), "012");
}

TEST(Edits, DestinationsComeAreNamedDockElsewhereAndGo) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kAddDestination, 0, -1, "door"), look));
  ASSERT_EQ(map.destinations.size(), 2U);
  EXPECT_EQ(map.destinations[1].id.str(), "d2");
  EXPECT_EQ(map.destinations[1].place.str(), "p1");
  EXPECT_EQ(map.destinations[1].appearance.size(), 7);
  ASSERT_TRUE(apply_edit(map, make(EditKind::kNameDestination, 0, -1, "front door")));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kSetPictogram, 0, -1, "door")));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kSetDestinationPicture, 0, 5)));
  EXPECT_EQ(map.destinations[1].label, "front door");
  EXPECT_EQ(map.destinations[1].pictogram, "door");
  EXPECT_EQ(map.destinations[1].image.str(), "t/5");
  EXPECT_EQ(map.destinations[1].place.str(), "p3");
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRemoveDestination, 4)));
  ASSERT_EQ(map.destinations.size(), 1U);
  while (undo_change(map)) {
  }
  ASSERT_EQ(map.destinations.size(), 1U);
  EXPECT_EQ(map.destinations[0].label, "table");
}

TEST(Edits, MoveAndDelete) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kMove, 0, -1, {}, {4})));
  EXPECT_EQ(members(map, 0), "0124");
  EXPECT_EQ(members(map, 3), "3");
  EXPECT_EQ(map.destinations[0].place.str(), "p1");
  EXPECT_TRUE(joined(map, "p1", "p3")) << "the tour went from image 4 to image 5";
  EXPECT_FALSE(joined(map, "p2", "p3"));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kDelete, 0)));
  EXPECT_EQ(members(map, 0), "none");
  EXPECT_TRUE(map.edges.empty());
  EXPECT_TRUE(map.destinations.empty());
}

TEST(Edits, EdgesComeGoAndAreBlocked) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kAddEdge, 0, 5)));
  EXPECT_TRUE(joined(map, "p1", "p3"));
  EXPECT_EQ(map.edges.back().by, map::Decider::kPerson);
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(map::find_edge(map, PlaceId("p1"), PlaceId("p3")), nullptr);
  ASSERT_TRUE(apply_edit(map, make(EditKind::kBlockEdge, 0, 3, "true")));
  EXPECT_TRUE(map::find_edge(map, PlaceId("p1"), PlaceId("p2"))->blocked);
  EXPECT_FALSE(map::find_edge(map, PlaceId("p2"), PlaceId("p1"))->blocked);  // one direction alone
  ASSERT_TRUE(undo_change(map));
  EXPECT_FALSE(map::find_edge(map, PlaceId("p1"), PlaceId("p2"))->blocked);
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRemoveEdge, 3, 5)));
  EXPECT_EQ(map.edges.size(), 2U);
}

TEST(Edits, AClosedWayStaysClosedWhereItsPlacesMergeOrPart) {
  auto merged = three_places();
  ASSERT_TRUE(apply_edit(merged, make(EditKind::kBlockEdge, 3, 5, "true")));
  ASSERT_TRUE(apply_edit(merged, make(EditKind::kMerge, 5, 0)));  // p1, whose way to p2 is open, joins p3
  EXPECT_TRUE(map::find_edge(merged, PlaceId("p2"), PlaceId("p3"))->blocked);
  EXPECT_FALSE(map::find_edge(merged, PlaceId("p3"), PlaceId("p2"))->blocked);
  auto moved = three_places();
  ASSERT_TRUE(apply_edit(moved, make(EditKind::kBlockEdge, 3, 5, "true")));
  ASSERT_TRUE(apply_edit(moved, make(EditKind::kMove, 0, -1, {}, {4})));  // the way to p3 begins at image 4
  EXPECT_TRUE(map::find_edge(moved, PlaceId("p1"), PlaceId("p3"))->blocked);
  EXPECT_FALSE(map::find_edge(moved, PlaceId("p3"), PlaceId("p1"))->blocked);
}

TEST(Edits, AnIdThatAnEditGaveIsNotGivenAgainInAMapThatWasBuiltBeforeIt) {
  auto present = three_places();
  ASSERT_TRUE(apply_edit(present, make(EditKind::kSplit, 1, -1, {}, {2}), look));
  auto built = three_places();
  replay_edits(built, present.edits, true, look);
  EXPECT_EQ(built.places.back().id.str(), "p4");
  EXPECT_EQ(built.next_place_number, 5);
  ASSERT_TRUE(apply_edit(built, make(EditKind::kSplit, 3, -1, {}, {4}), look));
  EXPECT_EQ(built.places.back().id.str(), "p5");
}

TEST(Edits, WhatARebuildForgotIsLookedAtAgainForARedo) {
  auto present = three_places();
  ASSERT_TRUE(apply_edit(present, make(EditKind::kSplit, 1, -1, {}, {2}), look));
  ASSERT_TRUE(undo_change(present));
  auto built = three_places();
  replay_edits(built, present.edits, true, look);
  EXPECT_EQ(redo_change(built).error().code, ErrorCode::kConflict) << "nothing knows the picture";
  ASSERT_TRUE(redo_change(built, look));
  EXPECT_EQ(members(built, 2), "2");
}

/// Closes the way between p1 and p2 in both directions, as one request does.
void close_both_ways(map::TopologicalMap& map) {
  const std::int64_t change = next_change(map);
  for (const auto& [a, b] : {std::pair(1, 3), {3, 1}}) {
    map::Edit edit = make(EditKind::kBlockEdge, a, b, "true");
    edit.change = change;
    ASSERT_TRUE(apply_edit(map, edit));
  }
}

/// Of the edges from p1 to p2 and back, whether they are blocked.
std::pair<bool, bool> closed(map::TopologicalMap& map) {
  return {map::find_edge(map, PlaceId("p1"), PlaceId("p2"))->blocked,
          map::find_edge(map, PlaceId("p2"), PlaceId("p1"))->blocked};
}

TEST(Edits, EditsOfOneChangeAreUndoneAndRedoneTogether) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "porch")));
  close_both_ways(map);
  EXPECT_EQ(closed(map), std::pair(true, true));
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(closed(map), std::pair(false, false));
  EXPECT_EQ(map.places[0].label, "porch") << "a change of its own";
  EXPECT_EQ(map.revision, 5);
  ASSERT_TRUE(redo_change(map));
  EXPECT_EQ(closed(map), std::pair(true, true));
  EXPECT_EQ(map.revision, 6);
  EXPECT_EQ(redo_change(map).error().code, ErrorCode::kNotFound);
}

TEST(Edits, ChangesAreRedoneInTheirOrderUntilSomethingElseIsChanged) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "porch")));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "hall")));
  ASSERT_TRUE(undo_change(map));
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(map.places[0].label, "");
  ASSERT_TRUE(redo_change(map));
  EXPECT_EQ(map.places[0].label, "porch");
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 5, -1, "attic")));
  EXPECT_EQ(redo_change(map).error().code, ErrorCode::kNotFound) << "it was of a map that is no more";
  ASSERT_TRUE(undo_change(map));
  ASSERT_TRUE(redo_change(map));
  EXPECT_EQ(map.places[2].label, "attic");
  EXPECT_EQ(map.places[0].label, "porch");
}

TEST(Edits, AChangeOfBeforeTheMapKeptItsUneditedStateStands) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kMerge, 0, 3)));
  map.unedited = nullptr;  // as a file of before says nothing of it
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 5, -1, "attic")));
  ASSERT_TRUE(undo_change(map));
  EXPECT_EQ(undo_change(map).error().code, ErrorCode::kConflict);
  EXPECT_EQ(members(map, 0), "01234");
  EXPECT_FALSE(map.edits[0].undone);
  EXPECT_EQ(map.revision, 4);
}

TEST(Edits, WhatWasUndoneWhileAMapWasBuiltIsNotBroughtBackByIt) {
  auto present = three_places();
  close_both_ways(present);
  ASSERT_TRUE(apply_edit(present, make(EditKind::kRename, 5, -1, "attic")));
  auto built = present;
  ASSERT_TRUE(undo_change(present));
  ASSERT_TRUE(undo_change(present));
  replay_edits(built, present.edits);
  EXPECT_EQ(closed(built), std::pair(false, false));
  EXPECT_EQ(map::find_place_of(built, ImageId("t/5"))->label, "");
  ASSERT_TRUE(redo_change(present));
  replay_edits(built, present.edits);
  EXPECT_EQ(closed(built), std::pair(true, true));
}

TEST(Edits, WhatNobodyAskedAboutCanBeDecidedToo) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kDecide, 1, 5, "reject")));
  ASSERT_EQ(map.hypotheses.size(), 1U);
  EXPECT_EQ(map.hypotheses[0].decision, map::Decision::kRejected);
  EXPECT_EQ(map.hypotheses[0].by, map::Decider::kPerson);
  EXPECT_EQ(map.places.size(), 3U);
  ASSERT_TRUE(apply_edit(map, make(EditKind::kDecide, 5, 1, "accept"), look));
  ASSERT_EQ(map.hypotheses.size(), 1U) << "the same two pictures";
  EXPECT_EQ(map.hypotheses[0].decision, map::Decision::kAccepted);
  EXPECT_EQ(map.places.size(), 2U);
  ASSERT_TRUE(undo_change(map));
  ASSERT_TRUE(undo_change(map));
  EXPECT_TRUE(map.hypotheses.empty());
}

TEST(Edits, AMapIsShownAsItWasAfterAnyChangeThatStands) {
  auto map = three_places();
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "kitchen")));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kRename, 0, -1, "pantry")));
  ASSERT_TRUE(apply_edit(map, make(EditKind::kDelete, 5)));
  ASSERT_TRUE(undo_change(map));
  const auto label_after = [&](std::int64_t change) {
    const auto former = as_of_change(map, change);
    return former ? former->places[0].label : former.error().message;
  };
  EXPECT_EQ(label_after(0), "");
  EXPECT_EQ(label_after(1), "kitchen");
  EXPECT_EQ(label_after(2), "pantry");
  EXPECT_EQ(as_of_change(map, 3).error().code, ErrorCode::kNotFound) << "it was taken back";
  EXPECT_EQ(as_of_change(map, 4).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(as_of_change(map, 0)->revision, map.revision);
  map.unedited = nullptr;  // as in files of before
  EXPECT_EQ(label_after(2), "pantry");
  EXPECT_EQ(as_of_change(map, 1).error().code, ErrorCode::kConflict);
}

TEST(Edits, WhatCannotBeIsRefusedAndChangesNothing) {
  const auto refused = [](const map::Edit& edit, ErrorCode code) {
    auto map = three_places();
    const Status status = apply_edit(map, edit);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, code) << status.error().message;
    EXPECT_EQ(map.revision, 1);
    EXPECT_TRUE(map.edits.empty());
    EXPECT_EQ(map.places.size(), 3U);
    EXPECT_EQ(members(map, 0), "012");
    EXPECT_EQ(members(map, 3), "34");
    EXPECT_EQ(map.next_place_number, 4);
  };
  refused(make(EditKind::kRename, 77, -1, "x"), ErrorCode::kNotFound);
  refused(make(EditKind::kRename, 0, -1, std::string(201, 'x')), ErrorCode::kInvalidInput);
  refused(make(EditKind::kMerge, 0, 1), ErrorCode::kInvalidInput);
  refused(make(EditKind::kMerge, 0, 77), ErrorCode::kNotFound);
  refused(make(EditKind::kSplit, 0, -1, {}, {}), ErrorCode::kInvalidInput);
  refused(make(EditKind::kSplit, 0, -1, {}, {0, 1, 2}), ErrorCode::kInvalidInput);  // nothing would be left
  refused(make(EditKind::kSplit, 0, -1, {}, {0, 4}), ErrorCode::kNotFound);         // 4 is elsewhere
  refused(make(EditKind::kSplit, 0, -1, {}, {4}), ErrorCode::kNotFound);
  refused(make(EditKind::kMove, 0, -1, {}, {4, 5}), ErrorCode::kInvalidInput);  // p3 would be empty; 4 stays too
  refused(make(EditKind::kMove, 0, -1, {}, {2}), ErrorCode::kInvalidInput);     // it is there
  refused(make(EditKind::kAddEdge, 0, 3), ErrorCode::kInvalidInput);            // there is one
  refused(make(EditKind::kAddDestination, 4, -1, "shelf"), ErrorCode::kConflict);
  refused(make(EditKind::kAddDestination, 0, -1, ""), ErrorCode::kInvalidInput);
  refused(make(EditKind::kRemoveDestination, 0), ErrorCode::kNotFound);
  refused(make(EditKind::kNameDestination, 0, -1, "x"), ErrorCode::kNotFound);
  refused(make(EditKind::kSetPictogram, 4, -1, "dragon"), ErrorCode::kInvalidInput);
  refused(make(EditKind::kSetDestinationPicture, 4, 77), ErrorCode::kNotFound);
  refused(make(EditKind::kMove, 0, -1, {}, {}), ErrorCode::kInvalidInput);
  refused(make(EditKind::kDelete, 77), ErrorCode::kNotFound);
  refused(make(EditKind::kAddEdge, 0, 1), ErrorCode::kInvalidInput);
  refused(make(EditKind::kRemoveEdge, 0, 5), ErrorCode::kNotFound);
  refused(make(EditKind::kBlockEdge, 0, 5, "true"), ErrorCode::kNotFound);
  refused(make(EditKind::kBlockEdge, 0, 3, "perhaps"), ErrorCode::kInvalidInput);
  refused(make(EditKind::kDecide, 0, 0, "accept"), ErrorCode::kInvalidInput);
  refused(make(EditKind::kDecide, 0, 77, "accept"), ErrorCode::kNotFound);
  refused(make(EditKind::kSetAside, 0, 3, "weather"), ErrorCode::kInvalidInput);
  refused(make(EditKind::kSetAside, 0, 77, "way"), ErrorCode::kNotFound);
  refused(make(EditKind::kDecide, 0, 3, "maybe"), ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::mapping::edit_log_test
