// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_drafts_test {
namespace {

class StoreDrafts : public StoreTest {
 protected:
  MapId new_map() {
    MapRecord map;
    map.name = "house";
    return store().add_map(map)->id;
  }
  DraftRecord begin(const MapId& map, TimeUs created_us = 5) {
    DraftRecord draft;
    draft.map = map;
    draft.name = "loop by the study";
    draft.author = "anna";
    draft.created_us = created_us;
    return store().add_draft(draft).value();
  }
  static map::Edit merge() {
    map::Edit edit;
    edit.kind = map::EditKind::kMerge;
    edit.image_a = ImageId("t/1.jpg");
    edit.image_b = ImageId("t/9.jpg");
    edit.by = "anna";
    edit.t_us = 12;
    edit.change = 1;
    return edit;
  }
};

TEST_F(StoreDrafts, OutliveTheProgram) {
  const MapId map = new_map();
  const DraftRecord begun = begin(map);
  map::Edit split = merge();
  split.kind = map::EditKind::kSplit;
  split.images = {ImageId("t/1.jpg"), ImageId("t/2.jpg")};
  split.undone = true;
  split.redoable = true;
  split.change = 2;
  split.lost = "no such picture";
  ASSERT_TRUE(store().save_draft_edits(begun.id, {merge(), split}, 1));
  open();
  const auto drafts = store().drafts(map).value();
  ASSERT_EQ(drafts.size(), 1U);
  EXPECT_EQ(drafts[0].id, begun.id);
  EXPECT_EQ(drafts[0].name, "loop by the study");
  EXPECT_EQ(drafts[0].author, "anna");
  EXPECT_EQ(drafts[0].created_us, 5);
  EXPECT_EQ(drafts[0].version, 2);
  EXPECT_EQ(drafts[0].edits, (std::vector<map::Edit>{merge(), split}));
  EXPECT_FALSE(drafts[0].check);
}

TEST_F(StoreDrafts, AreSavedOnlyOverTheVersionThatWasSeen) {
  const DraftRecord begun = begin(new_map());
  ASSERT_TRUE(store().save_draft_edits(begun.id, {merge()}, 1));
  EXPECT_EQ(store().save_draft_edits(begun.id, {}, 1).error().code, ErrorCode::kStaleRevision);
  EXPECT_EQ(store().draft(begun.map, begun.id)->edits.size(), 1U);
}

TEST_F(StoreDrafts, BelongToOneMapAndGoWithIt) {
  const MapId map = new_map();
  const MapId other = new_map();
  const DraftRecord begun = begin(map);
  EXPECT_EQ(store().draft(other, begun.id).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(store().drafts(other)->empty());
  ASSERT_TRUE(store().remove_map(map));
  EXPECT_EQ(store().draft(map, begun.id).error().code, ErrorCode::kNotFound);
  DraftRecord nowhere;
  nowhere.map = map;
  EXPECT_EQ(store().add_draft(nowhere).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreDrafts, AreListedAsTheyWereBegun) {
  const MapId map = new_map();
  const DraftRecord second = begin(map, 9);
  const DraftRecord first = begin(map, 3);
  const auto drafts = store().drafts(map).value();
  ASSERT_EQ(drafts.size(), 2U);
  EXPECT_EQ(drafts[0].id, first.id);
  EXPECT_EQ(drafts[1].id, second.id);
}

TEST_F(StoreDrafts, KeepWhatTheLatestCheckFound) {
  const DraftRecord begun = begin(new_map());
  EXPECT_FALSE(store().draft_findings(begun.id)->has_value());
  ASSERT_TRUE(store().set_draft_check(begun.id, {JobId("j1"), 1}));
  EXPECT_FALSE(store().draft_findings(begun.id)->has_value());
  ASSERT_TRUE(store().keep_draft_findings(begun.id, JobId("j0"), "{}"));
  EXPECT_FALSE(store().draft_findings(begun.id)->has_value()) << "of a check that was replaced";
  ASSERT_TRUE(store().keep_draft_findings(begun.id, JobId("j1"), "{\"harmless\":true}"));
  open();
  EXPECT_EQ(store().draft_findings(begun.id).value(), "{\"harmless\":true}");
  EXPECT_EQ(store().draft(begun.map, begun.id)->check->job, JobId("j1"));
  ASSERT_TRUE(store().set_draft_check(begun.id, {JobId("j2"), 1}));
  EXPECT_TRUE(store().draft_findings(begun.id)->has_value()) << "until the next has ended";
  ASSERT_TRUE(store().keep_draft_findings(begun.id, JobId("j2"), "{}"));
  EXPECT_EQ(store().draft_findings(begun.id).value(), "{}");
}

TEST_F(StoreDrafts, AreGoneWithTheRevisionThatTheyBecome) {
  const MapId map = new_map();
  const DraftRecord begun = begin(map);
  map::TopologicalMap contents = homeward::testing::sample_map();
  contents.revision = 1;
  AlongWithContents along;
  along.draft = begun.id;
  ASSERT_TRUE(store().save_map_contents(map, contents, {}, 0, along));
  EXPECT_EQ(store().draft(map, begun.id).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreDrafts, AreRemovedOnce) {
  const DraftRecord begun = begin(new_map());
  ASSERT_TRUE(store().remove_draft(begun.id));
  EXPECT_EQ(store().remove_draft(begun.id).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().save_draft_edits(begun.id, {}, 1).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().set_draft_check(begun.id, {JobId("j1"), 1}).error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace homeward::db::store_drafts_test
