// SPDX-License-Identifier: Apache-2.0
// Whatever people do to a map, one edit after the other: it stays a map, and everything can be taken back.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/map_builder.hpp"
#include "support/corridor_tour.hpp"
#include "support/same_state.hpp"

namespace homeward::mapping::edit_sequences_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::same_state;
using homeward::testing::walk;
using map::EditKind;
using map::TopologicalMap;

constexpr int kSequences = 1000;
constexpr int kRebuilds = 200;

/// A corridor there and back, with marks, a wish for a shortcut and a hypothesis that nobody has decided.
struct Taught {
  CorridorTour tour = corridor_tour(walk(24, true), {48});
  TopologicalMap map;

  Taught() {
    tour.marks = {{2, "hall"}, {11, "kitchen"}, {23, "study"}};
    map = make_map(tour.input(), {}, nullptr);
    map::Shortcut shortcut;
    shortcut.image_a = map.places.front().prototype;
    shortcut.image_b = map.places.back().prototype;
    shortcut.length_m = 2.5;
    map.shortcuts.push_back(shortcut);
    map::Hypothesis open;
    open.prototype_a = map.places[1].prototype;
    open.prototype_b = map.places.back().prototype;
    map.hypotheses.push_back(open);
  }
  [[nodiscard]] LookAt look() const {
    return [this](const ImageId& image) -> Result<features::Appearance> {
      const auto found = std::ranges::find(tour.images, image, &map::MapImage::id);
      if (found == tour.images.end()) return fail(ErrorCode::kNotFound, "not of the tour", image.str());
      return tour.appearances[static_cast<std::size_t>(found - tour.images.begin())];
    };
  }
};

class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed) {}

  int below(std::size_t count) { return std::uniform_int_distribution<int>(0, static_cast<int>(count) - 1)(random_); }
  template <typename List>
  const auto& one_of(const List& list) {
    return list[static_cast<std::size_t>(below(list.size()))];
  }

  /// Any kind, of things that are there most of the time.
  map::Edit next(const TopologicalMap& map, bool with_decisions) {
    map::Edit edit;
    do edit.kind = static_cast<EditKind>(below(map::kEditKinds));
    while (!with_decisions && edit.kind == EditKind::kDecide);
    edit.by = "anna";
    edit.image_a = one_of(map.images).id;
    edit.image_b = one_of(map.images).id;
    edit.text = one_of(std::vector<std::string>{"hall", "", "bed", "door"});
    if (edit.kind == EditKind::kBlockEdge && !map.edges.empty()) {
      const map::Edge& edge = one_of(map.edges);
      edit.image_a = map::find_place(map, edge.from)->prototype;
      edit.image_b = map::find_place(map, edge.to)->prototype;
      edit.text = below(2) == 0 ? "true" : "false";
    }
    if (edit.kind == EditKind::kDecide) {
      const map::Hypothesis& hypothesis = one_of(map.hypotheses);
      if (below(2) == 0) {  // else of two pictures about which nobody asked
        edit.image_a = hypothesis.prototype_a;
        edit.image_b = hypothesis.prototype_b;
      }
      edit.text = below(2) == 0 ? "accept" : "reject";
    }
    if (edit.kind == EditKind::kDecideShortcut && !map.shortcuts.empty()) {
      edit.image_a = map.shortcuts.front().image_a;
      edit.image_b = map.shortcuts.front().image_b;
      edit.text = below(2) == 0 ? "accept" : "reject";
    }
    if (edit.kind == EditKind::kSetAside) edit.text = "same_place";
    const bool of_destination = edit.kind >= EditKind::kRemoveDestination && edit.kind != EditKind::kSetAside;
    if (of_destination && !map.destinations.empty()) edit.image_a = one_of(map.destinations).image;
    if (edit.kind == EditKind::kSplit || edit.kind == EditKind::kMove) {
      const map::Place& from = one_of(map.places);
      if (edit.kind == EditKind::kSplit) edit.image_a = from.prototype;
      for (const ImageId& member : from.members) {
        if (below(2) == 0) edit.images.push_back(member);
      }
    }
    return edit;
  }

 private:
  std::mt19937 random_;
};

/// What holds of every map.
void expect_whole(const TopologicalMap& map, const TopologicalMap& first) {
  std::set<ImageId> images;
  for (const map::MapImage& image : map.images) images.insert(image.id);
  std::set<PlaceId> places;
  std::set<ImageId> held;
  for (const map::Place& place : map.places) {
    EXPECT_TRUE(places.insert(place.id).second) << place.id.str() << " twice";
    EXPECT_NE(std::ranges::find(place.members, place.prototype), place.members.end()) << "prototype among members";
    EXPECT_FALSE(place.appearances.empty());
    EXPECT_EQ(place.appearances.entries().front().image, place.prototype);
    for (const ImageId& member : place.members) {
      EXPECT_TRUE(images.contains(member));
      EXPECT_TRUE(held.insert(member).second) << member.str() << " in two places";
    }
    const std::int64_t number = std::stoll(place.id.str().substr(1));
    EXPECT_LT(number, map.next_place_number);
    const bool is_old = map::find_place(first, place.id) != nullptr;
    EXPECT_TRUE(is_old || number >= first.next_place_number) << "an id was used again";
  }
  std::set<std::pair<PlaceId, PlaceId>> ways;
  for (const map::Edge& edge : map.edges) {
    EXPECT_TRUE(places.contains(edge.from) && places.contains(edge.to));
    EXPECT_NE(edge.from, edge.to);
    EXPECT_TRUE(ways.emplace(edge.from, edge.to).second) << "one edge for each direction";
    EXPECT_TRUE(edge.weak || edge.bearing_rad) << "a sound edge has a bearing";
  }
  std::set<ImageId> docks;
  std::set<DestinationId> ids;
  for (const map::Destination& destination : map.destinations) {
    EXPECT_TRUE(ids.insert(destination.id).second);
    EXPECT_TRUE(docks.insert(destination.image).second) << "two destinations at one picture";
    const map::Place* place = map::find_place_of(map, destination.image);
    ASSERT_NE(place, nullptr);
    EXPECT_EQ(place->id, destination.place) << "a destination is where its picture is";
    EXPECT_FALSE(destination.label.empty());
  }
}

