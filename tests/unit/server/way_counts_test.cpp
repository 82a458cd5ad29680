// SPDX-License-Identifier: Apache-2.0
#include "support/driving_fixture.hpp"

namespace homeward::server::way_counts_test {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::FakeAgent;

class WayCountsTest : public testing::DrivingTest {
 protected:
  void set_off() {
    add_robot();
    put_on_map();
    ASSERT_EQ(agent.connect(app->port(), robot, token), 101);
    lease = take_lease(*admin);
    find_itself(agent);
  }
  /// A mission to the destination, and what the robot was told of it.
  json send() {
    const Answer sent = send_home(lease);
    EXPECT_EQ(sent.status, 201) << sent.body;
    do order = agent.await<wire::MissionOrder>();  // that of another way of a mission before it may be on the link
    while (order && order->mission != MissionId(sent.json().at("id").get<std::string>()));
    EXPECT_TRUE(order);
    return sent.json();
  }
  json ways() { return admin->get("/api/v1/maps/" + map + "/ways").json().at("ways"); }
  /// How often the way between two places of the path was driven and failed.
  std::pair<int, int> counts(const json& path, std::size_t from) {
    for (const json& way : ways()) {
      if (way.at("from") == path.at(from) && way.at("to") == path.at(from + 1))
        return {way.at("driven"), way.at("failed")};
    }
    return {0, 0};
  }
  void edit(const json& one) {
    const std::string path = "/api/v1/maps/" + map;
    const std::string tag = admin->get(path + "/graph").headers.at("etag");
    const Answer made = admin->post(path + "/edits", {{"edits", {one}}}, {{"If-Match", tag}});
    ASSERT_EQ(made.status, 200) << made.body;
  }

  /// Drives the order to a place of its path and stops there.
  void drive_to(std::int64_t place) {
    for (std::int64_t i = 1; i <= place; ++i) agent.status(wire::DriveState::kDriving, order, i);
    agent.status(wire::DriveState::kStopped, order, place);
    let_work_off(agent);
  }

  FakeAgent agent;
  std::string lease;
  std::optional<wire::MissionOrder> order;
};

TEST_F(WayCountsTest, EachWayThatAMissionDroveIsCountedOnceAndOutlivesARestart) {
  set_off();
  EXPECT_TRUE(ways().empty());
  const json mission = send();
  const json path = mission.at("path");
  ASSERT_GE(path.size(), 3U);
  agent.status(wire::DriveState::kDriving, order, 1);
  agent.status(wire::DriveState::kDriving, order, 1);
  let_work_off(agent);
  EXPECT_TRUE(ways().empty()) << "it is on its way to the second place";
  agent.status(wire::DriveState::kDriving, order, 2);
  let_work_off(agent);
  EXPECT_EQ(counts(path, 0), (std::pair{1, 0}));
  agent.status(wire::DriveState::kDriving, order, 1);
  for (std::size_t i = 2; i < path.size(); ++i) {
    agent.status(wire::DriveState::kDriving, order, static_cast<std::int64_t>(i));
  }
  agent.status(wire::DriveState::kArrived, order, static_cast<std::int64_t>(path.size()) - 1);
  let_work_off(agent);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) EXPECT_EQ(counts(path, i), (std::pair{1, 0})) << i;
  EXPECT_EQ(ways().size(), path.size() - 1) << "nothing is said of the ways back";
  const json before = ways();
  restart();
  EXPECT_EQ(ways(), before);
}

TEST_F(WayCountsTest, WhoeverFindsItselfElsewhereHasNotDrivenWhatLiesBetween) {
  set_off();
  const json path = send().at("path");
  ASSERT_GE(path.size(), 4U);
  agent.status(wire::DriveState::kDriving, order, 1);
  agent.status(wire::DriveState::kDriving, order, 3);
  agent.status(wire::DriveState::kArrived, order, 3);
  let_work_off(agent);
  EXPECT_TRUE(ways().empty());
}

TEST_F(WayCountsTest, TheWayOnWhichAMissionFailedIsCounted) {
  set_off();
  const json path = send().at("path");
  agent.status(wire::DriveState::kDriving, order, 1);
  let_work_off(agent);
  agent.status(wire::DriveState::kFailed, order, 1, wire::Reason{wire::ReasonCode::kRobotCannotGoOn});
  let_work_off(agent);
  EXPECT_EQ(counts(path, 0), (std::pair{0, 1}));
  EXPECT_EQ(counts(path, 1), (std::pair{0, 0}));
}

TEST_F(WayCountsTest, AWayThatAPersonDrewIsDrivenSlowlyUntilAMissionHasDrivenIt) {
  set_off();
  const json path = send().at("path");
  ASSERT_GE(path.size(), 3U);
  EXPECT_FALSE(order->path.at(0).next->shortcut);
  agent.status(wire::DriveState::kStopped, order, 0);
  let_work_off(agent);
  // The only way on is one that a person drew.
  edit({{"kind", "remove_edge"}, {"from", path.at(0)}, {"to", path.at(1)}});
  edit({{"kind", "add_edge"}, {"from", path.at(0)}, {"to", path.at(1)}});
  const json again = send();
  ASSERT_EQ(again.at("path"), path);
  EXPECT_TRUE(order->path.at(0).next->shortcut);
  EXPECT_FALSE(order->path.at(1).next->shortcut);
  agent.status(wire::DriveState::kDriving, order, 1);
  agent.status(wire::DriveState::kStopped, order, 1);
  let_work_off(agent);
  send();
  EXPECT_TRUE(order->path.at(0).next->shortcut) << "it was not driven to its end";
  clock.pass(std::chrono::seconds(1));  // since it was drawn
  drive_to(2);
  send();
  EXPECT_FALSE(order->path.at(0).next->shortcut);
  clock.pass(std::chrono::seconds(1));
  agent.status(wire::DriveState::kDriving, order, 1);
  let_work_off(agent);
  agent.status(wire::DriveState::kFailed, order, 1, wire::Reason{wire::ReasonCode::kRobotCannotGoOn});
  let_work_off(agent);
  admin->post(root + "/stop");
  let_work_off(agent);
  send();
  EXPECT_TRUE(order->path.at(0).next->shortcut) << "it has failed since";
  clock.pass(std::chrono::seconds(1));
  drive_to(2);
  clock.pass(std::chrono::seconds(1));
  edit({{"kind", "remove_edge"}, {"from", path.at(0)}, {"to", path.at(1)}});
  edit({{"kind", "add_edge"}, {"from", path.at(0)}, {"to", path.at(1)}});
  send();
  EXPECT_TRUE(order->path.at(0).next->shortcut) << "it was drawn anew";
}

}  // namespace
}  // namespace homeward::server::way_counts_test
