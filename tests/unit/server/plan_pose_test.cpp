// SPDX-License-Identifier: Apache-2.0
#include "server/driving/plan_follower.hpp"
#include "support/driving_fixture.hpp"
#include "unit/server/drawn_house.hpp"

namespace homeward::server::plan_pose_test {
namespace {

using nlohmann::json;
using testing::DrivingTest;
using testing::FakeAgent;
using testing::HttpClient;
using testing::SocketClient;

/// A robot on a map, connected, and dashboards that are told of it.
class PlanPoseTest : public DrivingTest {
 protected:
  void connect() {
    add_robot();
    put_on_map();
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    agent.hello();
    ASSERT_TRUE(agent.await<wire::Welcome>());
    ASSERT_EQ(open(page, *admin), 101);
  }
  int open(SocketClient& socket, HttpClient& client) {
    return socket.open(app->port(), "/api/v1/events",
                       {{"Cookie", client.cookie}, {"Origin", client.defaults.at("Origin")}});
  }
  std::string add_plan(double length_m) {
    return admin->send("POST", "/api/v1/plans?format=wrl&name=Ground", drawn_house(length_m)).json().at("id");
  }
  void tie(const std::string& plan) {
    const json places = admin->get("/api/v1/maps/" + map + "/graph").json().at("places");
    const json pins = {{{"place", places.front().at("id")}, {"x_m", 1.0}, {"y_m", 2.0}, {"theta_rad", 0.5}},
                       {{"place", places.back().at("id")}, {"x_m", 7.0}, {"y_m", 2.0}}};
    const auto tied = admin->put("/api/v1/maps/" + map + "/plan", {{"plan", plan}, {"pins", pins}});
    ASSERT_EQ(tied.status, 200) << tied.body;
  }
  /// A picture, and what comes of it.
  void look() {
    clock.pass(PlanFollower::kToldEvery);
    agent.look(1);
    ASSERT_TRUE(agent.await<wire::BeliefReport>());
    app->work_off();
  }
  /// What a dashboard was told of poses on plans, and was not looked at yet.
  static std::vector<json> poses(SocketClient& socket) {
    EXPECT_TRUE(socket.take_in_all());
    std::vector<json> told;
    while (const auto message = socket.receive(std::chrono::milliseconds(1))) {
      const json event = json::parse(*message);
      if (event.at("type") == "plan_pose") told.push_back(event.at("pose"));
    }
    return told;
  }

  FakeAgent agent;
  SocketClient page;
};

TEST_F(PlanPoseTest, EveryoneHearsOfItWhoHearsOfTheBelief) {
  connect();
  HttpClient viewer = signed_in("vera", "viewer");
  SocketClient viewers_page;
  ASSERT_EQ(open(viewers_page, viewer), 101);
  SocketClient robots_page;
  EXPECT_EQ(robots_page.open(app->port(), "/api/v1/events", {{"Authorization", "Bearer " + token}}), 403);
  HttpClient stranger(app->port());
  SocketClient strangers_page;
  EXPECT_EQ(open(strangers_page, stranger), 401);
  const std::string plan = add_plan(8.0);
  tie(plan);
  look();
  for (SocketClient* socket : {&page, &viewers_page}) {
    const std::vector<json> told = poses(*socket);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].at("robot"), robot);
    EXPECT_EQ(told[0].at("map"), map);
    EXPECT_EQ(told[0].at("plan"), plan);
    EXPECT_EQ(told[0].at("t_us"), agent.frame_seq);
    EXPECT_EQ(told[0].at("particles").size(), wire::kMaxPlanParticles);
  }
}

TEST_F(PlanPoseTest, NobodyHearsOfItWhereNobodyTiedThePlan) {
  connect();
  const std::string plan = add_plan(8.0);
  look();
  EXPECT_TRUE(poses(page).empty());
  tie(plan);
  look();
  EXPECT_EQ(poses(page).size(), 1U);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/maps/" + map + "/plan").status, 204);
  look();
  EXPECT_TRUE(poses(page).empty());
}

TEST_F(PlanPoseTest, TheBeliefGoesOnWhereThePlanCannotBeUsed) {
  connect();
  tie(add_plan(400.0));  // drawn in another unit
  for (int i = 0; i < 3; ++i) look();
  EXPECT_TRUE(poses(page).empty());
  EXPECT_EQ(admin->get(root).json().at("belief").at("t_us"), agent.frame_seq);
  tie(add_plan(8.0));
  look();
  EXPECT_EQ(poses(page).size(), 1U);
}

TEST_F(PlanPoseTest, BeginsWhereSomebodySaysAndEndsWithTheMap) {
  connect();
  tie(add_plan(8.0));
  look();
  poses(page);
  const std::string first = admin->get("/api/v1/maps/" + map + "/graph").json().at("places").front().at("id");
  ASSERT_EQ(admin->put(root + "/place", {{"place", first}}).status, 200);
  look();
  const std::vector<json> told = poses(page);
  ASSERT_EQ(told.size(), 1U);
  double mean_x_m = 0.0;
  for (const json& one : told[0].at("particles")) mean_x_m += one.at("x_m").get<double>() / wire::kMaxPlanParticles;
  EXPECT_NEAR(mean_x_m, 1.0, 1.0);
  ASSERT_EQ(admin->put(root + "/map", {{"map", taught_map()}}).status, 200);
  look();
  EXPECT_TRUE(poses(page).empty()) << "nobody tied that one";
}

TEST_F(PlanPoseTest, WhatWasSaidOfAMissionCanBeReadAfterIt) {
  connect();
  tie(add_plan(8.0));
  for (int i = 0; i < 20 && (i == 0 || admin->get(root).json().at("belief").at("lost").get<bool>()); ++i) look();
  const auto sent = send_home(take_lease(*admin));
  ASSERT_EQ(sent.status, 201) << sent.body;
  const std::string plan = root + "/missions/" + sent.json().at("id").get<std::string>() + "/plan";
  EXPECT_TRUE(admin->get(plan).json().at("poses").empty());
  look();
  look();
  ASSERT_EQ(admin->post(root + "/stop", json::object()).status, 202);
  look();
  HttpClient viewer = signed_in("vera", "viewer");
  const json kept = viewer.get(plan).json();
  EXPECT_EQ(kept.at("mission"), sent.json().at("id"));
  ASSERT_EQ(kept.at("poses").size(), 2U);
  EXPECT_EQ(kept.at("poses")[1].at("t_us"), agent.frame_seq - 1);
  EXPECT_EQ(admin->get(root + "/missions/none/plan").status, 404);
  EXPECT_EQ(admin->get("/api/v1/robots/none/missions/none/plan").status, 404);
  HttpClient stranger(app->port());
  EXPECT_EQ(stranger.get(plan).status, 401);
}

}  // namespace
}  // namespace homeward::server::plan_pose_test