/// A random sequence of edits; what is refused changes nothing.
TopologicalMap edited(const Taught& taught, RandomEdits& random, bool with_decisions) {
  TopologicalMap map = taught.map;
  const int count = 1 + random.below(14);
  for (int i = 0; i < count; ++i) {
    map::Edit edit = random.next(map, with_decisions);
    if (random.below(3) == 0 && !map.edits.empty()) edit.change = map.edits.back().change;  // one request of several
    const TopologicalMap before = map;
    const Status status = apply_edit(map, edit, taught.look());
    if (!status) {
      EXPECT_TRUE(same_state(map, before)) << status.error().message;
      EXPECT_EQ(map.edits.size(), before.edits.size());
      EXPECT_EQ(map.revision, before.revision);
    } else {
      EXPECT_EQ(map.revision, before.revision + 1);
    }
    expect_whole(map, taught.map);
    if (random.below(6) == 0 && undo_change(map) && random.below(2) == 0) {
      EXPECT_TRUE(redo_change(map));
    }
  }
  return map;
}

TEST(EditSequences, AMapStaysWholeAndUndoAndRedoAreExact) {
  const Taught taught;
  for (int seed = 0; seed < kSequences; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEdits random(static_cast<unsigned>(seed));
    TopologicalMap map = edited(taught, random, true);
    while (redo_change(map)) {
    }
    const TopologicalMap end = map;
    std::vector<TopologicalMap> back{map};
    while (undo_change(map)) {
      expect_whole(map, taught.map);
      const auto latest = std::ranges::find(map.edits.rbegin(), map.edits.rend(), false, &map::Edit::undone);
      const auto former = as_of_change(end, latest == map.edits.rend() ? 0 : latest->change);
      ASSERT_TRUE(former && same_state(*former, map));
      back.push_back(map);
    }
    ASSERT_TRUE(same_state(map, taught.map));
    for (auto before = back.rbegin() + 1; before != back.rend(); ++before) {
      ASSERT_TRUE(redo_change(map));
      ASSERT_TRUE(same_state(map, *before));
    }
    ASSERT_TRUE(same_state(map, end));
    ASSERT_EQ(redo_change(map).error().code, ErrorCode::kNotFound);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(EditSequences, ARebuildOfTheSameToursIsTheSameMapWithEveryEdit) {
  const Taught taught;
  for (int seed = 0; seed < kRebuilds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEdits random(static_cast<unsigned>(10'000 + seed));
    TopologicalMap map = edited(taught, random, false);
    // What a builder cannot know of is no part of this.
    const auto of_shortcuts = [](const map::Edit& edit) { return edit.kind == EditKind::kDecideShortcut; };
    if (std::ranges::any_of(map.edits, of_shortcuts)) continue;
    map.shortcuts.clear();
    TopologicalMap rebuilt = make_map(taught.tour.input(), {}, &map);
    for (const map::Edit& edit : rebuilt.edits) EXPECT_EQ(edit.lost, "");
    map.hypotheses.pop_back();  // the one that no builder made
    ASSERT_TRUE(same_state(rebuilt, map));
    while (undo_change(rebuilt)) {
    }
    TopologicalMap first = taught.map;
    first.hypotheses.pop_back();
    first.shortcuts.clear();
    ASSERT_TRUE(same_state(rebuilt, first));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(EditSequences, ARebuildOfOtherToursKeepsEachEditOrSaysWhyNot) {
  const Taught taught;
  const CorridorTour shorter = corridor_tour(walk(15, false), {15});  // the same names, another way
  int kept = 0;
  int lost = 0;
  for (int seed = 0; seed < kRebuilds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEdits random(static_cast<unsigned>(20'000 + seed));
    const TopologicalMap map = edited(taught, random, seed % 2 == 0);
    TopologicalMap rebuilt = make_map(shorter.input(), {}, &map);
    ASSERT_EQ(rebuilt.edits.size(), map.edits.size());
    for (const map::Edit& edit : rebuilt.edits) {
      if (edit.undone) continue;
      ++(edit.lost.empty() ? kept : lost);
    }
    std::set<PlaceId> ids;
    for (const map::Place& place : rebuilt.places) EXPECT_TRUE(ids.insert(place.id).second);
    // And back again: what could not be kept was not forgotten. Decisions on loops make a builder decide others anew.
    if (seed % 2 == 0) continue;
    const TopologicalMap again = make_map(taught.tour.input(), {}, &rebuilt);
    for (std::size_t i = 0; i < again.edits.size(); ++i) {
      if (map.edits[i].kind == EditKind::kDecideShortcut) continue;  // its proposal is gone
      if (map.edits[i].undone) continue;
      EXPECT_EQ(again.edits[i].lost, "") << i;
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(lost, 100);
}

}  // namespace
}  // namespace homeward::mapping::edit_sequences_test
