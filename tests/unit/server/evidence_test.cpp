// SPDX-License-Identifier: Apache-2.0
#include "support/server_fixture.hpp"

namespace homeward::server::evidence_test {
namespace {

using nlohmann::json;
using testing::Answer;

class EvidenceTest : public testing::ServerTest {
 protected:
  void teach(int rooms) {
    map_ = built_map(rooms);
    root_ = "/api/v1/maps/" + map_;
  }
  json graph() { return admin->get(root_ + "/graph").json(); }

  std::string map_;
  std::string root_;
};

TEST_F(EvidenceTest, TwoPicturesOfTheMapAreComparedAsPeopleSeeThem) {
  teach(3);
  const json members = graph().at("places").at(0).at("members");
  ASSERT_GE(members.size(), 2U);
  const std::string a = members.at(0);
  const std::string b = members.at(1);
  const Answer pair = admin->get(root_ + "/pair?image_a=" + a + "&image_b=" + b);
  ASSERT_EQ(pair.status, 200) << pair.body;
  EXPECT_EQ(pair.json().at("image_b"), b);
  EXPECT_FALSE(pair.json().at("turn_rad").is_null());
  EXPECT_GT(pair.json().at("matches").size(), 8U);
  EXPECT_EQ(admin->get(root_ + "/pair?image_a=" + a).status, 422);
  EXPECT_EQ(admin->get(root_ + "/pair?image_a=" + a + "&image_b=t/none.jpg").status, 404);
}

TEST_F(EvidenceTest, WhatToLookAtComesInPagesAndAnAnswerIsAnEdit) {
  teach(5);
  const auto change = [&](const std::string& what, const json& body) {
    const std::string tag = admin->get(root_ + "/graph").headers.at("etag");
    const Answer changed = admin->post(root_ + what, body, {{"If-Match", tag}});
    ASSERT_EQ(changed.status, 200) << changed.body;
  };
  // No tour drove it: it may not exist, but a person has said that it does.
  const json places = graph().at("places");
  const std::string first = places.front().at("id");
  const std::string last = places.back().at("id");
  change("/edits", {{"edits", {{{"kind", "add_edge"}, {"from", first}, {"to", last}}}}});
  const json all = admin->get(root_ + "/doubts?about=all&limit=1000").json();
  ASSERT_EQ(all.at("total"), all.at("doubts").size());
  ASSERT_FALSE(all.at("doubts").empty());
  json pages = json::array();
  for (std::size_t i = 0; i <= all.at("doubts").size(); ++i) {
    const json page = admin->get(root_ + "/doubts?about=all&limit=1&offset=" + std::to_string(i)).json();
    EXPECT_EQ(page.at("total"), all.at("total"));
    for (const json& doubt : page.at("doubts")) pages.push_back(doubt);
  }
  EXPECT_EQ(pages, all.at("doubts"));
  const json asked = admin->get(root_ + "/doubts").json();
  for (const json& doubt : asked.at("doubts")) EXPECT_EQ(doubt.at("by"), "method");
  const json decided = admin->get(root_ + "/doubts?about=decided&kind=way&place=" + last).json().at("doubts");
  ASSERT_EQ(decided.size(), 1U) << all.dump();
  EXPECT_EQ(decided.at(0).at("by"), "person");
  change("/edits", {{"edits", decided.at(0).at("if_yes")}});
  change("/undo", json::object());
  change("/edits", {{"edits", decided.at(0).at("if_no")}});
  EXPECT_EQ(admin->get(root_ + "/doubts?about=decided&kind=way").json().at("total"), 0);
}

TEST_F(EvidenceTest, WhatIsAskedForWronglyIsNamed) {
  teach(3);
  const auto where = [&](const std::string& query) {
    const Answer answer = admin->get(root_ + "/doubts?" + query);
    EXPECT_EQ(answer.status, query == "place=p999" ? 404 : 422) << query << answer.body;
    return answer.json().value("where", "");
  };
  EXPECT_EQ(where("about=everything"), "query/about");
  EXPECT_EQ(where("kind=mood"), "query/kind");
  EXPECT_EQ(where("offset=-1"), "query/offset");
  EXPECT_EQ(where("limit=0"), "query/limit");
  EXPECT_EQ(where("limit=1001"), "query/limit");
  EXPECT_EQ(where("place=p999"), "query/place");
}

}  // namespace
}  // namespace homeward::server::evidence_test
