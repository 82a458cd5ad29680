// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "server/driving/agent_link.hpp"
#include "support/driving_fixture.hpp"

namespace homeward::server::companions_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;
using wire::ExplorationPhase;

wire::CompanionView view_of(const std::string& exploration, std::int64_t index = 0, std::size_t bytes = 40) {
  wire::CompanionView view;
  view.exploration = ExplorationId(exploration);
  view.index = index;
  view.view.t_us = 17;
  view.view.odometry = Pose2{1.0, 2.0, 0.5};
  view.view.sweep.ranges_m = {1.0F, 2.0F, 3.0F};
  view.view.sweep.angle_step_rad = 0.1;
  view.view.driven_m = 4.0;
  view.view.explored_s = 9.0;
  view.appearance = std::vector<std::uint8_t>(bytes, 7);
  return view;
}

wire::CompanionState state_of(const std::string& exploration, std::int64_t has = 0) {
  wire::CompanionState state;
  state.exploration = ExplorationId(exploration);
  state.pictures = 5;
  state.odometry = Pose2{0.5, -0.5, 1.0};
  state.target_m = Eigen::Vector2d(2.0, 3.0);
  state.drives = true;
  state.has = has;
  return state;
}

/// One of the robots of the house, and the program on it.
struct Party {
  explicit Party(std::string called) : name(std::move(called)) {}
  std::string name;
  std::string id, token, root, lease;
  std::unique_ptr<FakeAgent> agent;
};

/// Three connected robots. What they tell of: chair of the exploration "x1", bruno of "x2", carla of "x3".
class CompanionsTest : public DrivingTest {
 protected:
  void SetUp() override {
    DrivingTest::SetUp();
    clock.stand();
    for (Party* one : {&chair, &bruno, &carla}) {
      const json made = admin->post("/api/v1/robots", {{"name", one->name}}).json();
      one->id = made.at("id");
      one->token = made.at("token");
      one->root = root = "/api/v1/robots/" + one->id;
      one->lease = take_lease(*admin);
      connect(*one);
    }
    root = chair.root;
    admins_lease = chair.lease;
  }
  void connect(Party& party) {
    party.agent = std::make_unique<FakeAgent>();
    party.agent->explores = true;
    ASSERT_EQ(party.agent->connect(app->port(), party.id, party.token), 101);
    party.agent->hello();
    ASSERT_TRUE(party.agent->await<wire::Welcome>());
  }
  void tell(Party& party, const std::string& exploration, const std::optional<std::string>& with = {},
            ExplorationPhase phase = ExplorationPhase::kPaused) {
    wire::ExplorationReport report;
    report.id = ExplorationId(exploration);
    report.phase = phase;
    if (with) report.companion = wire::SharedExploration{ExplorationId(*with), false, 0};
    party.agent->say(wire::Explored{report});
    let_work_off(*party.agent);
  }
  void share_with_each_other() {
    tell(chair, "x1", "x2");
    tell(bruno, "x2", "x1");
  }
  Answer put(const Party& party, const json& body) { return admin->put(party.root + "/exploration/companion", body); }
  Answer share(const Party& party, const json& with) {
    return put(party, {{"lease_id", party.lease}, {"robot", with}});
  }
  /// No robot falls silent meanwhile, as long as that is not more than 3 s.
  void pass(milliseconds time) {
    clock.pass(time);
    for (Party* one : {&chair, &bruno, &carla}) {
      one->agent->repeat();
      if (!one->agent->socket.closed()) let_work_off(*one->agent);
    }
  }
  /// What one says, and what of it the other has heard when all is worked off.
  template <class T>
  std::optional<T> heard(Party& from, const T& message, Party& by) {
    from.agent->say(message);
    let_work_off(*from.agent);
    pass(std::chrono::seconds(1));  // views may have to wait
    return comes_at_once<T>(*by.agent);
  }

  Party chair{"chair"}, bruno{"bruno"}, carla{"carla"};
};

