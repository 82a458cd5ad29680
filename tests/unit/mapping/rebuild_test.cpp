// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/map_builder.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::rebuild_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::walk;

/// A tour of one way, its map, and a longer tour of the same images that makes another map.
class Rebuild : public ::testing::Test {
 protected:
  void SetUp() override { map_ = make_map(tour_.input(), {}, nullptr); }

  void edit(map::EditKind kind, int a, int b, const std::string& text = {}, std::vector<ImageId> images = {}) {
    map::Edit edit;
    edit.kind = kind;
    edit.image_a = image(a);
    if (b >= 0) edit.image_b = image(b);
    edit.text = text;
    edit.images = std::move(images);
    edit.by = "anna";
    const Status applied = apply_edit(map_, edit);
    ASSERT_TRUE(applied) << applied.error().message;
  }
  [[nodiscard]] LookAt look() const {
    return [this](const ImageId& wanted) -> Result<features::Appearance> {
      const auto found = std::ranges::find(tour_.images, wanted, &map::MapImage::id);
      return tour_.appearances[static_cast<std::size_t>(found - tour_.images.begin())];
    };
  }
  [[nodiscard]] ImageId image(int index) const { return tour_.images[static_cast<std::size_t>(index)].id; }
  static PlaceId id_of(map::TopologicalMap& map, const ImageId& image) { return map::find_place_of(map, image)->id; }

  /// The ends of the corridor, in different places whatever happens in between.
  static constexpr int kFirst = 0;
  static constexpr int kLast = 29;
  CorridorTour tour_ = corridor_tour(walk(30, false), {30});
  map::TopologicalMap map_;
};

TEST_F(Rebuild, WithoutChangeKeepsEveryId) {
  const map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  ASSERT_EQ(again.places.size(), map_.places.size());
  for (std::size_t i = 0; i < again.places.size(); ++i) EXPECT_EQ(again.places[i].id, map_.places[i].id);
  EXPECT_EQ(again.revision, map_.revision + 1);
  EXPECT_EQ(again.next_place_number, map_.next_place_number);
}

TEST_F(Rebuild, DecisionsOnShortcutsOutliveItAndProposalsDoNot) {
  const auto prototype = [&](std::size_t place) { return map_.places[place].prototype; };
  const std::size_t last = map_.places.size() - 1;
  ASSERT_GE(last, 4U);
  const auto propose = [&](std::size_t a, std::size_t b) {
    map::Shortcut shortcut;
    shortcut.image_a = prototype(a);
    shortcut.image_b = prototype(b);
    shortcut.length_m = 2.5;
    map_.shortcuts.push_back(shortcut);
  };
  propose(0, last);
  propose(0, 2);
  propose(1, last);
  const auto decide = [&](std::size_t a, std::size_t b, const char* text) {
    map::Edit edit;
    edit.kind = map::EditKind::kDecideShortcut;
    edit.image_a = prototype(a);
    edit.image_b = prototype(b);
    edit.text = text;
    edit.by = "anna";
    ASSERT_TRUE(apply_edit(map_, edit));
  };
  decide(0, last, "accept");
  decide(0, 2, "reject");
  const map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  ASSERT_EQ(again.shortcuts.size(), 2U);
  EXPECT_EQ(again.shortcuts[0].state, map::ShortcutState::kAccepted);
  EXPECT_EQ(again.shortcuts[0].by, "anna");
  EXPECT_EQ(again.shortcuts[1].state, map::ShortcutState::kRejected);
  const map::Edge* edge = map::find_edge(again, map_.places[0].id, map_.places[last].id);
  ASSERT_NE(edge, nullptr);
  EXPECT_TRUE(edge->shortcut);
  EXPECT_EQ(edge->length_m, 2.5);
  EXPECT_EQ(map::find_edge(again, map_.places[0].id, map_.places[2].id), nullptr);
}

TEST_F(Rebuild, LabelsBlocksAndEdgesOutliveIt) {
  edit(map::EditKind::kRename, kFirst, -1, "kitchen");
  edit(map::EditKind::kAddEdge, kFirst, kLast);
  const map::Edge edge = map_.edges.front();
  const ImageId from = map::find_place(map_, edge.from)->prototype;
  const ImageId to = map::find_place(map_, edge.to)->prototype;
  map::Edit block;
  block.kind = map::EditKind::kBlockEdge;
  block.image_a = from;
  block.image_b = to;
  block.text = "true";
  ASSERT_TRUE(apply_edit(map_, block));
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  EXPECT_EQ(map::find_place_of(again, image(kFirst))->label, "kitchen");
  ASSERT_NE(map::find_edge(again, id_of(again, image(kFirst)), id_of(again, image(kLast))), nullptr);
  EXPECT_TRUE(map::find_edge(again, id_of(again, from), id_of(again, to))->blocked);
  EXPECT_EQ(again.edits.size(), 3U);
  EXPECT_EQ(again.edits[0].by, "anna");
}

TEST_F(Rebuild, AMergeAndItsIdOutliveIt) {
  const PlaceId kept = id_of(map_, image(kFirst));
  edit(map::EditKind::kMerge, kFirst, kLast);
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  EXPECT_EQ(id_of(again, image(kFirst)), kept);
  EXPECT_EQ(id_of(again, image(kLast)), kept);
}

