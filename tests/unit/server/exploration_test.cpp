// SPDX-License-Identifier: Apache-2.0
#include "server/ws/event_hub.hpp"
#include "support/driving_fixture.hpp"

namespace homeward::server::exploration_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;
using wire::DriveState;
using wire::ExplorationPhase;
using wire::ReasonCode;

wire::ExplorationReport report_of(const ExplorationId& id, ExplorationPhase phase, std::int64_t pictures = 3) {
  wire::ExplorationReport report;
  report.id = id;
  report.phase = phase;
  report.pictures = pictures;
  report.driven_m = 2.5;
  report.pose = Pose2{1.0, 0.5, 0.25};
  report.nodes_m = {{0.0, 0.0}, {1.0, 0.5}};
  return report;
}

/// An order as drives have it, for what the fake agent says of itself.
wire::MissionOrder as_drive(const wire::ExploreOrder& order) {
  wire::MissionOrder drive;
  drive.mission = order.mission;
  drive.order = order.order;
  return drive;
}

/// A robot that maps the building by itself, and a person who may send it. It has no map.
class ExplorationTest : public DrivingTest {
 protected:
  void connect() {
    agent.explores = true;
    agent.while_waiting = [this] { keep_lease(); };
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    agent.hello();
    ASSERT_TRUE(agent.await<wire::Welcome>());
  }
  void be_ready() {
    clock.stand();
    add_robot();
    connect();
    lease = take_lease(*admin);
  }
  Answer send_exploring(const json& more = json::object()) {
    json body = {{"lease_id", lease}};
    body.update(more);
    return admin->post(root + "/explorations", body);
  }
  /// Sends it, and has it take that up.
  void explore(const json& more = json::object()) {
    const Answer sent = send_exploring(more);
    ASSERT_EQ(sent.status, 201) << sent.body;
    mission = sent.json();
    order = agent.await<wire::ExploreOrder>();
    ASSERT_TRUE(order);
    say(DriveState::kDriving);
    ASSERT_EQ(wait_for_state(mission, "driving").at("state"), "driving");
  }
  void say(DriveState state, const std::optional<wire::Reason>& reason = {}) {
    agent.status(state, as_drive(*order), 0, reason);
  }
  /// Whether permits go out now, whatever was sent before.
  bool is_permitted() {
    let_work_off(agent);
    agent.heard_by_now<wire::Welcome>();  // passes over all that has come
    return comes_at_once<wire::Permit>(agent).has_value();
  }
  /// The robot is heard all the time, and the lease is kept.
  void pass(std::chrono::seconds time) {
    constexpr std::chrono::seconds kStep{3};  // a longer silence would be taken for a dead link
    for (std::chrono::seconds left = time; left.count() > 0; left -= kStep) {
      clock.pass(std::min(left, kStep));
      agent.repeat();
      keep_lease();
      let_work_off(agent);
    }
    app->tick();
  }
  void tell(const ExplorationId& id, ExplorationPhase phase, std::int64_t pictures = 3) {
    agent.say(wire::Explored{report_of(id, phase, pictures)});
    let_work_off(agent);
  }
  Answer put_fences(const std::string& with_lease, const json& fences = json::array()) {
    return admin->put(root + "/exploration/fences", {{"lease_id", with_lease}, {"fences", fences}});
  }
  Answer finish(const std::string& with_lease) {
    return admin->post(root + "/exploration/finish", {{"lease_id", with_lease}});
  }

  FakeAgent agent;
  std::string lease;
  json mission;
  std::optional<wire::ExploreOrder> order;
};

TEST_F(ExplorationTest, TakesAnInstallerWithTheLeaseAndARobotThatCan) {
  clock.stand();
  add_robot();
  testing::HttpClient rider = signed_in("rita", "rider");
  EXPECT_EQ(send_exploring({{"lease_id", "x"}}).code(), "lease_held");
  lease = take_lease(*admin);
  EXPECT_EQ(rider.post(root + "/explorations", {{"lease_id", lease}}).status, 403);
  EXPECT_EQ(send_exploring().code(), "robot_offline");
  EXPECT_EQ(admin->post("/api/v1/robots/none/explorations", {{"lease_id", lease}}).status, 404);
  agent.while_waiting = [this] { keep_lease(); };
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  agent.hello();
  ASSERT_TRUE(agent.await<wire::Welcome>());
  const Answer cannot = send_exploring();
  EXPECT_EQ(cannot.status, 409);
  EXPECT_EQ(cannot.code(), "conflict");
  EXPECT_NE(cannot.json().at("detail").get<std::string>().find("--explorations"), std::string::npos) << cannot.body;
  EXPECT_FALSE(comes_at_once<wire::ExploreOrder>(agent));
  EXPECT_EQ(admin->get(root + "/missions").json().at("missions"), json::array()) << "nothing was begun";
}

