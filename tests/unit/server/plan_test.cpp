// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "support/server_fixture.hpp"
#include "unit/server/drawn_house.hpp"

namespace homeward::server::plan_test {
namespace {

using nlohmann::json;
using testing::Answer;
using ::testing::HasSubstr;
using testing::HttpClient;

class PlanTest : public testing::ServerTest {
 protected:
  Answer upload(HttpClient& by, const std::string& query, const std::string& file) {
    return by.send("POST", "/api/v1/plans?" + query, file, {{"Content-Type", "application/octet-stream"}});
  }
  json uploaded(const std::string& name = "Ground") {
    const Answer answer = upload(*admin, "format=wrl&name=" + name, drawn_house());
    EXPECT_EQ(answer.status, 201) << answer.body;
    return answer.json();
  }
  static std::string path(const json& plan, const std::string& part = "") {
    return "/api/v1/plans/" + plan.at("id").get<std::string>() + part;
  }
};

TEST_F(PlanTest, APlanIsReadKeptListedAndGivenBack) {
  const json plan = uploaded("Ground%20floor");
  EXPECT_EQ(plan.at("name"), "Ground floor");
  const json& version = plan.at("versions").at(0);
  EXPECT_EQ(version.at("version"), 1);
  EXPECT_EQ(version.at("format"), "wrl");
  EXPECT_EQ(version.at("by"), "anna");
  EXPECT_EQ(version.at("bytes"), drawn_house().size());
  EXPECT_EQ(version.at("lines"), 12);
  EXPECT_EQ(version.at("extent"), json::parse(R"({"min_x_m":0.0,"min_y_m":0.0,"min_z_m":0.0,
                                                   "max_x_m":8.0,"max_y_m":5.0,"max_z_m":2.5})"));
  restart();
  EXPECT_EQ(admin->get("/api/v1/plans").json().at("plans"), json::array({plan}));
  EXPECT_EQ(admin->get(path(plan)).json(), plan);
  const Answer file = admin->get(path(plan, "/file"));
  EXPECT_EQ(file.status, 200);
  EXPECT_EQ(file.body, drawn_house());
  EXPECT_EQ(file.headers.at("content-type"), "application/octet-stream");
  EXPECT_THAT(file.headers.at("content-disposition"), HasSubstr("attachment"));
}

TEST_F(PlanTest, ItsLinesAreFlatAndEachIsThereOnce) {
  const json plan = uploaded();
  const Answer answer = admin->get(path(plan, "/lines"));
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json lines = answer.json();
  EXPECT_EQ(lines.at("total"), 4) << "of twelve edges four are uprights, and four lie over four others";
  EXPECT_EQ(lines.at("segments").size(), 4U);
  EXPECT_EQ(lines.at("version"), 1);
  EXPECT_EQ(answer.headers.at("etag"), "\"v1\"");
  EXPECT_EQ(admin->get(path(plan, "/lines"), {{"If-None-Match", "\"v1\""}}).status, 304);
  EXPECT_EQ(admin->get(path(plan, "/lines?from_z_m=1&to_z_m=2")).json().at("total"), 0);
  EXPECT_EQ(admin->get(path(plan, "/lines?to_z_m=0.5")).json().at("total"), 4);
  EXPECT_EQ(admin->get(path(plan, "/lines?from_z_m=low")).json().at("where"), "query/from_z_m");
  EXPECT_EQ(admin->get(path(plan, "/lines?version=2")).status, 404);
  EXPECT_EQ(admin->get(path(plan, "/lines?version=0")).json().at("where"), "query/version");
}

TEST_F(PlanTest, WhatIsBrokenIsRefusedWithItsLine) {
  const Answer broken = upload(*admin, "format=wrl&name=x", "#VRML V2.0 utf8\nShape {\n  geometry Nothing what\n");
  EXPECT_EQ(broken.status, 422) << broken.body;
  EXPECT_THAT(broken.json().at("detail").get<std::string>() + broken.json().at("where").get<std::string>(),
              HasSubstr("3"));
  EXPECT_EQ(upload(*admin, "format=wrl&name=x", "").status, 422);
  for (const char* format : {"exe", "glb", "stl"}) {
    EXPECT_EQ(upload(*admin, std::string("format=") + format + "&name=x", drawn_house()).code(), "unsupported_format");
  }
  EXPECT_EQ(upload(*admin, "name=x", drawn_house()).json().at("where"), "query/format");
  EXPECT_EQ(upload(*admin, "format=wrl", drawn_house()).json().at("where"), "query/name");
  EXPECT_EQ(upload(*admin, "format=wrl&name=x&metres_per_unit=0", drawn_house()).json().at("where"),
            "query/metres_per_unit");
  EXPECT_EQ(upload(*admin, "format=wrl&name=x&wall_height_m=-2", drawn_house()).json().at("where"),
            "query/wall_height_m");
  EXPECT_TRUE(admin->get("/api/v1/plans").json().at("plans").empty());
}

TEST_F(PlanTest, WhatIsTooLargeIsRefused) {
  const Answer large = upload(*admin, "format=wrl&name=x", std::string((16UL << 20) + 1, ' '));
  EXPECT_EQ(large.status, 413);
  EXPECT_EQ(large.code(), "too_large");
}

TEST_F(PlanTest, VersionsStandBesideEachOther) {
  const json plan = uploaded();
  const std::string wider = drawn_house(9.0);
  const Answer added = admin->send("POST", path(plan, "/versions?format=WRL&metres_per_unit=1"), wider);
  ASSERT_EQ(added.status, 201) << added.body;
  EXPECT_EQ(added.json().at("versions").size(), 2U);
  EXPECT_EQ(added.json().at("versions").at(1).at("extent").at("max_x_m"), 9.0);
  EXPECT_EQ(added.json().at("versions").at(1).at("format"), "wrl");
  EXPECT_EQ(admin->get(path(plan, "/file")).body, wider) << "the newest";
  EXPECT_EQ(admin->get(path(plan, "/file?version=1")).body, drawn_house());
  EXPECT_EQ(admin->get(path(plan, "/file?version=3")).status, 404);
  EXPECT_EQ(admin->get(path(plan, "/lines")).headers.at("etag"), "\"v2\"");
  EXPECT_EQ(admin->send("POST", "/api/v1/plans/none/versions?format=wrl", wider).status, 404);
}

TEST_F(PlanTest, ItTakesAnotherNameAndIsRemoved) {
  const json plan = uploaded();
  EXPECT_EQ(admin->put(path(plan, "/name"), {{"name", "Annex"}}).json().at("name"), "Annex");
  EXPECT_EQ(admin->put(path(plan, "/name"), {{"name", ""}}).json().at("where"), "body/name");
  EXPECT_EQ(admin->put("/api/v1/plans/none/name", {{"name", "Annex"}}).status, 404);
  EXPECT_EQ(admin->send("DELETE", path(plan)).status, 204);
  EXPECT_EQ(admin->send("DELETE", path(plan)).status, 404);
  EXPECT_EQ(admin->get(path(plan)).status, 404);
}

TEST_F(PlanTest, ViewersLookAndInstallersChange) {
  const json plan = uploaded();
  HttpClient vera = signed_in("vera", "viewer");
  HttpClient carl = signed_in("carl", "carer");
  HttpClient ines = signed_in("ines", "installer");
  for (const char* part : {"", "/file", "/lines"}) EXPECT_EQ(vera.get(path(plan, part)).status, 200) << part;
  EXPECT_EQ(upload(vera, "format=wrl&name=x", drawn_house()).status, 403);
  EXPECT_EQ(upload(carl, "format=wrl&name=x", drawn_house()).status, 403);
  EXPECT_EQ(carl.send("POST", path(plan, "/versions?format=wrl"), drawn_house()).status, 403);
  EXPECT_EQ(carl.put(path(plan, "/name"), {{"name", "x"}}).status, 403);
  EXPECT_EQ(carl.send("DELETE", path(plan)).status, 403);
  EXPECT_EQ(carl.put("/api/v1/maps/m/plan", json::object()).status, 403);
  EXPECT_EQ(carl.send("DELETE", "/api/v1/maps/m/plan").status, 403);
  EXPECT_EQ(upload(ines, "format=wrl&name=x", drawn_house()).status, 201);
  HttpClient nobody(app->port());
  EXPECT_EQ(nobody.get("/api/v1/plans").status, 401);
}

}  // namespace
}  // namespace homeward::server::plan_test
