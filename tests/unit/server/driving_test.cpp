// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <sstream>

#include "db/map_file.hpp"
#include "server/driving/detour.hpp"
#include "support/server_fixture.hpp"
#include "wire/link_messages.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::Answer;
using testing::SocketClient;

/// An agent that says what the test tells it to.
class FakeAgent {
 public:
  int connect(std::uint16_t port, const std::string& robot, const std::string& token) {
    return socket.open(port, "/api/v1/robots/" + robot + "/link", {{"Authorization", "Bearer " + token}});
  }
  void say(const wire::AgentMessage& message) {
    const auto bytes = wire::encode(message);
    socket.send({bytes.begin(), bytes.end()}, false);
  }
  void hello(const std::string& session = "s1") {
    wire::Hello hello;
    hello.agent = "homeward-agent/test";
    hello.robot_name = "chair";
    hello.session = session;
    hello.camera = testing::small_panorama_camera();
    say(hello);
  }
  void status(wire::DriveState state, const std::optional<wire::MissionOrder>& order = {}, std::int64_t index = 0) {
    wire::AgentStatus status;
    status.seq = ++status_seq;
    status.t_us = 1;
    status.state = state;
    status.path_index = index;
    if (order) {
      status.mission = order->mission;
      status.epoch = order->order.epoch;
    }
    say(status);
  }
  /// The next message of one kind within `patience`; others are passed over.
  template <class T>
  std::optional<T> await(milliseconds patience = milliseconds(10'000)) {
    const auto end = steady_clock::now() + patience;
    while (steady_clock::now() < end && !socket.closed()) {
      const auto left = std::chrono::duration_cast<milliseconds>(end - steady_clock::now());
      const auto bytes = socket.receive(std::max(left, milliseconds(1)));
      if (!bytes) continue;
      const auto message =
          wire::decode_server_message({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
      EXPECT_TRUE(message) << message.error().message;
      if (message && std::holds_alternative<T>(*message)) return std::get<T>(*message);
    }
    return std::nullopt;
  }
  void look(unsigned room) {
    const std::string picture = testing::room_picture(room, static_cast<unsigned>(++frame_seq) + 1000U);
    say(wire::Frame{frame_seq, frame_seq, {picture.begin(), picture.end()}});
  }

  SocketClient socket;
  std::int64_t status_seq = 0;
  std::int64_t frame_seq = 0;
};

class DrivingTest : public testing::ServerTest {
 protected:
  void add_robot() {
    const json made = admin->post("/api/v1/robots", {{"name", "chair"}}).json();
    robot = made.at("id");
    token = made.at("token");
    root = "/api/v1/robots/" + robot;
  }
  void put_on_map() {
    map = built_map(3);
    ASSERT_EQ(admin->put(root + "/map", {{"map", map}}).status, 200);
    destination = admin->get("/api/v1/maps/" + map + "/graph").json().at("destinations")[0].at("id");
  }
  /// A map like the robot's with a weak way straight from the first place to the destination, and the robot on it.
  void add_second_way() {
    const auto file = config.data / "second_way.hwmap";
    const std::string bytes = admin->get("/api/v1/maps/" + map + "/export").body;
    std::ofstream(file, std::ios::binary) << bytes;
    auto stored = db::load_map(file);
    ASSERT_TRUE(stored) << stored.error().message;
    const PlaceId goal = stored->map.destinations.at(0).place;
    for (const bool back : {false, true}) {
      map::Edge edge;
      edge.from = back ? goal : stored->map.places.front().id;
      edge.to = back ? stored->map.places.front().id : goal;
      edge.weak = true;
      stored->map.edges.push_back(edge);
    }
    ASSERT_TRUE(db::save_map(file, stored->map, stored->thumbnails));
    std::stringstream edited;
    edited << std::ifstream(file, std::ios::binary).rdbuf();
    const Answer imported =
        admin->send("POST", "/api/v1/maps/import", edited.str(), {{"Content-Type", "application/vnd.sqlite3"}});
    ASSERT_EQ(imported.status, 201) << imported.body;
    map = imported.json().at("map").at("id");
    ASSERT_EQ(admin->put(root + "/map", {{"map", map}}).status, 200);
  }
  std::string take_lease(testing::HttpClient& client) {
    return client.post(root + "/lease", {{"take_over", true}}).json().at("lease").at("id");
  }
  Answer send_home(const std::string& lease) {
    return admin->post(root + "/missions", {{"lease_id", lease}, {"destination", destination}});
  }
  void find_itself(FakeAgent& agent) {
    agent.hello();
    ASSERT_TRUE(agent.await<wire::Welcome>());
    for (int i = 0; i < 20; ++i) {
      agent.look(1);
      const auto belief = agent.await<wire::BeliefReport>(milliseconds(60'000));
      ASSERT_TRUE(belief) << admin->get(root).body;
      if (!belief->lost) return;
    }
    FAIL() << "the fake agent never learnt where it is";
  }
  json mission_now(const json& mission) {
    return admin->get(root + "/missions/" + mission.at("id").get<std::string>()).json();
  }
  json wait_for_state(const json& mission, const std::string& state) {
    for (int i = 0; i < 200 && mission_now(mission).at("state") != state; ++i) {
      std::this_thread::sleep_for(milliseconds(20));
    }
    return mission_now(mission);
  }

  std::string robot, token, root, map, destination;
};

TEST_F(DrivingTest, OneDrivesAndTheOthersAreTold) {
  add_robot();
  testing::HttpClient rider = signed_in("rita", "rider");
  testing::HttpClient viewer = signed_in("vera", "viewer");
  const Answer taken = rider.post(root + "/lease");
  ASSERT_EQ(taken.status, 200) << taken.body;
  const std::string lease = taken.json().at("lease").at("id");
  const Answer held = admin->post(root + "/lease");
  EXPECT_EQ(held.status, 409);
  EXPECT_EQ(held.code(), "lease_held");
  EXPECT_NE(held.json().at("detail").get<std::string>().find("rita"), std::string::npos);
  EXPECT_EQ(rider.post(root + "/lease").json().at("lease").at("id"), lease) << "the same person after a reload";
  EXPECT_EQ(admin->get(root).json().at("lease").at("holder"), "rita");
  EXPECT_FALSE(admin->get(root).json().at("lease").contains("id")) << "the id proves the right";
  EXPECT_EQ(rider.put(root + "/lease", {{"lease_id", lease}}).status, 200);
  const json over = admin->post(root + "/lease", {{"take_over", true}}).json().at("lease");
  EXPECT_GT(over.at("epoch").get<int>(), taken.json().at("lease").at("epoch").get<int>());
  EXPECT_EQ(rider.put(root + "/lease", {{"lease_id", lease}}).code(), "lease_held");
  EXPECT_EQ(admin->send("DELETE", root + "/lease", json({{"lease_id", over.at("id")}}).dump()).status, 204);
  EXPECT_TRUE(admin->get(root).json().at("lease").is_null());
  EXPECT_EQ(viewer.post(root + "/lease").status, 403);
  EXPECT_EQ(admin->post("/api/v1/robots/none/lease").status, 404);
}

TEST_F(DrivingTest, ARobotThatComesBackGoesOnFromWhereItWas) {
  add_robot();
  put_on_map();
  for (const int updates : {1, 2}) {
    FakeAgent agent;
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    agent.hello("s" + std::to_string(updates));
    ASSERT_TRUE(agent.await<wire::Welcome>());
    agent.look(1);
    ASSERT_TRUE(agent.await<wire::BeliefReport>());
    EXPECT_EQ(admin->get(root).json().at("belief").at("updates"), updates);
  }
}

TEST_F(DrivingTest, NoMissionWithoutLeaseOrRobot) {
  add_robot();
  EXPECT_EQ(admin->post(root + "/missions", {{"lease_id", "x"}, {"place", "p1"}}).code(), "lease_held");
  const std::string lease = take_lease(*admin);
  const Answer offline = admin->post(root + "/missions", {{"lease_id", lease}, {"place", "p1"}});
  EXPECT_EQ(offline.status, 409);
  EXPECT_EQ(offline.code(), "robot_offline");
  EXPECT_EQ(admin->post(root + "/missions", {{"lease_id", lease}}).status, 422);
  testing::HttpClient viewer = signed_in("vera", "viewer");
  EXPECT_EQ(viewer.post(root + "/stop").status, 202) << "anyone may stop";
  EXPECT_EQ(viewer.get(root + "/frame").status, 404);
  testing::HttpClient stranger(app->port());
  EXPECT_EQ(stranger.post(root + "/stop").status, 401);
}

TEST_F(DrivingTest, OnlyTheRobotsOwnTokenOpensItsLink) {
  add_robot();
  const json other = admin->post("/api/v1/robots", {{"name", "other"}}).json();
  EXPECT_EQ(FakeAgent().connect(app->port(), robot, other.at("token")), 403);
  EXPECT_EQ(FakeAgent().connect(app->port(), robot, "wrong"), 401);
  SocketClient by_cookie;
  EXPECT_EQ(by_cookie.open(app->port(), root + "/link", {{"Cookie", admin->cookie}}), 403);
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  agent.status(wire::DriveState::kIdle);  // before hello
  EXPECT_TRUE(agent.await<wire::LinkError>());
  EXPECT_FALSE(agent.await<wire::Welcome>(milliseconds(500)));
  EXPECT_TRUE(agent.socket.closed());
}

TEST_F(DrivingTest, AMissionIsPermittedUntilItArrives) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  EXPECT_FALSE(admin->get(root + "/frame").body.empty());
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  EXPECT_EQ(sent.json().at("state"), "accepted");
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->label, "home");
  EXPECT_EQ(order->path.size(), sent.json().at("path").size());
  EXPECT_FALSE(order->path.front().appearance.empty());
  EXPECT_FALSE(order->final_appearance.empty());
  wire::Order newest = order->order;
  for (int i = 0; i < 5; ++i) {
    agent.status(wire::DriveState::kDriving, order, 1);
    const auto permit = agent.await<wire::Permit>(milliseconds(2000));
    ASSERT_TRUE(permit);
    EXPECT_EQ(permit->mission, order->mission);
    EXPECT_GT(permit->order, newest) << "each permit is newer";
    newest = permit->order;
  }
  EXPECT_EQ(wait_for_state(sent.json(), "driving").at("path_index"), 1);
  agent.status(wire::DriveState::kArrived, order, 2);
  EXPECT_EQ(wait_for_state(sent.json(), "arrived").at("state"), "arrived");
  while (agent.await<wire::Permit>(milliseconds(150))) {
  }
  EXPECT_FALSE(agent.await<wire::Permit>(milliseconds(400))) << "no permits after the end";
  EXPECT_EQ(admin->get(root + "/missions").json().at("missions").size(), 1U);
}

TEST_F(DrivingTest, AStopOvertakesAndALostLinkStops) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  EXPECT_EQ(admin->post(root + "/missions", {{"lease_id", lease}, {"place", "p999"}}).code(), "unknown_place");
  const json mission = send_home(lease).json();
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  agent.status(wire::DriveState::kDriving, order);
  testing::HttpClient viewer = signed_in("vera", "viewer");
  const auto asked = steady_clock::now();
  const Answer stop = viewer.post(root + "/stop", {{"reason", "a cat"}});
  EXPECT_EQ(stop.status, 202);
  const auto told = agent.await<wire::StopOrder>();
  ASSERT_TRUE(told);
  EXPECT_LT(steady_clock::now() - asked, milliseconds(1000));
  EXPECT_EQ(told->stop_id, stop.json().at("stop_id"));
  EXPECT_EQ(told->by, "vera");
  EXPECT_EQ(mission_now(mission).at("state"), "stopped");
  EXPECT_EQ(mission_now(mission).at("reason"), "a cat");

  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  const Answer again = send_home(lease);
  ASSERT_EQ(again.status, 201) << again.body;
  EXPECT_GT(again.json().at("seq"), mission.at("seq"));
  agent.socket.cut();
  EXPECT_EQ(wait_for_state(again.json(), "stopped").at("state"), "stopped") << "a lost link ends the mission";
  EXPECT_FALSE(admin->get(root).json().at("online").get<bool>());

  FakeAgent reborn;
  ASSERT_EQ(reborn.connect(app->port(), robot, token), 101);
  reborn.hello();
  const auto welcome = reborn.await<wire::Welcome>();
  ASSERT_TRUE(welcome);
  EXPECT_GT(welcome->epoch, order->order.epoch) << "a reconnect begins a new epoch";
  EXPECT_FALSE(reborn.await<wire::MissionOrder>(milliseconds(400))) << "nothing moves before a person says so";
}

TEST(FailedWays, AreTheOneDrivenAndTheOneAfterIt) {
  const std::vector<PlaceId> path = {PlaceId("p1"), PlaceId("p2"), PlaceId("p3"), PlaceId("p4")};
  const auto way = [](const char* from, const char* to) { return planning::Way{PlaceId(from), PlaceId(to)}; };
  using Ways = std::vector<planning::Way>;
  EXPECT_EQ(failed_ways(path, 1, PlaceId("p1")), (Ways{way("p1", "p2"), way("p2", "p1")}));
  EXPECT_EQ(failed_ways(path, 2, PlaceId("p9")), (Ways{way("p2", "p3"), way("p3", "p2")}));
  EXPECT_EQ(failed_ways(path, 2, PlaceId("p3")),
            (Ways{way("p2", "p3"), way("p3", "p2"), way("p3", "p4"), way("p4", "p3")}));
  EXPECT_EQ(failed_ways(path, 0, PlaceId("p1")), (Ways{way("p1", "p2"), way("p2", "p1")}));
  EXPECT_EQ(failed_ways(path, 3, PlaceId("p4")), (Ways{way("p3", "p4"), way("p4", "p3")}));
  EXPECT_TRUE(failed_ways(path, 0, PlaceId("p9")).empty());
  EXPECT_TRUE(failed_ways({PlaceId("p1")}, 0, PlaceId("p1")).empty());
}

TEST_F(DrivingTest, AFailedWayIsDrivenRoundAndWithoutAnotherTheMissionFails) {
  add_robot();
  put_on_map();
  add_second_way();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  const auto first = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(first);
  ASSERT_GE(first->path.size(), 2U);
  agent.status(wire::DriveState::kDriving, first, 1);
  wait_for_state(sent.json(), "driving");
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.status(wire::DriveState::kFailed, first, 1);
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second) << mission_now(sent.json()).dump();
  EXPECT_EQ(second->mission, first->mission) << "the same mission";
  EXPECT_GT(second->order, first->order);
  EXPECT_EQ(second->path.back().place, first->path.back().place);
  EXPECT_NE(second->path[1].place, first->path[1].place);
  json now = mission_now(sent.json());
  EXPECT_EQ(now.at("state"), "accepted");
  EXPECT_EQ(now.at("seq"), second->order.seq);
  EXPECT_EQ(now.at("path").size(), second->path.size());
  EXPECT_NE(now.at("reason").get<std::string>().find("another way"), std::string::npos) << now.dump();

  // What it still tells of the first way changes nothing.
  agent.status(wire::DriveState::kFailed, first, 1);
  agent.status(wire::DriveState::kDriving, second, 1);
  EXPECT_EQ(wait_for_state(sent.json(), "driving").at("state"), "driving");
  EXPECT_TRUE(agent.await<wire::Permit>(milliseconds(2000)));
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.status(wire::DriveState::kFailed, second, 1);
  now = wait_for_state(sent.json(), "failed");
  EXPECT_EQ(now.at("state"), "failed");
  EXPECT_NE(now.at("reason").get<std::string>().find("has just failed"), std::string::npos) << now.dump();
  EXPECT_FALSE(agent.await<wire::MissionOrder>(milliseconds(400)));
}

TEST_F(DrivingTest, WithoutALeaseNoOtherWayIsDriven) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  agent.status(wire::DriveState::kDriving, order, 1);
  wait_for_state(sent.json(), "driving");
  EXPECT_EQ(admin->send("DELETE", root + "/lease", json({{"lease_id", lease}}).dump()).status, 204);
  agent.status(wire::DriveState::kFailed, order, 1);
  EXPECT_FALSE(agent.await<wire::MissionOrder>(milliseconds(600)));
  EXPECT_EQ(mission_now(sent.json()).at("state"), "stopped");
}