TEST_F(ExplorationTest, BodiesAreReadStrictly) {
  be_ready();
  for (const json& more : {json{{"limit_m", 0.5}}, json{{"limit_s", 9}}, json{{"back_after_s", "soon"}},
                           json{{"exploration", ""}}, json{{"map", "m"}}}) {
    EXPECT_EQ(send_exploring(more).status, 422) << more.dump();
  }
  EXPECT_EQ(admin->post(root + "/explorations", json::object()).status, 422);
  EXPECT_EQ(put_fences(lease, {{{0, 0}, {1, 1}}}).status, 422) << "two corners are no fence";
  EXPECT_EQ(admin->put(root + "/exploration/fences", {{"lease_id", lease}}).status, 422);
  EXPECT_EQ(admin->post(root + "/exploration/finish", {{"lease_id", lease}, {"at", "once"}}).status, 422);
}

TEST_F(ExplorationTest, TheRobotGetsAnOrderAndPermitsWhileItExplores) {
  be_ready();
  const Answer sent = send_exploring({{"limit_m", 300.0}, {"limit_s", 1200}});
  ASSERT_EQ(sent.status, 201) << sent.body;
  mission = sent.json();
  EXPECT_EQ(mission.at("kind"), "explore");
  EXPECT_EQ(mission.at("by"), "anna");
  order = agent.await<wire::ExploreOrder>();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->mission.str(), mission.at("id"));
  EXPECT_EQ(order->exploration.str(), mission.at("exploration"));
  EXPECT_FALSE(order->goes_on);
  EXPECT_EQ(order->limit_m, 300.0);
  EXPECT_EQ(order->limit_s, 1200.0);
  EXPECT_EQ(order->back_after_s, std::nullopt);
  EXPECT_GT(order->speed_limit_mps, 0.0);
  const auto permit = comes_at_once<wire::Permit>(agent);
  ASSERT_TRUE(permit);
  EXPECT_EQ(permit->mission, order->mission);
  EXPECT_GT(permit->order.seq, order->order.seq);
  say(DriveState::kDriving);
  EXPECT_EQ(wait_for_state(mission, "driving").at("state"), "driving");
  EXPECT_TRUE(is_permitted());
  const json listed = admin->get(root + "/missions").json().at("missions").at(0);
  EXPECT_EQ(listed.at("kind"), "explore");
  EXPECT_EQ(listed.at("exploration"), mission.at("exploration"));
  EXPECT_TRUE(listed.at("map").is_null());
  EXPECT_TRUE(listed.at("place").is_null());
  EXPECT_EQ(listed.at("path"), json::array());
}

TEST_F(ExplorationTest, ARobotMayReadForThreeMinutesBeforeItSetsOff) {
  be_ready();
  const Answer sent = send_exploring();
  ASSERT_EQ(sent.status, 201) << sent.body;
  ASSERT_TRUE(agent.await<wire::ExploreOrder>());
  pass(std::chrono::seconds(179));
  EXPECT_TRUE(is_permitted());
  EXPECT_TRUE(comes_within<wire::StopOrder>(agent, std::chrono::seconds(2)));
  EXPECT_EQ(mission_now(sent.json()).at("reason").at("code"), "not_taken_up");
}