TEST_F(CompanionsTest, TheRobotIsToldWithWhoseExplorationItsOwnIsShared) {
  tell(chair, "x1");
  tell(bruno, "x2", {}, ExplorationPhase::kExploring);
  const Answer sent = share(chair, bruno.id);
  EXPECT_EQ(sent.status, 202) << sent.body;
  const auto told = comes_at_once<wire::Companion>(*chair.agent);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->exploration.str(), "x1");
  EXPECT_EQ(told->with, ExplorationId("x2"));
  EXPECT_FALSE(comes_at_once<wire::Companion>(*bruno.agent)) << "that is for who drives it to say";
  EXPECT_EQ(share(chair, nullptr).status, 202);
  const auto parted = comes_at_once<wire::Companion>(*chair.agent);
  ASSERT_TRUE(parted);
  EXPECT_EQ(parted->exploration.str(), "x1");
  EXPECT_EQ(parted->with, std::nullopt);
}

TEST_F(CompanionsTest, TakesAnInstallerWithTheLeaseAndTwoExplorationsThatGoOn) {
  EXPECT_EQ(share(chair, bruno.id).code(), "conflict") << "neither has told of one";
  tell(chair, "x1");
  const Answer none = share(chair, bruno.id);
  EXPECT_EQ(none.status, 409);
  EXPECT_EQ(none.json().at("where"), "robots/" + bruno.id + "/exploration");
  EXPECT_EQ(share(bruno, chair.id).json().at("where"), "robots/" + bruno.id + "/exploration");
  EXPECT_EQ(share(bruno, nullptr).code(), "conflict");
  for (const ExplorationPhase over : {ExplorationPhase::kEnded, ExplorationPhase::kUploaded}) {
    tell(bruno, "x2", {}, over);
    EXPECT_EQ(share(chair, bruno.id).code(), "conflict");
    EXPECT_EQ(share(bruno, chair.id).code(), "conflict");
  }
  tell(bruno, "x2");
  EXPECT_EQ(signed_in("rita", "rider").put(chair.root + "/exploration/companion", json::object()).status, 403);
  EXPECT_EQ(put(chair, {{"lease_id", "x"}, {"robot", bruno.id}}).code(), "lease_held");
  const Answer itself = share(chair, chair.id);
  EXPECT_EQ(itself.status, 422);
  EXPECT_EQ(itself.json().at("where"), "body/robot");
  EXPECT_EQ(share(chair, "none").status, 404);
  EXPECT_EQ(
      admin->put("/api/v1/robots/none/exploration/companion", {{"lease_id", chair.lease}, {"robot", nullptr}}).status,
      404);
  for (const json& body : {json{{"lease_id", chair.lease}}, json{{"lease_id", chair.lease}, {"robot", ""}},
                           json{{"lease_id", chair.lease}, {"robot", 2}}, json{{"robot", bruno.id}},
                           json{{"lease_id", chair.lease}, {"robot", bruno.id}, {"exploration", "x2"}}}) {
    EXPECT_EQ(put(chair, body).status, 422) << body.dump();
  }
  EXPECT_FALSE(comes_at_once<wire::Companion>(*chair.agent)) << "nothing of that reached it";
}

TEST_F(CompanionsTest, OneThatIsGoneOrHasSetOutAnewHasNothingToShareYet) {
  tell(chair, "x1");
  tell(bruno, "x2");
  const Answer sent = admin->post(bruno.root + "/explorations", {{"lease_id", bruno.lease}});
  ASSERT_EQ(sent.status, 201) << sent.body;
  EXPECT_EQ(share(chair, bruno.id).code(), "conflict") << "it has told of the one before alone";
  const std::string now = sent.json().at("exploration");
  tell(bruno, now, {}, ExplorationPhase::kExploring);
  EXPECT_EQ(share(chair, bruno.id).status, 202);
  EXPECT_EQ(comes_at_once<wire::Companion>(*chair.agent).value().with, ExplorationId(now));
  bruno.agent->socket.cut();
  while (admin->get(bruno.root).json().at("online")) app->work_off();
  EXPECT_EQ(share(chair, bruno.id).code(), "conflict");
  EXPECT_EQ(share(bruno, chair.id).code(), "robot_offline");
}

