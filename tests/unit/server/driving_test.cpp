// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "support/driving_fixture.hpp"

namespace homeward::server::driving_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;
using testing::SocketClient;

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
  EXPECT_FALSE(agent.await<wire::Welcome>()) << "until the server closes";
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
  ASSERT_TRUE(order->surroundings) << "the robot is told where the places of its path lie";
  EXPECT_EQ(order->surroundings->path.size(), order->path.size());
  wire::Order newest = order->order;
  EXPECT_TRUE(sent.json().at("arrival_probability").is_null());
  agent.arrival_probability = 0.125;
  for (int i = 0; i < 5; ++i) {
    agent.status(wire::DriveState::kDriving, order, 1);
    const auto permit = agent.await<wire::Permit>(std::chrono::milliseconds(2000));
    ASSERT_TRUE(permit);
    EXPECT_EQ(permit->mission, order->mission);
    EXPECT_GT(permit->order, newest) << "each permit is newer";
    newest = permit->order;
  }
  const json under_way = wait_for_state(sent.json(), "driving");
  EXPECT_EQ(under_way.at("path_index"), 1);
  EXPECT_EQ(under_way.at("arrival_probability"), 0.125);
  agent.arrival_probability = 0.96875;
  agent.status(wire::DriveState::kArrived, order, 2, wire::Reason{wire::ReasonCode::kHeadingNotTaken});
  const nlohmann::json arrived = wait_for_state(sent.json(), "arrived");
  EXPECT_EQ(arrived.at("state"), "arrived");
  EXPECT_EQ(arrived.at("reason").at("code"), "heading_not_taken");
  EXPECT_EQ(arrived.at("arrival_probability"), 0.96875);
  while (agent.heard_by_now<wire::Permit>()) {
  }
  EXPECT_FALSE(comes_within<wire::Permit>(agent, milliseconds(400))) << "no permits after the end";
  EXPECT_EQ(admin->get(root + "/missions").json().at("missions").size(), 1U);
  restart();
  EXPECT_EQ(mission_now(sent.json()).at("arrival_probability"), 0.96875) << "of the arrival, for good";
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
  const auto stop_order = agent.await<wire::StopOrder>();
  ASSERT_TRUE(stop_order);
  EXPECT_LT(steady_clock::now() - asked, milliseconds(1000));
  EXPECT_EQ(stop_order->stop_id, stop.json().at("stop_id"));
  EXPECT_EQ(stop_order->by, "vera");
  EXPECT_EQ(stop_order->epoch, order->order.epoch);
  EXPECT_GT(stop_order->seq, order->order.seq) << "what it overtakes is void";
  EXPECT_EQ(mission_now(mission).at("state"), "stopped");
  EXPECT_EQ(mission_now(mission).at("reason"), (json{{"code", "text"}, {"parameters", {{"text", "a cat"}}}}));

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
  EXPECT_FALSE(comes_within<wire::MissionOrder>(reborn, milliseconds(400))) << "nothing moves before a person says so";
}

TEST_F(DrivingTest, AFailedWayIsDrivenRoundWithoutAnotherTriedOnceMoreAndThenTheMissionFails) {
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
  ASSERT_TRUE(second->surroundings) << "on the other way as well";
  EXPECT_EQ(second->surroundings->path.size(), second->path.size());
  std::set<PlaceId> known;
  for (const wire::PathPlace& place : second->path) known.insert(place.place);
  for (const wire::PlacedView& view : second->surroundings->nearby) {
    EXPECT_TRUE(known.insert(view.place).second) << view.place.str() << " is told of twice";
  }
  EXPECT_TRUE(known.contains(first->path[1].place)) << "what the first way led over lies beside it or looks alike";
  json now = mission_now(sent.json());
  EXPECT_EQ(now.at("state"), "accepted");
  EXPECT_EQ(now.at("seq"), second->order.seq);
  EXPECT_EQ(now.at("path").size(), second->path.size());
  EXPECT_EQ(now.at("reason").at("code"), "takes_another_way") << now.dump();

  // What it still tells of the first way changes nothing.
  agent.status(wire::DriveState::kFailed, first, 1);
  agent.status(wire::DriveState::kDriving, second, 1);
  EXPECT_EQ(wait_for_state(sent.json(), "driving").at("state"), "driving");
  EXPECT_TRUE(comes_at_once<wire::Permit>(agent));
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.status(wire::DriveState::kFailed, second, 1);
  const auto third = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(third) << mission_now(sent.json()).dump();
  EXPECT_GT(third->order, second->order);
  now = mission_now(sent.json());
  EXPECT_EQ(now.at("reason").at("code"), "tries_once_more") << now.dump();
  agent.status(wire::DriveState::kDriving, third, 1);
  wait_for_state(sent.json(), "driving");
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.status(wire::DriveState::kFailed, third, 1);
  now = wait_for_state(sent.json(), "failed");
  EXPECT_EQ(now.at("state"), "failed");
  EXPECT_EQ(now.at("reason").at("code"), "no_way_on") << now.dump();
  const json trouble = now.at("reason").at("parameters").at("trouble");
  EXPECT_EQ(trouble.at("code"), "no_way");
  EXPECT_NE(trouble.dump().find("obstacle_closed"), std::string::npos) << trouble.dump();
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(400)));
}