TEST_F(ExplorationTest, WhatTheRobotTellsComesToWhoAsksAndToDashboards) {
  be_ready();
  EXPECT_EQ(admin->get(root + "/exploration").status, 404);
  testing::SocketClient page;
  ASSERT_EQ(
      page.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults.at("Origin")}}),
      101);
  explore();
  tell(order->exploration, ExplorationPhase::kExploring, 7);
  testing::HttpClient viewer = signed_in("vera", "viewer");
  const Answer asked = viewer.get(root + "/exploration");
  ASSERT_EQ(asked.status, 200) << asked.body;
  EXPECT_EQ(asked.json(), wire::exploration_to_json(report_of(order->exploration, ExplorationPhase::kExploring, 7)));
  json told;
  EXPECT_TRUE(page.take_in_all());
  while (const auto message = page.receive(milliseconds(1))) {
    json event = json::parse(*message);
    if (event.at("type") == "exploration") told = std::move(event);
  }
  EXPECT_EQ(told.value("robot", ""), robot) << told.dump();
  EXPECT_EQ(told.at("exploration"), asked.json());
  EXPECT_EQ(admin->get("/api/v1/robots/none/exploration").status, 404);
  agent.socket.cut();
  wait_for_state(mission, "stopped");
  EXPECT_EQ(admin->get(root + "/exploration").status, 404) << "it is not known of a robot that is gone";
}

TEST_F(ExplorationTest, AStopPausesItAndItGoesOnAsTheSame) {
  be_ready();
  explore();
  const ExplorationId id = order->exploration;
  tell(id, ExplorationPhase::kExploring);
  EXPECT_EQ(finish(lease).code(), "conflict") << "it explores just now";
  EXPECT_EQ(signed_in("vera", "viewer").post(root + "/stop").status, 202);
  EXPECT_TRUE(agent.await<wire::StopOrder>());
  const json stopped = wait_for_state(mission, "stopped");
  EXPECT_EQ(stopped.at("reason").at("code"), "stopped_by");
  EXPECT_FALSE(is_permitted());
  tell(id, ExplorationPhase::kPaused);
  EXPECT_EQ(send_exploring({{"exploration", "another"}}).code(), "conflict");
  const std::string first = mission.at("id");
  explore({{"exploration", id.str()}, {"back_after_s", 600}});
  EXPECT_NE(mission.at("id"), first);
  EXPECT_EQ(mission.at("exploration"), id.str());
  EXPECT_TRUE(order->goes_on);
  EXPECT_EQ(order->exploration, id);
  EXPECT_EQ(order->back_after_s, 600.0);
  EXPECT_TRUE(is_permitted());
  say(DriveState::kArrived);
  wait_for_state(mission, "arrived");
  for (const ExplorationPhase phase : {ExplorationPhase::kEnded, ExplorationPhase::kUploaded}) {
    tell(id, phase);
    EXPECT_EQ(send_exploring({{"exploration", id.str()}}).code(), "conflict") << "it is over";
  }
}

TEST_F(ExplorationTest, FencesAndTheEndReachTheRobot) {
  be_ready();
  EXPECT_EQ(put_fences(lease).status, 404) << "it has told of no exploration";
  EXPECT_EQ(finish(lease).status, 404);
  explore();
  tell(order->exploration, ExplorationPhase::kExploring);
  EXPECT_EQ(put_fences("x").code(), "lease_held");
  EXPECT_EQ(finish("x").code(), "lease_held");
  const Answer put = put_fences(lease, {{{0, 0}, {2, 0}, {2, 1.5}}});
  EXPECT_EQ(put.status, 202) << put.body;
  const auto fences = agent.await<wire::Fences>();
  ASSERT_TRUE(fences);
  EXPECT_EQ(fences->exploration, order->exploration);
  ASSERT_EQ(fences->fences_m.size(), 1U);
  EXPECT_EQ(fences->fences_m[0].back(), Eigen::Vector2d(2.0, 1.5));
  say(DriveState::kStopped);
  wait_for_state(mission, "stopped");
  tell(order->exploration, ExplorationPhase::kPaused);
  EXPECT_EQ(put_fences(lease).status, 202);
  EXPECT_TRUE(agent.await<wire::Fences>().value().fences_m.empty()) << "those of a paused one as well";
  EXPECT_EQ(finish(lease).status, 202);
  const auto finished = agent.await<wire::Finish>();
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->exploration, order->exploration);
}

