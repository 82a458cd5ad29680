// SPDX-License-Identifier: Apache-2.0
#include "agent/link/json_socket.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "support/rosbridge_server.hpp"

namespace homeward::agent::json_socket_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// More than the buffers between two processes hold, so that what comes after it waits until it is read.
constexpr std::size_t kMoreThanBuffers_bytes = 12'000'000;

std::string said(const std::string& what) { return R"({"op":"publish","topic":"/said","msg":")" + what + R"("})"; }

/// A socket whose peer does not read for 0.5 s from its first text, a long one, on.
class StalledSocketTest : public ::testing::Test {
 protected:
  void SetUp() override {
    peer_.serve_topic("/said", "std_msgs/String");
    JsonSocket::Events events;
    events.greeting = [this] {
      peer_.freeze(500ms);
      return std::vector{said(std::string(kMoreThanBuffers_bytes, 'x')), said("after the long one")};
    };
    events.arrived = [](std::string_view, std::chrono::milliseconds) {};
    events.lost = [] {};
    events.log = [](const std::string&) {};
    socket_.emplace(WebSocketAddress{{false, "127.0.0.1", std::to_string(peer_.port())}}, 1 << 20, std::move(events));
    ASSERT_TRUE(eventually([this] { return socket_->up(); }));
  }

  static bool eventually(const std::function<bool()>& holds) {
    const auto end = Clock::now() + 10s;
    while (!holds()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(5ms);
    }
    return true;
  }

  bool heard(const std::string& what) {
    const std::lock_guard lock(mutex_);
    return std::find(heard_.begin(), heard_.end(), what) != heard_.end();
  }

 private:
  void hear(const nlohmann::json& what) {
    const std::lock_guard lock(mutex_);
    heard_.push_back(what.get<std::string>());
  }

  std::mutex mutex_;
  std::vector<std::string> heard_;
  testing::RosbridgeServer peer_{0, {[this](const std::string&, const nlohmann::json& msg) { hear(msg); }}};

 protected:
  std::optional<JsonSocket> socket_;
};

TEST_F(StalledSocketTest, SaysNothingWhoseTimeIsOver) {
  socket_->send_newest(said("late"), Clock::now() + 50ms);
  ASSERT_TRUE(eventually([this] { return heard("after the long one"); }));
  socket_->send_newest(said("in time"), Clock::now() + 10s);
  ASSERT_TRUE(eventually([this] { return heard("in time"); }));
  EXPECT_FALSE(heard("late"));
}

TEST_F(StalledSocketTest, SaysLateWhatIsRightHoweverLate) {
  socket_->send_newest(said("replaced"), Clock::time_point::max());
  socket_->send_newest(said("late"), Clock::time_point::max());
  EXPECT_TRUE(eventually([this] { return heard("late"); }));
  EXPECT_FALSE(heard("replaced"));
}

}  // namespace
}  // namespace homeward::agent::json_socket_test