TEST_F(CompanionsTest, WhatTwoThatNameEachOtherSayIsRelayedAsItIs) {
  share_with_each_other();
  const wire::CompanionView view = view_of("x1", 3);
  const auto relayed = heard(chair, view, bruno);
  ASSERT_TRUE(relayed);
  EXPECT_EQ(wire::to_json(wire::ServerMessage(*relayed)), wire::to_json(wire::AgentMessage(view)));
  const wire::CompanionState state = state_of("x2", 4);
  const auto answered = heard(bruno, state, chair);
  ASSERT_TRUE(answered);
  EXPECT_EQ(wire::to_json(wire::ServerMessage(*answered)), wire::to_json(wire::AgentMessage(state)));
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*carla.agent));
  EXPECT_FALSE(comes_at_once<wire::CompanionState>(*carla.agent));
}

TEST_F(CompanionsTest, NothingIsRelayedWhereOneOfThemNamesNobodyOrAnother) {
  tell(chair, "x1", "x2");
  tell(carla, "x3", "x2");
  for (const auto& with : {std::optional<std::string>{}, std::optional<std::string>{"x3"}}) {
    tell(bruno, "x2", with);
    EXPECT_FALSE(heard(chair, view_of("x1"), bruno));
    EXPECT_FALSE(heard(chair, state_of("x1"), bruno));
    EXPECT_FALSE(heard(bruno, state_of("x2"), chair));
  }
  EXPECT_TRUE(heard(bruno, state_of("x2"), carla)) << "these two name each other";
  tell(chair, "x1");
  tell(bruno, "x2", "x1");
  EXPECT_FALSE(heard(chair, view_of("x1"), bruno)) << "nor has chair anything to do with it any more";
  EXPECT_FALSE(heard(bruno, view_of("x2"), chair));
}

TEST_F(CompanionsTest, NobodySpeaksForAnExplorationThatIsNotItsOwn) {
  share_with_each_other();
  for (const char* other : {"x2", "x3", "x0"}) {
    EXPECT_FALSE(heard(carla, state_of(other), bruno)) << other;
    EXPECT_FALSE(heard(chair, state_of(other), bruno)) << other;
  }
  tell(bruno, "x2", "x3");
  EXPECT_FALSE(heard(chair, state_of("x3"), bruno)) << "not even where that is what the other waits for";
  tell(bruno, "x2", "x1");
  tell(chair, "x4");  // begun anew
  EXPECT_FALSE(heard(chair, state_of("x4"), bruno));
  EXPECT_FALSE(heard(chair, state_of("x1"), bruno));
  EXPECT_FALSE(heard(bruno, state_of("x2"), chair));
}

TEST_F(CompanionsTest, OfTwoRobotsThatTellOfOneExplorationNeitherIsBelieved) {
  share_with_each_other();
  ASSERT_TRUE(heard(chair, state_of("x1"), bruno));
  tell(carla, "x2", "x1");
  EXPECT_FALSE(heard(carla, state_of("x2"), chair));
  EXPECT_FALSE(heard(bruno, state_of("x2"), chair));
  EXPECT_FALSE(heard(chair, view_of("x1"), bruno));
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*carla.agent));
  tell(carla, "x3");
  EXPECT_TRUE(heard(bruno, state_of("x2"), chair));
  EXPECT_TRUE(heard(chair, view_of("x1"), bruno));
}

TEST_F(CompanionsTest, OneThatWasAwayIsHeardAgainOnceItHasSaidWhatItHas) {
  share_with_each_other();
  ASSERT_TRUE(heard(chair, state_of("x1"), bruno));
  bruno.agent->socket.cut();
  while (admin->get(bruno.root).json().at("online")) app->work_off();
  chair.agent->say(view_of("x1"));
  let_work_off(*chair.agent);
  connect(bruno);
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*bruno.agent)) << "that is lost; it is told again";
  EXPECT_FALSE(heard(chair, state_of("x1"), bruno));
  EXPECT_FALSE(heard(bruno, state_of("x2"), chair));
  tell(bruno, "x2", "x1");
  EXPECT_TRUE(heard(chair, view_of("x1"), bruno));
  EXPECT_TRUE(heard(bruno, state_of("x2"), chair));
}

