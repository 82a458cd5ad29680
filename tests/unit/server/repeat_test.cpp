// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "map/taught_path.hpp"
#include "support/driving_fixture.hpp"
#include "support/sample_path.hpp"

namespace homeward::server::repeat_test {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::FakeAgent;

class RepeatTest : public testing::DrivingTest {
 protected:
  /// The robot on its map, taken for one that was taught as a path: the prototypes of its places are the key images.
  void set_off_on_path(bool repeats) {
    add_robot();
    put_on_map();
    map = with_path();
    ASSERT_EQ(admin->put(root + "/map", {{"map", map}}).status, 200);
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    agent.repeats = repeats;
    lease = take_lease(*admin);
    find_itself(agent);
  }
  std::string with_path() {
    const auto file = config.data / "path.hwmap";
    std::ofstream(file, std::ios::binary) << admin->get("/api/v1/maps/" + map + "/export").body;
    auto stored = db::load_map(file);
    EXPECT_TRUE(stored) << stored.error().message;
    map::TopologicalMap& taught = stored->map;
    map::MapPath path;
    for (std::size_t i = 0; i < taught.images.size(); ++i) {
      const auto is_key = [&](const map::Place& place) { return place.prototype == taught.images[i].id; };
      if (std::ranges::none_of(taught.places, is_key)) continue;
      map::KeyImage key;
      key.picture = static_cast<int>(i);
      path.taught.key_images.push_back(key);
      path.images.push_back(taught.images[i].id);
      path.pictures.push_back({std::uint8_t{0xFF}, std::uint8_t{0xD8}});
    }
    for (int from = 0; from + 1 < static_cast<int>(path.images.size()); ++from)
      path.taught.arcs.push_back(homeward::testing::sample_arc(from, 1.0 + from, 0));
    taught.path = std::make_shared<const map::MapPath>(std::move(path));
    EXPECT_TRUE(db::save_map(file, taught, stored->thumbnails));
    std::stringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    return imported_map(bytes.str());
  }
  json graph() { return admin->get("/api/v1/maps/" + map + "/graph").json(); }
  void tell(wire::DriveState state, const wire::RepeatOrder& order, std::int64_t arc,
            const std::optional<wire::Reason>& reason = {}) {
    wire::MissionOrder of;
    of.mission = order.mission;
    of.order = order.order;
    agent.status(state, of, arc, reason);
  }

  FakeAgent agent;
  std::string lease;
};

TEST_F(RepeatTest, ARobotThatRepeatsIsSentAlongThePathToWhereTheDestinationsPictureWasTaken) {
  set_off_on_path(true);
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  const auto order = agent.await<wire::RepeatOrder>();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->mission, MissionId(sent.json().at("id").get<std::string>()));
  EXPECT_EQ(order->map, MapId(map));
  const json goal = graph().at("destinations")[0];
  EXPECT_EQ(order->image.str(), goal.at("image"));
  EXPECT_EQ(order->label, goal.at("label"));
  EXPECT_EQ(order->rounds, 0);
  EXPECT_EQ(sent.json().at("path").back(), goal.at("place"));
}

TEST_F(RepeatTest, WhatFailsOnThePathIsOverAtOnceAsNoOtherWayLeadsThere) {
  set_off_on_path(true);
  const json mission = send_home(lease).json();
  const auto order = agent.await<wire::RepeatOrder>();
  ASSERT_TRUE(order);
  tell(wire::DriveState::kDriving, *order, 0);
  let_work_off(agent);
  EXPECT_EQ(mission_now(mission).at("state"), "driving");
  tell(wire::DriveState::kFailed, *order, 0, wire::Reason{wire::ReasonCode::kWayBlocked});
  let_work_off(agent);
  EXPECT_EQ(mission_now(mission).at("state"), "failed");
  EXPECT_EQ(mission_now(mission).at("reason").at("code"), "way_blocked");
  EXPECT_FALSE(comes_at_once<wire::MissionOrder>(agent));
}

TEST_F(RepeatTest, ARobotThatDoesNotRepeatHomesFromViewToView) {
  set_off_on_path(false);
  ASSERT_EQ(send_home(lease).status, 201);
  EXPECT_TRUE(agent.await<wire::MissionOrder>());
}

TEST_F(RepeatTest, ARobotMayFetchMapsAndNobodyWithoutAToken) {
  set_off_on_path(true);
  testing::HttpClient client(app->port());
  const std::string path = "/api/v1/maps/" + map + "/export";
  EXPECT_EQ(client.send("GET", path, "", {{"Authorization", "Bearer " + token}}).status, 200);
  EXPECT_EQ(client.send("GET", path, "", {}).status, 401);
}

TEST_F(RepeatTest, APathOfSeveralToursOrInWordsIsRefused) {
  built_map(3);
  const json tours = admin->get("/api/v1/tours").json().at("tours");
  ASSERT_FALSE(tours.empty());
  const std::string tour = tours[0].at("id");
  const Answer two = admin->post("/api/v1/maps", {{"name", "way"}, {"tours", {tour, "another"}}, {"path", true}});
  EXPECT_EQ(two.status, 422) << two.body;
  EXPECT_NE(two.body.find("one tour"), std::string::npos) << two.body;
  const Answer words = admin->post("/api/v1/maps", {{"name", "way"}, {"tours", {tour}}, {"path", "yes"}});
  EXPECT_EQ(words.status, 422) << words.body;
}

}  // namespace
}  // namespace homeward::server::repeat_test
