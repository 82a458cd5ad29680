// SPDX-License-Identifier: Apache-2.0
#include "support/driving_fixture.hpp"

namespace homeward::server::lease_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::DrivingTest;
using testing::FakeAgent;

/// Leases run out when the test says so.
class LeaseTest : public DrivingTest {
 protected:
  void SetUp() override {
    DrivingTest::SetUp();
    clock.stand();
  }
};

TEST_F(LeaseTest, OneDrivesAndTheOthersAreTold) {
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

TEST_F(LeaseTest, ALeaseThatNobodyKeepsRunsOut) {
  add_robot();
  testing::HttpClient rider = signed_in("rita", "rider");
  const std::string lease = rider.post(root + "/lease").json().at("lease").at("id");
  clock.pass(std::chrono::seconds(6));
  EXPECT_EQ(rider.put(root + "/lease", {{"lease_id", lease}}).status, 200);
  clock.pass(std::chrono::seconds(6));
  EXPECT_EQ(admin->post(root + "/lease").code(), "lease_held") << "it was kept";
  clock.pass(std::chrono::seconds(5));
  EXPECT_EQ(rider.put(root + "/lease", {{"lease_id", lease}}).code(), "lease_held") << "it is over";
  EXPECT_TRUE(admin->get(root).json().at("lease").is_null());
  EXPECT_EQ(admin->post(root + "/lease").status, 200) << "and anybody may take it";
}

TEST_F(LeaseTest, NoMissionWithoutLeaseOrRobot) {
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

TEST_F(LeaseTest, AStopALeaseThatRanOutAndALostLinkAreToldApartWithWhenTheyWere) {
  add_robot();
  put_on_map();
  for (const std::string code : {"stopped_by", "nobody_watching", "robot_gone"}) {
    FakeAgent agent;
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    const std::string lease = take_lease(*admin);
    find_itself(agent);
    const Answer sent = send_home(lease);
    ASSERT_EQ(sent.status, 201) << sent.body;
    const auto order = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(order);
    agent.status(wire::DriveState::kDriving, order, 1);
    EXPECT_TRUE(wait_for_state(sent.json(), "driving").at("ended_us").is_null());
    const TimeUs before = clock.wall_us();
    if (code == "stopped_by") signed_in("vera", "viewer").post(root + "/stop");
    if (code == "nobody_watching") clock.pass(std::chrono::seconds(11));
    if (code == "robot_gone") agent.socket.cut();
    const json ended = wait_for_state(sent.json(), "stopped");
    EXPECT_EQ(ended.at("reason").at("code"), code);
    EXPECT_EQ(ended.at("reason").at("parameters").value("by", ""), code == "stopped_by" ? "vera" : "");
    EXPECT_GE(ended.at("ended_us"), before) << code;
    EXPECT_LE(ended.at("ended_us"), clock.wall_us()) << code;
  }
}

TEST_F(LeaseTest, WithoutALeaseNoOtherWayIsDriven) {
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
  EXPECT_FALSE(comes_within<wire::MissionOrder>(agent, milliseconds(600)));
  EXPECT_EQ(mission_now(sent.json()).at("state"), "stopped");
}

}  // namespace
}  // namespace homeward::server::lease_test