TEST_F(DrivingTest, ARobotThatWentAstrayIsSentOnOverTheWayThatNothingIsWrongWith) {
  add_robot();
  put_on_map();
  add_second_way();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  ASSERT_EQ(sent.status, 201) << sent.body;
  auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  const PlaceId over = order->path[1].place;
  for (int restart = 0; restart < 4; ++restart) {  // a blocked way is gone round three times
    agent.astray = false;
    agent.status(wire::DriveState::kDriving, order, 1);
    wait_for_state(sent.json(), "driving");
    agent.look(1);
    ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
    agent.astray = true;
    agent.status(wire::DriveState::kFailed, order, 1, wire::Reason{wire::ReasonCode::kOffTheWay});
    order = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(order) << restart << mission_now(sent.json()).dump();
    EXPECT_EQ(order->path[1].place, over) << "no part of the way is to blame";
    const json reason = mission_now(sent.json()).at("reason");
    EXPECT_EQ(reason.at("code"), "goes_on_from_there") << reason.dump();
    EXPECT_EQ(reason.at("parameters").at("because").at("code"), "off_the_way");
  }
}

TEST_F(DrivingTest, ARobotThatIsNotSureOfItsDestinationLooksAroundAndComesBack) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  const PlaceId there = order->path.back().place;
  agent.estimate = wire::EstimateReport{there, 0.9};
  agent.possible_places = {*agent.estimate, {order->path.front().place, 0.1}};
  const auto give_up = [&] {
    const auto last = static_cast<std::int64_t>(order->path.size()) - 1;
    agent.astray = false;
    agent.status(wire::DriveState::kDriving, order, last);
    wait_for_state(sent.json(), "driving");
    agent.astray = true;
    agent.status(wire::DriveState::kFailed, order, last,
                 wire::Reason{wire::ReasonCode::kDestinationUnsure, {{"destination", "the room"}}});
  };
  for (int look = 0; look < 3; ++look) {
    give_up();
    order = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(order) << look << mission_now(sent.json()).dump();
    ASSERT_GE(order->path.size(), 3U);
    EXPECT_EQ(order->path.front().place, there);
    EXPECT_EQ(order->path.back().place, there);
    EXPECT_TRUE(order->dock) << "it is the destination's own picture that it comes back to";
    const json reason = mission_now(sent.json()).at("reason");
    EXPECT_EQ(reason.at("code"), "looks_around_and_comes_back") << reason.dump();
  }
  give_up();
  const json now = wait_for_state(sent.json(), "failed");
  EXPECT_EQ(now.at("reason").at("code"), "destination_unsure");
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(400)));
}

TEST_F(DrivingTest, ARobotThatIsLostGoesOnFromWhereItIsLikeliest) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  ASSERT_GE(order->path.size(), 2U);
  const PlaceId second = order->path[1].place;
  for (unsigned look = 0; look < 12; ++look) {  // until the belief is lost as well
    agent.look(60 + look);
    const auto belief = agent.await<wire::BeliefReport>(milliseconds(60'000));
    ASSERT_TRUE(belief);
    if (belief->lost) break;
  }
  agent.status(wire::DriveState::kDriving, order, 0);
  wait_for_state(sent.json(), "driving");
  agent.possible_places = {{second, 0.4}, {order->path.front().place, 0.3}};
  agent.astray = true;
  agent.status(wire::DriveState::kFailed, order, 0, wire::Reason{wire::ReasonCode::kPlaceUnsure});
  order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order) << mission_now(sent.json()).dump();
  EXPECT_EQ(order->path.front().place, second);
  ASSERT_TRUE(order->surroundings);
  EXPECT_DOUBLE_EQ(order->surroundings->start_probability, 0.4);
}

TEST_F(DrivingTest, TheBeliefHearsWhereTheRobotThatDrivesTakesItselfToBe) {
  add_robot();
  put_on_map();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  const PlaceId there = order->path.back().place;
  // Of a room that the map does not know the belief says lost, unless the robot knows better.
  const auto believed_after = [&](wire::DriveState state, unsigned looks, bool until_sure) {
    agent.estimate = wire::EstimateReport{there, 0.95};
    agent.status(state, order, 1);
    std::optional<wire::BeliefReport> belief;
    for (unsigned look = 0; look < looks; ++look) {
      agent.look(60 + look);
      belief = agent.await<wire::BeliefReport>(milliseconds(60'000));
      if (!belief || (until_sure && !belief->lost)) break;
    }
    return belief;
  };
  const auto idle = believed_after(wire::DriveState::kIdle, 4, false);
  ASSERT_TRUE(idle);
  EXPECT_TRUE(idle->lost);
  const auto driving = believed_after(wire::DriveState::kDriving, 20, true);
  ASSERT_TRUE(driving);
  EXPECT_FALSE(driving->lost);
  EXPECT_EQ(driving->place, there);
}

TEST_F(DrivingTest, AMissionThatLastsTooLongIsStopped) {
  add_robot();
  put_on_map();
  app.reset();
  config.longest_mission_s = 2;
  start();
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
  const std::string lease = take_lease(*admin);
  find_itself(agent);
  const Answer sent = send_home(lease);
  const auto order = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(order);
  agent.status(wire::DriveState::kDriving, order, 1);
  wait_for_state(sent.json(), "driving");
  EXPECT_FALSE(comes_within<wire::StopOrder>(agent, std::chrono::seconds(config.longest_mission_s)));
  ASSERT_TRUE(comes_within<wire::StopOrder>(agent, milliseconds(100)));
  EXPECT_EQ(mission_now(sent.json()).at("reason").at("code"), "too_long");
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
}  // namespace homeward::server::driving_test
