// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "support/server_fixture.hpp"
#include "unit/server/drawn_house.hpp"

namespace homeward::server::map_plan_test {
namespace {

using nlohmann::json;
using testing::Answer;
using ::testing::HasSubstr;

class MapPlanTest : public testing::ServerTest {
 protected:
  void teach() {
    map_ = built_map(4);
    root_ = "/api/v1/maps/" + map_;
    plan_ = admin->send("POST", "/api/v1/plans?format=wrl&name=Ground", drawn_house()).json().at("id");
  }
  json graph() { return admin->get(root_ + "/graph").json(); }
  /// The ids of the first and last place.
  std::pair<std::string, std::string> ends() {
    const json places = graph().at("places");
    return {places.front().at("id"), places.back().at("id")};
  }
  json two_pins() {
    const auto [first, last] = ends();
    return {{"plan", plan_},
            {"pins",
             {{{"place", first}, {"x_m", 1.0}, {"y_m", 2.0}, {"theta_rad", 0.5}},
              {{"place", last}, {"x_m", 7.0}, {"y_m", 2.0}}}}};
  }
  Answer tie(const json& body) { return admin->put(root_ + "/plan", body); }
  json shown() {
    const Answer answer = admin->get(root_ + "/plan");
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json();
  }
  json place_of(const json& shown, const std::string& id) {
    for (const json& one : shown.at("places")) {
      if (one.at("place") == id) return one;
    }
    ADD_FAILURE() << id << " is not in " << shown.dump();
    return {};
  }
  json map_info() { return admin->get(root_).json(); }

  std::string map_;
  std::string root_;
  std::string plan_;
};

TEST_F(MapPlanTest, TwoPinsPutEveryPlaceOntoThePlan) {
  teach();
  EXPECT_EQ(admin->get(root_ + "/plan").status, 404);
  EXPECT_TRUE(map_info().at("plan").is_null());
  const Answer tied = tie(two_pins());
  ASSERT_EQ(tied.status, 200) << tied.body;
  EXPECT_EQ(tied.json(), shown());
  EXPECT_EQ(shown().at("places").size() + shown().at("unplaced").size(), graph().at("places").size());
  EXPECT_GE(shown().at("places").size(), 3U) << "places between the pins as well";
  const auto [first, last] = ends();
  const json pinned = place_of(shown(), first);
  EXPECT_TRUE(pinned.at("pinned"));
  EXPECT_EQ(pinned.at("x_m"), 1.0);
  EXPECT_EQ(pinned.at("y_m"), 2.0);
  EXPECT_NEAR(pinned.at("theta_rad"), 0.5, 1e-9);
  EXPECT_FALSE(pinned.at("residual_m").is_null());
  EXPECT_FALSE(shown().at("rms_m").is_null());
  EXPECT_EQ(shown().at("by"), "anna");
  EXPECT_EQ(shown().at("version"), 1);
  EXPECT_EQ(map_info().at("plan").at("id"), plan_);
  EXPECT_EQ(admin->get("/api/v1/plans/" + plan_).json().at("maps"), json::array({map_}));
}

TEST_F(MapPlanTest, PosesStayThroughEditsAndARebuild) {
  teach();
  ASSERT_EQ(tie(two_pins()).status, 200);
  const json before = shown();
  const std::string first = ends().first;
  const Answer edited =
      admin->post(root_ + "/edits", {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "porch"}}}}},
                  {{"If-Match", admin->get(root_ + "/graph").headers.at("etag")}});
  ASSERT_EQ(edited.status, 200) << edited.body;
  EXPECT_EQ(shown().at("places"), before.at("places"));
  EXPECT_GT(shown().at("revision"), before.at("revision"));
  const Answer again = admin->post(root_ + "/builds", {{"kind", "build"}});
  ASSERT_EQ(again.status, 202) << again.body;
  ASSERT_EQ(wait_for_job(again.json().at("job").at("id")).at("state"), "done");
  const json after = shown();
  EXPECT_EQ(after.at("pins").size(), 2U);
  for (const json& pin : after.at("pins")) {
    ASSERT_FALSE(pin.at("place").is_null()) << "its picture is in the rebuilt map";
    const json place = place_of(after, pin.at("place"));
    EXPECT_TRUE(place.at("pinned"));
    EXPECT_NEAR(std::hypot(place.at("x_m").get<double>() - pin.at("x_m").get<double>(),
                           place.at("y_m").get<double>() - pin.at("y_m").get<double>()),
                0.0, 1e-6);
  }
  EXPECT_EQ(after.at("places").size(), before.at("places").size());
  restart();
  EXPECT_EQ(shown(), after);
}