TEST_F(CompanionsTest, ViewsThatComeTooFastFollowAsTimePasses) {
  share_with_each_other();
  for (std::int64_t index : {0, 1}) chair.agent->say(view_of("x1", index, RelayQueue::kPerSecond_bytes / 2));
  let_work_off(*chair.agent);
  EXPECT_EQ(comes_at_once<wire::CompanionView>(*bruno.agent).value().index, 0);
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*bruno.agent));
  pass(milliseconds(600));
  EXPECT_EQ(comes_at_once<wire::CompanionView>(*bruno.agent).value().index, 1);
}

TEST_F(CompanionsTest, WhatStillWaitsIsForgottenWhenTheReceiverNamesItNoMore) {
  share_with_each_other();
  for (std::int64_t index : {0, 1}) chair.agent->say(view_of("x1", index, RelayQueue::kPerSecond_bytes / 2));
  let_work_off(*chair.agent);
  EXPECT_TRUE(comes_at_once<wire::CompanionView>(*bruno.agent));
  tell(bruno, "x2");
  pass(std::chrono::seconds(2));
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*bruno.agent));
}

TEST_F(CompanionsTest, AViewThatIsTooLargeEndsTheLinkOfWhoSentItAndReachesNobody) {
  share_with_each_other();
  EXPECT_FALSE(heard(chair, view_of("x1", 0, RelayQueue::kMostView_bytes), bruno)) << "one that keeps a stop waiting";
  EXPECT_FALSE(heard(chair, view_of("x1", 0, wire::kMostCompanionBytes), bruno));
  EXPECT_TRUE(heard(chair, view_of("x1", 0, RelayQueue::kMostView_bytes / 2), bruno));
  chair.agent->say(view_of("x1", 1, wire::kMostCompanionBytes + 1));
  const auto refused = chair.agent->await<wire::LinkError>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, "invalid_input");
  for (int i = 0; i < 10; ++i) pass(std::chrono::seconds(1));
  EXPECT_FALSE(comes_at_once<wire::CompanionView>(*bruno.agent));
}

/// The near end of a socket whose other end takes what the test lets it take.
class SlowSocket : public Socket {
 public:
  void wake() override {}
  void close(std::uint16_t, const std::string&) override { closed = true; }
  bool closed = false;
};

class NoListener : public LinkListener {
 public:
  void received(const std::shared_ptr<AgentLink>&, wire::AgentMessage) override {}
  void closed(const std::shared_ptr<AgentLink>&) override {}
};

std::string type_of(const std::optional<Outgoing>& outgoing) {
  if (!outgoing) return "nothing";
  return json::from_cbor(*outgoing->bytes).at("type");
}

TEST(RelayedMessages, AStopAndPermitsOvertakeThemAndASlowRobotKeepsLittleWaiting) {
  testing::MovedClock clock;
  clock.stand();
  NoListener listener;
  const auto link = std::make_shared<AgentLink>(listener, RobotId("r"), clock);
  const auto socket = std::make_shared<SlowSocket>();
  link->on_open(socket);
  for (std::int64_t index = 0; index < 1000; ++index) {
    link->relay(view_of("x1", index));
    link->relay(state_of("x1", index));
  }
  EXPECT_FALSE(socket->closed) << "the other robot does not end this one's link";
  link->send(wire::Permit{MissionId("m"), {1, 1}, 500});
  link->send(wire::StopOrder{"s", 1, {}, "anna"}, true);
  for (const char* type : {"stop", "permit", "companion_state", "companion_view"}) {
    EXPECT_EQ(type_of(link->next_message()), type);
  }
  std::size_t views = 1;
  for (int second = 0; second < 100; ++second) {
    clock.pass(std::chrono::seconds(1));
    if (link->next_message()) ++views;
  }
  EXPECT_EQ(views, RelayQueue::kMostViews);
  link->relay(view_of("x1"));
  link->on_closed();
  EXPECT_EQ(type_of(link->next_message()), "nothing");
  link->relay(view_of("x1"));
  EXPECT_EQ(type_of(link->next_message()), "nothing") << "nothing gathers for one that is gone";
}

}  // namespace
}  // namespace homeward::server::companions_test
