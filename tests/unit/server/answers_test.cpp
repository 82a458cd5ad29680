// SPDX-License-Identifier: Apache-2.0
#include "support/driving_fixture.hpp"

namespace homeward::server::answers_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;

/// A robot that drives, and may ask.
class AnswersTest : public DrivingTest {
 protected:
  void set_off() {
    add_robot();
    put_on_map();
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    lease = take_lease(*admin);
    find_itself(agent);
    const Answer sent = send_home(lease);
    ASSERT_EQ(sent.status, 201) << sent.body;
    mission = sent.json();
    order = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(order);
    agent.status(wire::DriveState::kDriving, order, 1);
    ASSERT_EQ(wait_for_state(mission, "driving").at("state"), "driving");
  }
  void ask(std::int64_t number) {
    agent.question = wire::QuestionReport{number, order->path.back().place, order->label, 60.0};
    agent.status(wire::DriveState::kDriving, order, 1);
    let_work_off(agent);
    ASSERT_EQ(shown_question().value("number", 0), number);
  }
  json shown_question() { return admin->get(root).json().at("question"); }
  [[nodiscard]] std::string path() const {
    return root + "/missions/" + mission.at("id").get<std::string>() + "/answer";
  }
  Answer say(testing::HttpClient& client, bool here, std::int64_t question = 1) {
    return client.post(path(), {{"lease_id", lease}, {"question", question}, {"here", here}});
  }

  FakeAgent agent;
  std::string lease;
  json mission;
  std::optional<wire::MissionOrder> order;
};

TEST_F(AnswersTest, TheFirstAnswerGoesToTheRobotAndTheQuestionVanishes) {
  set_off();
  EXPECT_TRUE(shown_question().is_null());
  EXPECT_EQ(say(*admin, true).code(), "conflict") << "nothing is asked";
  ask(1);
  EXPECT_EQ(shown_question().at("label"), "home");
  EXPECT_EQ(say(*admin, true, 2).code(), "conflict") << "another question";
  const Answer said = say(*admin, true);
  ASSERT_EQ(said.status, 202) << said.body;
  EXPECT_EQ(said.json().at("id"), mission.at("id"));
  EXPECT_TRUE(shown_question().is_null()) << "answered, though the robot still tells of it";
  const auto heard = agent.await<wire::Answer>();
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->mission, order->mission);
  EXPECT_EQ(heard->question, 1);
  EXPECT_TRUE(heard->here);
  const Answer late = say(*admin, false);
  EXPECT_EQ(late.status, 409);
  EXPECT_EQ(late.code(), "conflict") << "another browser was faster";
  EXPECT_NE(late.json().at("detail").get<std::string>().find("answered"), std::string::npos) << late.body;
  EXPECT_FALSE(comes_within<wire::Answer>(agent, milliseconds(300)));
  EXPECT_TRUE(comes_at_once<wire::Permit>(agent)) << "permits go on while it asks";
  ask(2);
  EXPECT_EQ(say(*admin, false, 2).status, 202) << "a new question may be answered anew";
  EXPECT_FALSE(agent.await<wire::Answer>().value().here);
  agent.question.reset();
  agent.arrival_probability = 0.97;
  agent.status(wire::DriveState::kArrived, order, 1);
  EXPECT_EQ(wait_for_state(mission, "arrived").at("arrival_probability"), 0.97);
  EXPECT_EQ(say(*admin, true, 2).status, 409);
}

TEST_F(AnswersTest, ItTakesARiderWhoHoldsTheLease) {
  testing::HttpClient viewer = signed_in("vera", "viewer");
  testing::HttpClient rider = signed_in("rita", "rider");
  set_off();
  ask(1);
  EXPECT_EQ(say(viewer, true).status, 403);
  const Answer without = rider.post(path(), {{"lease_id", "x"}, {"question", 1}, {"here", true}});
  EXPECT_EQ(without.status, 409);
  EXPECT_EQ(without.code(), "lease_held");
  testing::HttpClient stranger(app->port());
  EXPECT_EQ(say(stranger, true).status, 401);
  EXPECT_FALSE(comes_within<wire::Answer>(agent, milliseconds(300)));
  EXPECT_FALSE(shown_question().is_null());
}

TEST_F(AnswersTest, WhatCannotBeReadOrIsOfAnotherMissionIsRefused) {
  set_off();
  ask(1);
  EXPECT_EQ(admin->post(path(), {{"lease_id", lease}, {"question", 0}, {"here", true}}).status, 422);
  EXPECT_EQ(admin->post(path(), {{"lease_id", lease}, {"question", 1}, {"here", "yes"}}).status, 422);
  EXPECT_EQ(admin->post(path(), {{"lease_id", lease}, {"question", 1}}).status, 422);
  EXPECT_EQ(admin->post(root + "/missions/none/answer", {{"lease_id", lease}, {"question", 1}, {"here", true}}).status,
            404);
  EXPECT_FALSE(comes_within<wire::Answer>(agent, milliseconds(300)));
  // Sent on anew, the robot's question of the mission before counts no more.
  const Answer again = send_home(lease);
  ASSERT_EQ(again.status, 201) << again.body;
  EXPECT_EQ(say(*admin, true).code(), "conflict");
  EXPECT_TRUE(shown_question().is_null());
}

TEST_F(AnswersTest, AfterANoItGoesOnAsAfterAnyDriveThatFailed) {
  set_off();
  ask(1);
  ASSERT_EQ(say(*admin, false).status, 202);
  ASSERT_TRUE(agent.await<wire::Answer>());
  agent.look(1);
  ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
  agent.question.reset();
  agent.status(wire::DriveState::kFailed, order, 1,
               wire::Reason{wire::ReasonCode::kDestinationDenied, {{"destination", "home"}}});
  const auto second = agent.await<wire::MissionOrder>();
  ASSERT_TRUE(second) << mission_now(mission).dump();
  EXPECT_EQ(second->mission, order->mission);
  const nlohmann::json reason = mission_now(mission).at("reason");
  EXPECT_EQ(reason.at("parameters").at("because").at("code"), "destination_denied") << reason.dump();
}

}  // namespace
}  // namespace homeward::server::answers_test
