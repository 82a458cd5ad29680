// SPDX-License-Identifier: Apache-2.0
#include "agent/link/link_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "support/rosbridge_server.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::agent::link_client_test {
namespace {

using namespace std::chrono_literals;

TEST(LinkClient, IsNeverUpWithWhoIsNoServer) {
  std::mutex mutex;
  std::vector<std::string> log;
  testing::RosbridgeServer bridge(0, {});  // says what is no message of a server
  const wire::Hello hello{"homeward-agent/test", "a robot", "session", testing::sphere_camera(64)};
  LinkClient link({false, "127.0.0.1", std::to_string(bridge.port())}, RobotId("1"), "token", hello,
                  [&](const std::string& what) {
                    const std::lock_guard lock(mutex);
                    log.push_back(what);
                  });
  for (int i = 0; i < 2000 && bridge.connections() < 2; ++i) {
    EXPECT_FALSE(link.up());
    link.send(wire::Stopped{"1", 0});
    bridge.send_raw("no message");
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_GE(bridge.connections(), 2) << "it tries again";
  EXPECT_TRUE(link.take_messages().empty());
  const std::lock_guard lock(mutex);
  ASSERT_FALSE(log.empty());
  EXPECT_THAT(log[0], ::testing::StartsWith("no connection: the server sent what is no message: "));
}

}  // namespace
}  // namespace homeward::agent::link_client_test