TEST_F(DrivingTest, DashboardsHearEverythingInOrder) {
  add_robot();
  SocketClient foreign;
  EXPECT_EQ(foreign.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", "http://evil.example"}}),
            403);
  SocketClient nobody;
  EXPECT_EQ(nobody.open(app->port(), "/api/v1/events", {}), 401);
  SocketClient page;
  ASSERT_EQ(
      page.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults.at("Origin")}}),
      101);
  const auto first = page.receive();
  ASSERT_TRUE(first);
  const json snapshot = json::parse(*first);
  EXPECT_EQ(snapshot.at("type"), "snapshot");
  EXPECT_EQ(snapshot.at("robots")[0].at("id"), robot);
  std::int64_t seq = snapshot.at("seq");

  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  agent.hello();
  ASSERT_TRUE(agent.await<wire::Welcome>());
  agent.status(wire::DriveState::kIdle);
  bool idle = false;
  for (int i = 0; i < 20 && !idle; ++i) {
    const auto message = page.receive();
    ASSERT_TRUE(message);
    const json event = json::parse(*message);
    EXPECT_EQ(event.at("seq"), ++seq) << "no gaps";
    idle = event.at("type") == "robot" && event.at("robot").at("online") == true &&
           event.at("robot").at("state") == "idle";
  }
  EXPECT_TRUE(idle);
}

}  // namespace
}  // namespace homeward::server