TEST_F(Rebuild, ASplitPlaceKeepsItsIdThroughManyRebuilds) {
  const map::Place& place = *std::ranges::find_if(map_.places, [](const auto& p) { return p.members.size() >= 3; });
  const ImageId stays = place.prototype;
  const ImageId leaves = place.members.front() == stays ? place.members.back() : place.members.front();
  map::Edit split;
  split.kind = map::EditKind::kSplit;
  split.image_a = stays;
  split.images = {leaves};
  ASSERT_TRUE(apply_edit(map_, split, look()));
  const PlaceId old_id = id_of(map_, stays);
  const PlaceId fresh_id = id_of(map_, leaves);
  ASSERT_NE(old_id, fresh_id);
  const auto next_number = map_.next_place_number;
  for (int round = 0; round < 3; ++round) {
    map_ = make_map(tour_.input(), {}, &map_);
    EXPECT_EQ(id_of(map_, stays), old_id);
    EXPECT_EQ(id_of(map_, leaves), fresh_id);
    EXPECT_EQ(map_.next_place_number, next_number);
  }
}

TEST_F(Rebuild, IdsOfDeletedPlacesAreNeverUsedAgain) {
  const PlaceId gone = id_of(map_, image(kLast));
  std::set<PlaceId> used;
  for (const map::Place& place : map_.places) used.insert(place.id);
  edit(map::EditKind::kDelete, kLast, -1);
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  for (const map::Place& place : again.places) EXPECT_NE(place.id, gone);
  EXPECT_EQ(map::find_place_of(again, image(kLast)), nullptr);
  // A longer tour makes new places: all have new numbers.
  const CorridorTour longer = corridor_tour(walk(60, false), {60});
  const map::TopologicalMap grown = make_map(longer.input(), {}, &again);
  int fresh = 0;
  for (const map::Place& place : grown.places) {
    EXPECT_NE(place.id, gone);
    fresh += used.contains(place.id) ? 0 : 1;
  }
  EXPECT_GT(fresh, 3);
  EXPECT_GE(grown.next_place_number, map_.next_place_number + fresh);
}

TEST_F(Rebuild, DecisionsOnHypothesesHold) {
  tour_ = corridor_tour(walk(30, true), {60});
  map_ = make_map(tour_.input(), {}, nullptr);
  const auto accepted = std::ranges::find(map_.hypotheses, map::Decision::kAccepted, &map::Hypothesis::decision);
  ASSERT_NE(accepted, map_.hypotheses.end());
  const ImageId a = accepted->prototype_a;
  const ImageId b = accepted->prototype_b;
  ASSERT_EQ(id_of(map_, a), id_of(map_, b));
  map::Edit reject;
  reject.kind = map::EditKind::kDecide;
  reject.image_a = a;
  reject.image_b = b;
  reject.text = "reject";
  ASSERT_TRUE(apply_edit(map_, reject, look()));
  EXPECT_NE(id_of(map_, a), id_of(map_, b));
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  EXPECT_NE(id_of(again, a), id_of(again, b));
  const auto kept =
      std::ranges::find_if(again.hypotheses, [&](const auto& h) { return h.prototype_a == a && h.prototype_b == b; });
  ASSERT_NE(kept, again.hypotheses.end());
  EXPECT_EQ(kept->by, map::Decider::kPerson);
  EXPECT_EQ(kept->decision, map::Decision::kRejected);
}

TEST_F(Rebuild, ADecisionOnOtherPicturesOfTwoPassesIsThatOfTheirHypothesis) {
  tour_ = corridor_tour(walk(30, true), {60});
  map_ = make_map(tour_.input(), {}, nullptr);
  const std::size_t hypotheses = map_.hypotheses.size();
  const auto accepted = std::ranges::find(map_.hypotheses, map::Decision::kAccepted, &map::Hypothesis::decision);
  ASSERT_NE(accepted, map_.hypotheses.end());
  const auto index = map::image_indices(map_);
  // The next picture of the same pass through the place, or the one before.
  const auto beside = [&](const ImageId& one) {
    for (const int step : {1, -1}) {
      const int other = index.at(one) + step;
      if (other < 0 || other >= static_cast<int>(map_.images.size())) continue;
      const ImageId& id = map_.images[static_cast<std::size_t>(other)].id;
      if (map::find_place_of(map_, id) == map::find_place_of(map_, one)) return id;
    }
    return ImageId();
  };
  map::Edit reject;
  reject.kind = map::EditKind::kDecide;
  reject.image_a = beside(accepted->prototype_a);
  reject.image_b = accepted->prototype_b;
  reject.text = "reject";
  ASSERT_FALSE(reject.image_a.empty());
  ASSERT_TRUE(apply_edit(map_, reject, look()));
  EXPECT_EQ(map_.hypotheses.size(), hypotheses + 1) << "nobody had asked about these two";
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  EXPECT_NE(id_of(again, reject.image_a), id_of(again, reject.image_b));
  EXPECT_EQ(again.hypotheses.size(), hypotheses) << "the build has asked, and knows the answer";
  EXPECT_EQ(again.edits.back().lost, "");
}

TEST_F(Rebuild, EditsOfImagesThatAreGoneStayInTheLog) {
  edit(map::EditKind::kRename, kLast, -1, "shed");
  const CorridorTour shorter = corridor_tour(walk(12, false), {12});
  const map::TopologicalMap again = make_map(shorter.input(), {}, &map_);
  EXPECT_EQ(again.edits.size(), 1U);
  for (const map::Place& place : again.places) EXPECT_NE(place.label, "shed");
  map::TopologicalMap back = make_map(tour_.input(), {}, &again);
  EXPECT_EQ(map::find_place_of(back, image(kLast))->label, "shed");
}

TEST_F(Rebuild, AnUndoneEditIsNotReplayed) {
  edit(map::EditKind::kRename, kFirst, -1, "kitchen");
  ASSERT_TRUE(undo_change(map_));
  map::TopologicalMap again = make_map(tour_.input(), {}, &map_);
  EXPECT_EQ(map::find_place_of(again, image(kFirst))->label, "");
  EXPECT_EQ(again.edits.size(), 1U);
}

}  // namespace
}  // namespace homeward::mapping::rebuild_test
