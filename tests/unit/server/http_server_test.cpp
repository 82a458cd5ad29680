// SPDX-License-Identifier: Apache-2.0
#include "server/http/http_server.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "support/http_client.hpp"

namespace homeward::server::http_server_test {
namespace {

using testing::RawConnection;

constexpr std::size_t kLong_bytes = 40UL << 20;  // more than the buffers of both ends hold

/// Answers everything with the same long text.
class LongAnswers : public Front {
 public:
  std::variant<std::size_t, Response> admit(Request&) override { return std::size_t{0}; }
  void answer(std::shared_ptr<Request>, Reply reply) override {
    Response response;
    response.body.assign(kLong_bytes, 'x');
    reply(std::move(response));
  }
  void upgrade(std::shared_ptr<Request>, std::function<void(Upgrade)> reply) override { reply(Response{}); }
  [[nodiscard]] bool still_welcome(const Request&) const override { return true; }
};

class HttpServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ServerLimits limits;
    limits.answer_timeout_ms = 800;
    server_ = *HttpServer::start("127.0.0.1", 0, front_, limits);
  }
  void TearDown() override { server_->stop(); }
  static constexpr const char* kRequest = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";

  LongAnswers front_;
  std::unique_ptr<HttpServer> server_;
};

TEST_F(HttpServerTest, WhoTakesNothingOfAnAnswerIsLetGo) {
  RawConnection connection(server_->port());
  connection.send(kRequest);
  std::this_thread::sleep_for(std::chrono::milliseconds(3000));
  EXPECT_LT(connection.receive().size(), kLong_bytes);
  EXPECT_TRUE(connection.closed());
}

TEST_F(HttpServerTest, WhoTakesAnAnswerSlowlyGetsAllOfIt) {
  RawConnection connection(server_->port());
  connection.send(kRequest);
  std::size_t taken = 0;
  const auto began = std::chrono::steady_clock::now();
  const auto since = [&] { return std::chrono::steady_clock::now() - began; };
  while (since() < std::chrono::milliseconds(2500)) {  // three times as long as one slice may take
    taken += connection.receive("", std::chrono::milliseconds(10)).size();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  while (!connection.closed() && taken <= kLong_bytes && since() < std::chrono::seconds(60)) {
    taken += connection.receive("", std::chrono::milliseconds(500)).size();
  }
  EXPECT_GT(taken, kLong_bytes);
}

}  // namespace
}  // namespace homeward::server::http_server_test
