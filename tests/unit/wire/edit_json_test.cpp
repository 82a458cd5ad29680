// SPDX-License-Identifier: Apache-2.0
#include "wire/edit_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/sample_map.hpp"

namespace homeward::wire::edit_json_test {
namespace {

using homeward::testing::sample_map;
using nlohmann::json;

Result<map::Edit> edit_from(const char* text) {
  const auto edits = edits_from_json(json::parse(std::string(R"({"edits":[)") + text + "]}"));
  if (!edits) return pass_on(edits);
  return edit_for_map(edits->front(), sample_map(), "anna", 12);
}

TEST(EditJson, KeysAPlaceToItsPrototype) {
  const auto edit = edit_from(R"({"kind":"rename","place":"p2","label":"pantry"})");
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->kind, map::EditKind::kRename);
  EXPECT_EQ(edit->image_a.str(), "tour/00002.jpg");
  EXPECT_TRUE(edit->image_b.empty());
  EXPECT_EQ(edit->text, "pantry");
  EXPECT_EQ(edit->by, "anna");
  EXPECT_EQ(edit->t_us, 12);
}

TEST(EditJson, KeysAnEdgeToBothEnds) {
  const auto edit = edit_from(R"({"kind":"block_edge","from":"p2","to":"p1","blocked":false})");
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->image_a.str(), "tour/00002.jpg");
  EXPECT_EQ(edit->image_b.str(), "tour/00000.jpg");
  EXPECT_EQ(edit->text, "false");
}

TEST(EditJson, NamesFirstThePlaceThatStays) {
  const auto merge = edit_from(R"({"kind":"merge","place":"p2","into":"p1"})");
  ASSERT_TRUE(merge);
  EXPECT_EQ(merge->image_a.str(), "tour/00000.jpg");
  EXPECT_EQ(merge->image_b.str(), "tour/00002.jpg");
  const auto move = edit_from(R"({"kind":"move","images":["tour/00001.jpg"],"into":"p2"})");
  ASSERT_TRUE(move);
  EXPECT_EQ(move->image_a.str(), "tour/00002.jpg");
  EXPECT_EQ(move->images.front().str(), "tour/00001.jpg");
}

TEST(EditJson, DecidesAHypothesisByItsPrototypes) {
  const auto edit =
      edit_from(R"({"kind":"decide","prototype_a":"tour/00000.jpg","prototype_b":"tour/00002.jpg","accept":true})");
  ASSERT_TRUE(edit);
  EXPECT_EQ(edit->text, "accept");
  EXPECT_EQ(edit->image_b.str(), "tour/00002.jpg");
}

TEST(EditJson, DecidesAShortcutByItsPictures) {
  const auto edit =
      edit_from(R"({"kind":"decide_shortcut","image_a":"tour/00000.jpg","image_b":"tour/00002.jpg","accept":false})");
  ASSERT_TRUE(edit);
  EXPECT_EQ(edit->kind, map::EditKind::kDecideShortcut);
  EXPECT_EQ(edit->text, "reject");
  EXPECT_EQ(edit->image_a.str(), "tour/00000.jpg");
  EXPECT_EQ(edit->image_b.str(), "tour/00002.jpg");
}

TEST(EditJson, RefusesPlacesThatAreNotInTheMap) {
  const auto edit = edit_from(R"({"kind":"block_edge","from":"p1","to":"p9","blocked":true})");
  ASSERT_FALSE(edit);
  EXPECT_EQ(edit.error().code, ErrorCode::kUnknownPlace);
  EXPECT_EQ(edit.error().where, "p9");
}

TEST(EditJson, NamesTheFieldThatIsWrong) {
  const auto where = [](const char* text) { return edits_from_json(json::parse(text)).error().where; };
  EXPECT_EQ(where(R"({"edits":[{"kind":"rename","place":"p1"}]})"), "body/edits/0/label");
  EXPECT_EQ(where(R"({"edits":[{"kind":"delete","place":"p1"},{"kind":"paint"}]})"), "body/edits/1/kind");
  EXPECT_EQ(where(R"({"edits":[{"kind":"delete","place":"p1","label":"x"}]})"), "body/edits/0/label");
  EXPECT_EQ(where(R"({"edits":[{"kind":"split","place":"p1","images":[3]}]})"), "body/edits/0/images");
  EXPECT_EQ(where(R"({"edits":[{"kind":"add_destination","image":"t/1","label":""}]})"), "body/edits/0/label");
  EXPECT_EQ(where(R"({"edits":[{"kind":"set_pictogram","destination":"d1","pictogram":"x"}]})"),
            "body/edits/0/pictogram");
  EXPECT_EQ(where(R"({"edits":[]})"), "body/edits");
  EXPECT_EQ(where("[]"), "body");
}

TEST(EditJson, LogsEditsWithNullForNoSecondImage) {
  const json logged = logged_edit_to_json(sample_map().edits.front());
  EXPECT_EQ(logged, json::parse(R"({"kind":"rename","image_a":"tour/00002.jpg","image_b":null,"text":"kitchen",
    "images":["tour/00002.jpg"],"by":"anna","t_us":1700000000000000,"undone":false,
    "change":1,"redoable":false,"lost":null})"));
}

}  // namespace
}  // namespace homeward::wire::edit_json_test
