// SPDX-License-Identifier: Apache-2.0
#include "agent/link/reconnecting_socket.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/rosbridge_server.hpp"

namespace homeward::agent::reconnecting_socket_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Message = ReconnectingSocket::Message;
using Stage = ConnectionEnd::Stage;

// More than the buffers between two processes hold, so that what comes after it waits until it is read.
constexpr std::size_t kMoreThanBuffers_bytes = 12'000'000;

Message said(const std::string& what) {
  const std::string text = R"({"op":"publish","topic":"/said","msg":")" + what + R"("})";
  return {text.begin(), text.end()};
}

bool eventually(const std::function<bool()>& holds) {
  const auto end = Clock::now() + 10s;
  while (!holds()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

/// A socket that greets with "hello", and a peer that remembers what it hears. Neither is there before `connect`.
class ReconnectingSocketTest : public ::testing::Test {
 protected:
  ReconnectingSocketTest() {
    options_.text = true;
    options_.max_message_bytes = 1 << 20;
    options_.silence_limit = 20s;  // a stalled peer is not lost
  }

  /// Makes the socket and waits until it is up.
  void connect() {
    peer_.serve_topic("/said", "std_msgs/String");
    options_.address = {false, "127.0.0.1", std::to_string(peer_.port())};
    start();
    ASSERT_TRUE(eventually([this] { return socket_->up(); }));
  }

  /// The same with a peer that, the first time, does not read for a while, and has a long message to read then.
  void connect_stalled(std::chrono::milliseconds duration) {
    stall_ = duration;
    connect();
  }

  void start() {
    ReconnectingSocket::Events events;
    events.greeting = [this] {
      std::vector<Message> messages{said("hello")};
      if (const auto stall = std::exchange(stall_, 0ms); stall > 0ms) {
        peer_.freeze(stall);
        messages.push_back(said(std::string(kMoreThanBuffers_bytes, 'x')));
      }
      return messages;
    };
    events.arrived = [](std::span<const std::uint8_t> message) -> Status {
      if (std::string(message.begin(), message.end()) == "nonsense") {
        return fail(ErrorCode::kInvalidInput, "that is nonsense");
      }
      return {};
    };
    events.ended = [this](const ConnectionEnd& end) {
      const std::lock_guard lock(mutex_);
      ends_.push_back(end);
    };
    socket_.emplace(options_, std::move(events));
  }

  /// What the peer has heard so far, but for the long message.
  std::vector<std::string> heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  bool heard(const std::string& what) {
    const auto all = heard();
    return std::find(all.begin(), all.end(), what) != all.end();
  }
  std::vector<ConnectionEnd> ends() {
    const std::lock_guard lock(mutex_);
    return ends_;
  }
  /// Whether the first connection that was made ends in time, for this reason; any, if none is given.
  void expect_lost(const std::string& why = "") {
    ASSERT_TRUE(eventually([this] { return !ends().empty(); }));
    EXPECT_EQ(ends()[0].stage, Stage::kOpen);
    if (!why.empty()) {
      EXPECT_EQ(ends()[0].why, why);
    }
    EXPECT_TRUE(eventually([this] { return socket_->up() && peer_.connections() == 2; })) << "it connects again";
  }

  SocketOptions options_;

 private:
  std::chrono::milliseconds stall_{0};
  std::mutex mutex_;
  std::vector<std::string> heard_;
  std::vector<ConnectionEnd> ends_;

  void hear(const std::string& what) {
    const std::lock_guard lock(mutex_);
    if (what.size() < kMoreThanBuffers_bytes) heard_.push_back(what);
  }

 protected:
  testing::RosbridgeServer peer_{
      0, {[this](const std::string&, const nlohmann::json& msg) { hear(msg.get<std::string>()); }}};
  std::optional<ReconnectingSocket> socket_;
};

TEST_F(ReconnectingSocketTest, ConnectsAgainAfterThePeerVanished) {
  connect();
  ASSERT_TRUE(eventually([this] { return heard("hello"); }));
  peer_.cut();
  expect_lost();
  socket_->send(said("again"));
  ASSERT_TRUE(eventually([this] { return heard("again"); }));
  EXPECT_THAT(heard(), ::testing::ElementsAre("hello", "hello", "again")) << "each connection begins with the greeting";
}

TEST_F(ReconnectingSocketTest, GoesOnTryingWhileThePeerIsAway) {
  peer_.refuse(true);
  options_.address = {false, "127.0.0.1", std::to_string(peer_.port())};
  start();
  ASSERT_TRUE(eventually([this] { return ends().size() >= 2; }));
  EXPECT_FALSE(socket_->up());
  for (const ConnectionEnd& end : ends()) EXPECT_NE(end.stage, Stage::kOpen);
  socket_->send(said("to nobody"));
  peer_.serve_topic("/said", "std_msgs/String");
  peer_.refuse(false);
  EXPECT_TRUE(eventually([this] { return heard("hello"); }));
  EXPECT_FALSE(heard("to nobody"));
}

TEST_F(ReconnectingSocketTest, GivesUpWhatWaitedWhenTheConnectionWasLost) {
  connect_stalled(1s);
  socket_->send(said("waited"));
  socket_->send_newest(said("newest"));
  peer_.cut();
  expect_lost();
  socket_->send(said("after"));
  ASSERT_TRUE(eventually([this] { return heard("after"); }));
  EXPECT_FALSE(heard("waited"));
  EXPECT_FALSE(heard("newest"));
}

TEST_F(ReconnectingSocketTest, OfTheNewestOnlyTheNewestWaitsBehindAllOthers) {
  connect_stalled(1s);
  socket_->send_newest(said("newest 1"));
  socket_->send(said("other 1"));
  socket_->send_newest(said("newest 2"));
  socket_->send(said("other 2"));
  ASSERT_TRUE(eventually([this] { return heard("newest 2"); }));
  EXPECT_THAT(heard(), ::testing::ElementsAre("hello", "other 1", "other 2", "newest 2"));
}

TEST_F(ReconnectingSocketTest, SaysNothingWhoseTimeIsOver) {
  connect_stalled(1s);
  socket_->send_newest(said("late"), Clock::now() + 50ms);
  socket_->send(said("other"));
  ASSERT_TRUE(eventually([this] { return heard("other"); }));
  socket_->send_newest(said("in time"), Clock::now() + 10s);
  ASSERT_TRUE(eventually([this] { return heard("in time"); }));
  EXPECT_FALSE(heard("late"));
}

TEST_F(ReconnectingSocketTest, FinishSendsEverythingAndConnectsNoMore) {
  connect_stalled(1s);
  socket_->send(said("waited"));
  socket_->send_newest(said("newest"));
  socket_->finish({said("last"), said("very last")}, 10s);
  ASSERT_TRUE(eventually([this] { return heard("very last"); }));
  EXPECT_THAT(heard(), ::testing::ElementsAre("hello", "waited", "last", "very last"));
  EXPECT_FALSE(socket_->up());
  socket_->send(said("afterwards"));
  std::this_thread::sleep_for(500ms);  // more than the first pause
  EXPECT_EQ(peer_.connections(), 1);
  EXPECT_TRUE(ends().empty());
}

TEST_F(ReconnectingSocketTest, FinishDoesNotWaitForAPeerThatIsAway) {
  peer_.refuse(true);
  options_.address = {false, "127.0.0.1", std::to_string(peer_.port())};
  start();
  ASSERT_TRUE(eventually([this] { return !ends().empty(); }));
  const auto begun = Clock::now();
  socket_->finish({said("last")}, 60s);
  EXPECT_LT(Clock::now() - begun, 10s);
  peer_.refuse(false);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(peer_.connections(), 0);
}

TEST_F(ReconnectingSocketTest, AMessageAboveTheLimitEndsTheConnection) {
  options_.max_message_bytes = 1000;
  connect();
  peer_.send_raw(std::string(1000, ' '));
  std::this_thread::sleep_for(50ms);
  EXPECT_TRUE(ends().empty());
  peer_.send_raw(std::string(1001, ' '));
  expect_lost("a message was larger than allowed");
}

TEST_F(ReconnectingSocketTest, AMessageThatIsOfNoUseEndsTheConnection) {
  connect();
  peer_.send_raw("nonsense");
  expect_lost("that is nonsense");
}

TEST_F(ReconnectingSocketTest, SilenceEndsTheConnection) {
  options_.silence_limit = 1s;
  connect();
  std::this_thread::sleep_for(1500ms);
  EXPECT_TRUE(socket_->up()) << "a peer that has nothing to say answers pings";
  const auto begun = Clock::now();
  peer_.freeze(4s);
  ASSERT_TRUE(eventually([this] { return !socket_->up(); }));
  EXPECT_LT(Clock::now() - begun, 3500ms) << "before the peer says something again";
  expect_lost();
}

TEST_F(ReconnectingSocketTest, AConnectionTooFarBehindIsCut) {
  options_.max_waiting = 10;
  connect_stalled(1s);
  for (int i = 0; i < 8; ++i) socket_->send(said("waits"));  // and the greeting, if it is not on its way yet
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(ends().empty());
  for (int i = 0; i < 6; ++i) socket_->send(said("too much"));
  expect_lost("ended");
  EXPECT_FALSE(heard("too much"));
}

TEST_F(ReconnectingSocketTest, PingsMeasureTheLag) {
  options_.ping_period = 20ms;
  connect();
  EXPECT_TRUE(eventually([this] { return socket_->lag() < 200ms; }));
  peer_.freeze(1s);
  EXPECT_TRUE(eventually([this] { return socket_->lag() > 500ms; }));
  EXPECT_TRUE(eventually([this] { return socket_->lag() < 200ms; }));
  EXPECT_TRUE(socket_->up());
  peer_.refuse(true);
  EXPECT_TRUE(eventually([this] { return socket_->lag() == 1h; }));
}

TEST_F(ReconnectingSocketTest, APeerThatAnswersPingsAloneIsNotLost) {
  options_.ping_period = 100ms;
  options_.silence_limit = 1s;
  connect();
  std::this_thread::sleep_for(3500ms);
  EXPECT_TRUE(socket_->up());
  EXPECT_TRUE(ends().empty());
  peer_.freeze(4s);
  ASSERT_TRUE(eventually([this] { return !socket_->up(); })) << "one that does not is";
}

TEST_F(ReconnectingSocketTest, WhoNeverSaysAnythingIsAskedLessAndLessOften) {
  connect();
  const auto begun = Clock::now();
  for (int ends_wanted = 1; ends_wanted <= 4; ++ends_wanted) {
    peer_.cut();
    ASSERT_TRUE(eventually([&] { return socket_->up() && peer_.connections() == ends_wanted + 1; }));
  }
  EXPECT_GT(Clock::now() - begun, 2900ms) << "0.2 s, 0.4, 0.8 and 1.6";
  for (const ConnectionEnd& end : ends()) EXPECT_FALSE(end.heard);
  // One word, and the pauses begin anew.
  peer_.send_raw("a word");
  std::this_thread::sleep_for(200ms);
  const auto cut = Clock::now();
  peer_.cut();
  ASSERT_TRUE(eventually([&] { return socket_->up() && peer_.connections() == 6; }));
  EXPECT_LT(Clock::now() - cut, 1200ms);
  EXPECT_TRUE(ends().back().heard);
}

TEST_F(ReconnectingSocketTest, RestartGivesTheConnectionUpAndMakesAnother) {
  connect();
  peer_.send_raw("a word");
  std::this_thread::sleep_for(100ms);
  socket_->restart("it lags");
  EXPECT_FALSE(socket_->up());
  expect_lost("it lags");
  EXPECT_TRUE(ends()[0].heard);
  EXPECT_TRUE(ends()[0].given_up);
}

TEST_F(ReconnectingSocketTest, WithoutPingsNothingIsKnownOfTheLag) {
  connect();
  EXPECT_EQ(socket_->lag(), 1h);
}

/// A listener on 127.0.0.1 that takes one connection, reads once from it and says nothing.
class MutePeer {
 public:
  MutePeer() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    auto* const address = reinterpret_cast<sockaddr*>(&address_);
    EXPECT_EQ(::bind(listener_, address, size), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    EXPECT_EQ(::getsockname(listener_, address, &size), 0);
  }
  ~MutePeer() {
    ::close(listener_);
    if (taken_ >= 0) ::close(taken_);
  }
  MutePeer(const MutePeer&) = delete;
  MutePeer& operator=(const MutePeer&) = delete;

  [[nodiscard]] std::string port() const { return std::to_string(ntohs(address_.sin_port)); }
  std::string first_words() {
    taken_ = ::accept(listener_, nullptr, nullptr);
    std::string words(4096, ' ');
    words.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(taken_, words.data(), words.size()))));
    return words;
  }

 private:
  int listener_ = -1;
  int taken_ = -1;
  sockaddr_in address_{};
};

