// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "imageio/decode.hpp"
#include "support/server_fixture.hpp"

namespace homeward::server::inspection_test {
namespace {

using nlohmann::json;
using testing::Answer;
using ::testing::HasSubstr;

class InspectionTest : public testing::ServerTest {
 protected:
  void teach(int rooms) {
    map_ = built_map(rooms);
    root_ = "/api/v1/maps/" + map_;
  }
  json get(const std::string& what) {
    const Answer answer = admin->get(root_ + what);
    EXPECT_EQ(answer.status, 200) << what << answer.body;
    return answer.json();
  }
  void change(const std::string& what, const json& body) {
    const std::string tag = admin->get(root_ + "/graph").headers.at("etag");
    const Answer changed = admin->post(root_ + what, body, {{"If-Match", tag}});
    ASSERT_EQ(changed.status, 200) << changed.body;
  }

  std::string map_;
  std::string root_;
};

TEST_F(InspectionTest, AMapIsShownAsItWasAfterEachChange) {
  teach(4);
  const json built = get("/graph");
  const json places = built.at("places");
  const std::string first = places.front().at("id");
  const std::string last = places.back().at("id");
  change("/edits", {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "attic"}}}}});
  change("/edits", {{"edits", {{{"kind", "merge"}, {"place", last}, {"into", first}}}}});
  json former = get("/history/0/graph");
  EXPECT_EQ(former.at("revision"), get("/graph").at("revision"));
  former["revision"] = built.at("revision");
  EXPECT_EQ(former, built);
  const json renamed = get("/history/1/graph");
  EXPECT_EQ(renamed.at("places").size(), places.size());
  EXPECT_EQ(renamed.at("places").front().at("label"), "attic");
  EXPECT_EQ(get("/history/2/graph"), get("/graph"));

  const json all = get("/history/0/difference");
  EXPECT_EQ(get("/history/0/difference?to=2"), all);
  EXPECT_FALSE(all.at("edges").empty());
  const json name = get("/history/0/difference?to=1");
  ASSERT_EQ(name.at("places").size(), 1U);
  EXPECT_EQ(name.at("places").at(0).at("after").at("label"), "attic");
  EXPECT_TRUE(get("/history/2/difference").at("places").empty());
  change("/undo", json::object());
  EXPECT_EQ(admin->get(root_ + "/history/2/graph").status, 404) << "it was taken back";
}

TEST_F(InspectionTest, WhatIsAskedForWronglyIsNamed) {
  teach(3);
  const auto where = [&](const std::string& what) {
    const Answer answer = admin->get(root_ + what);
    EXPECT_EQ(answer.status, 422) << what << answer.body;
    return answer.json().value("where", "");
  };
  EXPECT_EQ(where("/history/-1/graph"), "path/change");
  EXPECT_EQ(where("/history/first/difference"), "path/change");
  EXPECT_EQ(where("/history/0/difference?to=1.5"), "query/to");
  EXPECT_EQ(where("/similarity/31/0/0"), "path/level");
  EXPECT_EQ(where("/similarity/0/x/0"), "path/column");
  EXPECT_EQ(where("/similarity/0/0/99999999"), "path/row");
  EXPECT_EQ(admin->get(root_ + "/history/7/graph").status, 404);
  EXPECT_EQ(admin->get(root_ + "/similarity/0/1/0").status, 404);
  EXPECT_EQ(admin->get("/api/v1/maps/none/report").status, 404);
}

TEST_F(InspectionTest, ABuildLeavesItsReportAndHowAlikeAllPicturesAre) {
  teach(4);
  const Answer report = admin->get(root_ + "/report");
  ASSERT_EQ(report.status, 200) << report.body;
  EXPECT_THAT(report.headers.at("content-type"), HasSubstr("text/html"));
  EXPECT_THAT(report.headers.at("content-security-policy"), HasSubstr("default-src 'none'"));
  EXPECT_THAT(report.headers.at("content-security-policy"), HasSubstr("frame-ancestors 'self'"));
  EXPECT_THAT(report.body, HasSubstr("<h1>house</h1>"));
  EXPECT_THAT(report.body, HasSubstr("revision 1"));
  const json matrix = get("/similarity");
  EXPECT_EQ(matrix.at("revision"), 1);
  EXPECT_EQ(matrix.at("images").size(), admin->get(root_).json().at("images").get<std::size_t>());
  EXPECT_EQ(matrix.at("levels"), 1);
  const Answer tile = admin->get(root_ + "/similarity/0/0/0");
  ASSERT_EQ(tile.status, 200) << tile.body;
  EXPECT_EQ(tile.headers.at("content-type"), "image/png");
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(tile.body.data());
  const auto picture = imageio::decode({bytes, tile.body.size()}, "tile");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width_px, matrix.at("tile_px"));
  // What the map makes of the pictures is drawn as it is now.
  const json places = get("/graph").at("places");
  change("/edits",
         {{"edits", {{{"kind", "merge"}, {"place", places.back().at("id")}, {"into", places.front().at("id")}}}}});
  EXPECT_NE(admin->get(root_ + "/similarity/0/0/0").body, tile.body);
  EXPECT_EQ(get("/similarity"), matrix) << "of the build";
  const json job = admin->post(root_ + "/builds", {{"kind", "build"}}).json().at("job");
  ASSERT_EQ(wait_for_job(job.at("id")).at("state"), "done");
  EXPECT_EQ(get("/similarity").at("revision"), 3);
  EXPECT_THAT(admin->get(root_ + "/report").body, HasSubstr("revision 3"));
}

TEST_F(InspectionTest, AMapThatWasImportedHasNoReport) {
  teach(3);
  const Answer file = admin->get(root_ + "/export");
  ASSERT_EQ(file.status, 200);
  const Answer imported = admin->send("POST", "/api/v1/maps/import?name=copy", file.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string root = "/api/v1/maps/" + imported.json().at("map").at("id").get<std::string>();
  for (const char* what : {"/report", "/similarity", "/similarity/0/0/0"}) {
    EXPECT_EQ(admin->get(root + what).status, 404) << what;
  }
}

}  // namespace
}  // namespace homeward::server::inspection_test
