// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <set>

#include "support/driving_fixture.hpp"

namespace homeward::server::said_place_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;

/// A robot on a map, connected, that has seen nothing yet.
class SaidPlaceTest : public DrivingTest {
 protected:
  void connect() {
    add_robot();
    put_on_map();
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    lease = take_lease(*admin);
    agent.while_waiting = [this] { keep_lease(); };
    agent.hello();
    ASSERT_TRUE(agent.await<wire::Welcome>());
    graph = admin->get("/api/v1/maps/" + map + "/graph").json();
    home = graph.at("destinations")[0].at("place");
    ASSERT_GE(graph.at("places").size(), 3U);
    first = graph.at("places")[0].at("id");
    ASSERT_NE(first, home);
  }
  Answer say(testing::HttpClient& client, const json& body) { return client.put(root + "/place", body); }
  Answer say(const json& body) { return say(*admin, body); }
  void see(const std::string& jpeg) {
    ++agent.frame_seq;
    agent.say(wire::Frame{agent.frame_seq, agent.frame_seq, {jpeg.begin(), jpeg.end()}});
    ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  }
  /// A picture that shows nothing: what was believed before it is believed after it, too.
  void see_nothing() {
    const auto bytes = imageio::encode_jpeg(Image(testing::kRoomWidth_px, testing::kRoomHeight_px, 3), 92);
    see({bytes.begin(), bytes.end()});
  }
  void look(unsigned room) {
    agent.look(room);
    ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  }
  /// Looks about in the first room, which is not the one with "home", until the belief has followed.
  void look_around_in_first_room() {
    const std::string home_place =
        admin->get("/api/v1/maps/" + map + "/graph").json().at("destinations")[0].at("place");
    look(1);
    for (int i = 0; i < 20 && (belief().at("lost").get<bool>() || belief().at("place") == home_place); ++i) look(1);
    EXPECT_FALSE(belief().at("lost").get<bool>());
    EXPECT_NE(belief().at("place"), home_place);
  }
  json belief() { return admin->get(root).json().at("belief"); }
  /// How much of the belief is at these places and their neighbours.
  double share_beside(const std::set<std::string>& places) {
    std::set<std::string> beside = places;
    for (const json& edge : graph.at("edges")) {
      if (places.contains(edge.at("from"))) beside.insert(edge.at("to").get<std::string>());
      if (places.contains(edge.at("to"))) beside.insert(edge.at("from").get<std::string>());
    }
    double share = 0.0;
    const json now = belief();
    for (const json& one : now.at("top")) {
      if (beside.contains(one.at("place"))) share += one.at("probability").get<double>();
    }
    return share;
  }

  FakeAgent agent;
  std::string lease, home, first;
  json graph;
};

TEST_F(SaidPlaceTest, TheBeliefBeginsThereAndPicturesOverruleIt) {
  connect();
  see_nothing();
  EXPECT_LT(share_beside({home}), 0.9) << "nobody has said anything";
  for (const json& body : {json{{"place", home}}, json{{"label", "home"}}, json{{"label", "home"}}}) {
    const Answer said = say(body);
    ASSERT_EQ(said.status, 200) << said.body;
    EXPECT_EQ(said.json().at("id"), robot);
    EXPECT_TRUE(said.json().at("belief").is_null()) << "until its next picture";
    see_nothing();
    EXPECT_GT(share_beside({home}), 0.9);
    EXPECT_LT(share_beside({home}), 1.0);
  }
  look_around_in_first_room();
}

TEST_F(SaidPlaceTest, EveryPlaceOfALabelIsMeant) {
  connect();
  const std::int64_t revision = graph.at("revision");
  const json edits = {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "home"}}}}};
  const Answer edited =
      admin->send("POST", "/api/v1/maps/" + map + "/edits", edits.dump(),
                  {{"Content-Type", "application/json"}, {"If-Match", "\"r" + std::to_string(revision) + "\""}});
  ASSERT_EQ(edited.status, 200) << edited.body;
  ASSERT_EQ(say({{"label", "home"}}).status, 200);
  see_nothing();
  EXPECT_GT(share_beside({home, first}), 0.9);
  std::map<std::string, double> shares;
  const json now = belief();
  for (const json& one : now.at("top")) shares[one.at("place")] = one.at("probability");
  EXPECT_NEAR(shares[home], shares[first], 1e-9);
}

TEST_F(SaidPlaceTest, AWordAloneLetsItDriveNowhereBeforeItHasFoundOut) {
  connect();
  ASSERT_EQ(say({{"place", first}}).status, 200);
  EXPECT_EQ(send_home(lease).code(), "lost") << "it has seen nothing since";
  see_nothing();
  EXPECT_TRUE(belief().at("lost").get<bool>());
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  EXPECT_EQ(sent.json().at("reason").at("code"), "looks_around_first");
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order && order->surroundings);
  EXPECT_LE(order->surroundings->start_probability, 0.5);
}

TEST_F(SaidPlaceTest, WhatWasSaidBeforeALiftCountsNoMore) {
  connect();
  ASSERT_EQ(say({{"place", home}}).status, 200);
  agent.displaced = 1;
  agent.status(wire::DriveState::kIdle);
  see_nothing();
  EXPECT_LT(share_beside({home}), 0.9);
}

TEST_F(SaidPlaceTest, ItIsSaidByWhoMayDriveOfAConnectedRobotThatStands) {
  testing::HttpClient viewer = signed_in("vera", "viewer");
  testing::HttpClient rider = signed_in("rita", "rider");
  testing::HttpClient stranger(app->port());
  add_robot();
  EXPECT_EQ(say({{"place", "p0"}}).code(), "conflict") << "no map";
  put_on_map();
  const json here = {{"label", "home"}};
  EXPECT_EQ(say(here).code(), "robot_offline");
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  lease = take_lease(*admin);
  find_itself(agent);
  EXPECT_EQ(say(viewer, here).status, 403);
  EXPECT_EQ(say(stranger, here).status, 401);
  EXPECT_FALSE(belief().is_null()) << "they change nothing";
  EXPECT_EQ(say(rider, here).status, 200) << "it takes no lease";
  look_around_in_first_room();
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  const Answer late = say(here);
  EXPECT_EQ(late.status, 409);
  EXPECT_EQ(late.code(), "conflict") << "it is on its way";
  EXPECT_FALSE(belief().is_null());
}

TEST_F(SaidPlaceTest, WhatIsUnknownOrCannotBeReadIsRefused) {
  connect();
  see_nothing();
  for (const json& body :
       {json{{"place", "cellar"}}, json{{"label", "cellar"}}, json{{"place", "home"}}, json{{"label", first}}}) {
    const Answer said = say(body);
    EXPECT_EQ(said.status, 404) << body;
    EXPECT_EQ(said.code(), "unknown_place") << body;
  }
  for (const json& body : {json::object(), json{{"place", home}, {"label", "home"}}, json{{"place", 1}},
                           json{{"label", ""}}, json{{"place", ""}}, json{{"place", home}, {"by", "me"}}}) {
    EXPECT_EQ(say(body).status, 422) << body;
  }
  const Answer none = admin->put("/api/v1/robots/none/place", {{"place", home}});
  EXPECT_EQ(none.status, 404);
  EXPECT_EQ(none.code(), "not_found");
  EXPECT_FALSE(belief().is_null()) << "they change nothing";
}

}  // namespace
}  // namespace homeward::server::said_place_test