TEST_F(MapPlanTest, PinsFollowTheirPicturesToOtherPlaces) {
  teach();
  ASSERT_EQ(tie(two_pins()).status, 200);
  const json places = graph().at("places");
  const std::string first = places.at(0).at("id");
  const std::string second = places.at(1).at("id");
  const Answer merged =
      admin->post(root_ + "/edits", {{"edits", {{{"kind", "merge"}, {"place", first}, {"into", second}}}}},
                  {{"If-Match", admin->get(root_ + "/graph").headers.at("etag")}});
  ASSERT_EQ(merged.status, 200) << merged.body;
  EXPECT_EQ(shown().at("pins").at(0).at("place"), second);
  EXPECT_TRUE(place_of(shown(), second).at("pinned"));
}

TEST_F(MapPlanTest, DashboardsAreToldAndAPlanInUseStays) {
  teach();
  ASSERT_EQ(tie(two_pins()).status, 200);
  const json before = map_info().at("plan");
  clock.pass(std::chrono::seconds(1));
  ASSERT_EQ(tie(two_pins()).status, 200);
  EXPECT_NE(map_info().at("plan"), before) << "dashboards see by it that they have to ask anew";
  const Answer kept = admin->send("DELETE", "/api/v1/plans/" + plan_);
  EXPECT_EQ(kept.status, 409);
  EXPECT_EQ(kept.code(), "conflict");
  EXPECT_EQ(admin->send("DELETE", root_ + "/plan").status, 204);
  EXPECT_TRUE(map_info().at("plan").is_null());
  EXPECT_EQ(admin->get(root_ + "/plan").status, 404);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/plans/" + plan_).status, 204);
}

TEST_F(MapPlanTest, AnotherVersionIsTakenOnPurposeAlone) {
  teach();
  ASSERT_EQ(tie(two_pins()).status, 200);
  ASSERT_EQ(admin->send("POST", "/api/v1/plans/" + plan_ + "/versions?format=wrl", drawn_house(9.0)).status, 201);
  EXPECT_EQ(shown().at("version"), 1);
  EXPECT_EQ(shown().at("newest_version"), 2);
  json body = two_pins();
  body["version"] = 1;
  EXPECT_EQ(tie(body).json().at("version"), 1);
  EXPECT_EQ(tie(two_pins()).json().at("version"), 2);
  body["version"] = 3;
  EXPECT_EQ(tie(body).status, 404);
}

TEST_F(MapPlanTest, WrongPinsAreRefusedByTheirField) {
  teach();
  json one = two_pins();
  one["pins"].erase(1);
  EXPECT_EQ(tie(one).status, 422);
  EXPECT_THAT(tie(one).json().at("detail").get<std::string>(), HasSubstr("at least two places"));
  json unknown = two_pins();
  unknown["pins"][1]["place"] = "p999";
  EXPECT_EQ(tie(unknown).code(), "unknown_place");
  EXPECT_EQ(tie(unknown).json().at("where"), "body/pins/1/place");
  json near = two_pins();
  near["pins"][1]["x_m"] = 1.1;
  near["pins"][0].erase("theta_rad");
  EXPECT_EQ(tie(near).status, 422);
  EXPECT_EQ(tie(near).json().at("where"), "body/pins");
  json picture = two_pins();
  picture["pins"][0].erase("place");
  picture["pins"][0]["image"] = "none/none.jpg";
  EXPECT_EQ(tie(picture).status, 404);
  json nowhere = two_pins();
  nowhere["plan"] = "none";
  EXPECT_EQ(tie(nowhere).status, 404);
  EXPECT_EQ(admin->put("/api/v1/maps/none/plan", two_pins()).status, 404);
  EXPECT_EQ(admin->get(root_ + "/plan").status, 404) << "nothing of that was kept";
}

}  // namespace
}  // namespace homeward::server::map_plan_test
