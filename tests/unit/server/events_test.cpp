// SPDX-License-Identifier: Apache-2.0
#include "server/ws/event_hub.hpp"
#include "support/server_fixture.hpp"

namespace homeward::server::events_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

/// A dashboard of a house in which nothing happens; time passes when the test says so.
class EventsTest : public testing::ServerTest {
 protected:
  void SetUp() override {
    ServerTest::SetUp();
    clock.stand();
    clock.pass(kHeartbeatEvery);
    app->tick();  // the last heartbeat is of now
    ASSERT_EQ(
        page.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults.at("Origin")}}),
        101);
    const auto first = page.receive();
    ASSERT_TRUE(first);
    ASSERT_EQ(json::parse(*first).at("type"), "snapshot");
    seq = json::parse(*first).at("seq");
  }
  /// What the server has told by now and was not looked at yet.
  json heard() {
    EXPECT_TRUE(page.take_in_all());
    json events = json::array();
    while (const auto message = page.receive(milliseconds(1))) events.push_back(json::parse(*message));
    return events;
  }
  /// The `n`-th message after the snapshot.
  [[nodiscard]] json heartbeat(std::int64_t n) const { return {{"type", "heartbeat"}, {"v", 1}, {"seq", seq + n}}; }

  testing::SocketClient page;
  std::int64_t seq = 0;
};

TEST_F(EventsTest, AServerWithNothingToTellIsHeardOfEachSecond) {
  clock.pass(kHeartbeatEvery - milliseconds(1));
  app->tick();
  EXPECT_TRUE(heard().empty());
  clock.pass(milliseconds(1));
  app->tick();
  EXPECT_EQ(heard(), json::array({heartbeat(1)}));
  app->tick();
  EXPECT_TRUE(heard().empty()) << "one for each second, however often it is asked";
  clock.pass(kHeartbeatEvery);
  app->tick();
  EXPECT_EQ(heard(), json::array({heartbeat(2)}));
}

TEST_F(EventsTest, OneThatWasFrozenBeatsOnceAndNotForAllThatItMissed) {
  clock.pass(std::chrono::seconds(40));
  app->tick();
  app->tick();
  EXPECT_EQ(heard().size(), 1U);
}

}  // namespace
}  // namespace homeward::server::events_test