TEST_F(ReconnectingSocketTest, AsksForItsPathWithItsHeadersAndDoesNotWaitForever) {
  MutePeer mute;
  options_.address = {false, "127.0.0.1", mute.port()};
  options_.path = "/some/link";
  options_.headers = {{"Authorization", "Bearer secret"}, {"User-Agent", "tester/1"}};
  options_.connect_limit = 1s;
  start();
  const std::string words = mute.first_words();
  EXPECT_THAT(words, ::testing::StartsWith("GET /some/link HTTP/1.1\r\n"));
  EXPECT_THAT(words, ::testing::HasSubstr("Host: 127.0.0.1:" + mute.port() + "\r\n"));
  EXPECT_THAT(words, ::testing::HasSubstr("Authorization: Bearer secret\r\n"));
  EXPECT_THAT(words, ::testing::HasSubstr("User-Agent: tester/1\r\n"));
  ASSERT_TRUE(eventually([this] { return !ends().empty(); }));
  EXPECT_EQ(ends()[0].stage, Stage::kHandshake);
  EXPECT_FALSE(socket_->up());
}

TEST_F(ReconnectingSocketTest, TlsToWhoDoesNotSpeakItFails) {
  MutePeer mute;
  options_.address = {true, "127.0.0.1", mute.port()};
  options_.connect_limit = 1s;
  start();
  EXPECT_EQ(mute.first_words()[0], '\x16') << "a TLS handshake";
  ASSERT_TRUE(eventually([this] { return !ends().empty(); }));
  EXPECT_EQ(ends()[0].stage, Stage::kConnecting);
}

}  // namespace
}  // namespace homeward::agent::reconnecting_socket_test
