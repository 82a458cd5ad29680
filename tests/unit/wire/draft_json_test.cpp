// SPDX-License-Identifier: Apache-2.0
#include "wire/draft_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "wire/edit_json.hpp"
#include "wire/entity_tag.hpp"

namespace homeward::wire::draft_json_test {
namespace {

using nlohmann::json;

TEST(DraftJson, CountsTheChangesThatStand) {
  DraftView draft;
  for (const std::int64_t change : {1, 1, 2, 3}) {
    map::Edit edit;
    edit.change = change;
    edit.undone = change == 3;
    draft.edits.push_back(edit);
  }
  EXPECT_EQ(draft_to_json(draft).at("changes"), 2);
}

TEST(EntityTag, IsReadAsItIsWrittenAndOfItsKindAlone) {
  EXPECT_EQ(draft_tag(4), "\"d4\"");
  EXPECT_EQ(draft_version_from_tag("\"d4\"").value(), 4);
  EXPECT_EQ(draft_version_from_tag("W/\"d4\"").value(), 4);
  EXPECT_EQ(draft_version_from_tag("d4").value(), 4);
  for (const char* wrong : {"", "\"\"", "\"r4\"", "\"d\"", "\"d-1\"", "\"d4x\"", "\"d99999999999999999999\"", "4"}) {
    EXPECT_FALSE(draft_version_from_tag(wrong)) << wrong;
  }
}

TEST(LoggedEditJson, IsReadAsItIsWritten) {
  map::Edit edit;
  edit.kind = map::EditKind::kSplit;
  edit.image_a = ImageId("t/1.jpg");
  edit.images = {ImageId("t/1.jpg"), ImageId("t/2.jpg")};
  edit.text = "x";
  edit.by = "anna";
  edit.t_us = 77;
  edit.change = 3;
  edit.undone = true;
  edit.redoable = true;
  edit.lost = "gone";
  EXPECT_EQ(logged_edit_from_json(logged_edit_to_json(edit), "edit").value(), edit);
  edit.lost = "";
  edit.image_b = ImageId("t/9.jpg");
  EXPECT_EQ(logged_edit_from_json(logged_edit_to_json(edit), "edit").value(), edit);
}

TEST(LoggedEditJson, NamesWhatIsWrong) {
  const json good = logged_edit_to_json([] {
    map::Edit edit;
    edit.change = 1;
    return edit;
  }());
  ASSERT_TRUE(logged_edit_from_json(good, "edit"));
  const auto where = [&](const char* key, const json& value) {
    json bad = good;
    bad[key] = value;
    const auto read = logged_edit_from_json(bad, "edit");
    return read ? std::string("accepted") : read.error().where;
  };
  EXPECT_EQ(where("change", 0), "edit/change");
  EXPECT_EQ(where("kind", "paint"), "edit/kind");
  EXPECT_EQ(where("images", json::array({1})), "edit/images");
  EXPECT_EQ(where("more", 1), "edit/more");
}

}  // namespace
}  // namespace homeward::wire::draft_json_test
