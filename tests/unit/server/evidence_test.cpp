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
  const json all = admin->get(root_ + "/doubts?about=all&limit=1000").json();
  ASSERT_EQ(all.at("total"), all.at("doubts").size());
  double last = 1.0;
  for (const json& doubt : all.at("doubts")) {
    EXPECT_EQ(doubt.at("by"), "method");
    EXPECT_LE(doubt.at("weight").get<double>(), last);
    last = doubt.at("weight");
  }
  ASSERT_FALSE(all.at("doubts").empty());
  json pages = json::array();
  for (std::size_t i = 0; i <= all.at("doubts").size(); ++i) {
    const json page = admin->get(root_ + "/doubts?about=all&limit=1&offset=" + std::to_string(i)).json();
    EXPECT_EQ(page.at("total"), all.at("total"));
    for (const json& doubt : page.at("doubts")) pages.push_back(doubt);
  }
  EXPECT_EQ(pages, all.at("doubts"));
  // Each answer of each kind is an edit that the map takes.
  for (const char* answer : {"if_yes", "if_no"}) {
    const json edits = all.at("doubts").at(0).at(answer);
    if (edits.empty()) continue;
    const std::string tag = admin->get(root_ + "/graph").headers.at("etag");
    const Answer decided = admin->post(root_ + "/edits", {{"edits", edits}}, {{"If-Match", tag}});
    ASSERT_EQ(decided.status, 200) << decided.body;
    const std::string after = admin->get(root_ + "/graph").headers.at("etag");
    ASSERT_EQ(admin->post(root_ + "/undo", json::object(), {{"If-Match", after}}).status, 200);
  }
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