TEST_F(ExplorationTest, OneThatFailsHasFailed) {
  be_ready();
  for (const bool lifted : {false, true}) {
    explore();
    agent.displaced += lifted ? 1 : 0;
    say(DriveState::kFailed, wire::Reason{ReasonCode::kExplorationStuck});
    const json failed = wait_for_state(mission, "failed");
    EXPECT_EQ(failed.at("state"), "failed");
    EXPECT_EQ(failed.at("reason").at("code"), "exploration_stuck");
    EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(600)));
    EXPECT_FALSE(is_permitted());
  }
}

TEST_F(ExplorationTest, OneThatIsDoneHasArrivedWithWhatIsLeftToSay) {
  be_ready();
  explore();
  say(DriveState::kArrived, wire::Reason{ReasonCode::kExplorationLimit});
  const json arrived = wait_for_state(mission, "arrived");
  EXPECT_EQ(arrived.at("state"), "arrived");
  EXPECT_EQ(arrived.at("reason").at("code"), "exploration_limit");
  EXPECT_FALSE(is_permitted());
}

TEST_F(ExplorationTest, ARobotMayRefuseIt) {
  be_ready();
  const Answer sent = send_exploring();
  order = agent.await<wire::ExploreOrder>();
  ASSERT_TRUE(order);
  agent.say(wire::MissionRefused{order->mission, order->order, wire::Reason{ReasonCode::kRobotMovedSince}});
  EXPECT_EQ(wait_for_state(sent.json(), "refused").at("reason").at("code"), "robot_moved_since");
}

TEST_F(ExplorationTest, ItStopsWhenNobodyWatchesAndWhenItsTimeIsOver) {
  be_ready();
  explore();
  admins_lease.clear();  // its page is closed
  EXPECT_TRUE(comes_within<wire::StopOrder>(agent, std::chrono::seconds(12)));
  EXPECT_EQ(mission_now(mission).at("reason").at("code"), "nobody_watching");
  lease = take_lease(*admin);
  explore({{"limit_s", 10}});
  pass(std::chrono::seconds(608));
  EXPECT_TRUE(is_permitted()) << "it may need a while to come home";
  EXPECT_TRUE(comes_within<wire::StopOrder>(agent, std::chrono::seconds(4)));
  EXPECT_EQ(mission_now(mission).at("reason").at("code"), "too_long");
}

TEST_F(ExplorationTest, PicturesOfOneThatExploresAreKeptForPeopleAlone) {
  add_robot();
  put_on_map();
  agent.explores = true;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  explore();
  EXPECT_EQ(wait_for_state(sent.json(), "stopped").at("reason").at("code"), "another_mission");
  agent.look(2);
  EXPECT_FALSE(comes_at_once<wire::BeliefReport>(agent));
  EXPECT_TRUE(admin->get(root).json().at("belief").is_null());
  EXPECT_EQ(admin->get(root + "/frame").body, testing::room_picture(2, static_cast<unsigned>(agent.frame_seq) + 1000U));
  EXPECT_EQ(send_home(lease).code(), "lost") << "where it is on its map nobody knows now";
  EXPECT_EQ(mission_now(mission).at("state"), "driving") << "and it explores on";
  say(DriveState::kArrived);
  wait_for_state(mission, "arrived");
  agent.look(1);
  EXPECT_TRUE(comes_at_once<wire::BeliefReport>(agent)) << "now it is looked for again";
}

TEST(ExplorationEvents, ASlowReaderGetsTheNewestOfEachRobot) {
  EventHub events;
  const auto page = events.subscribe([] { return wire::Snapshot{}; });
  for (const std::int64_t pictures : {1, 2, 3}) {
    for (const char* robot : {"a", "b"}) {
      events.publish(
          wire::ExplorationView{RobotId(robot), std::make_shared<const wire::ExplorationReport>(report_of(
                                                    ExplorationId("e"), ExplorationPhase::kExploring, pictures))});
    }
  }
  const auto next = [&] { return json::parse(*page->next_message().value().bytes); };
  EXPECT_EQ(next().at("type"), "snapshot");
  for (const char* robot : {"a", "b"}) {
    const json told = next();
    EXPECT_EQ(told.at("robot"), robot);
    EXPECT_EQ(told.at("exploration").at("pictures"), 3);
  }
  EXPECT_FALSE(page->next_message());
}

}  // namespace
}  // namespace homeward::server::exploration_test
