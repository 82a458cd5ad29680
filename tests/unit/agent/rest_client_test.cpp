// SPDX-License-Identifier: Apache-2.0
#include "agent/link/rest_client.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/no_room.hpp"
#include "support/rest_server.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::rest_client_test {
namespace {

using homeward::testing::RestServer;

TEST(RestClient, APostWhoseAnswerIsLostIsMadeAgainAsTheSameAndTheNextIsAnother) {
  std::vector<std::string> keys;  // the server's thread, but after an answer
  const RestServer server([&](const RestServer::Request& request) {
    keys.push_back(request.idempotency_key);
    return RestServer::Reply{201, "made", keys.size() == 1};
  });
  RestClient client({false, "127.0.0.1", std::to_string(server.port())}, "token");
  const auto answer = client.call("POST", "/api/v1/tours", "{}", {});
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->body, "made");
  ASSERT_TRUE(client.call("POST", "/api/v1/tours", "{}", {}));
  ASSERT_EQ(keys.size(), 3U);
  EXPECT_FALSE(keys[0].empty());
  EXPECT_EQ(keys[1], keys[0]);
  EXPECT_NE(keys[2], keys[0]);
}

/// A server that takes a request, says what it is told, and then nothing more.
class SilentServer {
 public:
  explicit SilentServer(std::string says) : says_(std::move(says)), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(here);
    auto* address = reinterpret_cast<sockaddr*>(&here);
    if (::bind(socket_, address, size) != 0 || ::listen(socket_, 4) != 0 || ::getsockname(socket_, address, &size) != 0)
      throw std::runtime_error("no port");
    port_ = ntohs(here.sin_port);
    thread_ = std::jthread([this] {
      const int asked = ::accept(socket_, nullptr, nullptr);
      if (asked < 0) return;
      (void)!::write(asked, says_.data(), says_.size());
      char taken = 0;
      while (::read(asked, &taken, 1) > 0) {
      }
      ::close(asked);
    });
  }
  SilentServer(const SilentServer&) = delete;
  SilentServer& operator=(const SilentServer&) = delete;
  ~SilentServer() {
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
  }
  [[nodiscard]] std::string port() const { return std::to_string(port_); }

 private:
  std::string says_;
  int socket_;
  int port_ = 0;
  std::jthread thread_;
};

constexpr std::chrono::milliseconds kShort{300};

TEST(RestClient, AServerThatFallsSilentIsNotWaitedFor) {
  for (const char* says : {"", "HTTP/1.1 200 OK\r\nContent-Length: 100\r\n\r\nbegun"}) {
    const SilentServer server(says);
    RestClient client({false, "127.0.0.1", server.port()}, "token", kShort);
    const auto answer = client.call("GET", "/api/v1/maps", "", {});
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, ErrorCode::kIo);
    EXPECT_NE(answer.error().message.find("said nothing for 300 ms"), std::string::npos) << answer.error().message;
  }
}

TEST(RestClient, ADownloadThatStopsHalfWayLeavesNoFile) {
  const SilentServer server("HTTP/1.1 200 OK\r\nContent-Length: 100\r\n\r\nbegun");
  const homeward::testing::ScratchFolder folder;
  RestClient client({false, "127.0.0.1", server.port()}, "token", kShort);
  const Status fetched = client.download("/api/v1/maps/m1/export", folder.path() / "map");
  ASSERT_FALSE(fetched);
  EXPECT_EQ(fetched.error().code, ErrorCode::kIo);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map"));
}

TEST(RestClient, ADownloadMayBeLargerThanAnAnswer) {
  const std::string large(65UL * 1024 * 1024, 'x');
  const RestServer server([&](const RestServer::Request&) { return RestServer::Reply{200, large, false}; });
  const homeward::testing::ScratchFolder folder;
  RestClient client({false, "127.0.0.1", std::to_string(server.port())}, "token");
  const Status fetched = client.download("/api/v1/maps/m1/export", folder.path() / "map");
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "map"), large.size());
  EXPECT_FALSE(client.call("GET", "/api/v1/maps/m1/export", "", {})) << "not into memory";
}

TEST(RestClient, ADownloadOntoAFullDiskSaysSoAtOnceAndLeavesNoFile) {
  int asked = 0;  // the server's thread, but after an answer
  const RestServer server([&](const RestServer::Request&) {
    ++asked;
    return RestServer::Reply{200, std::string(100'000, 'm'), false};
  });
  const homeward::testing::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "map";
  RestClient client({false, "127.0.0.1", std::to_string(server.port())}, "token");
  const homeward::testing::NoRoom full;
  const Status fetched = client.download("/api/v1/maps/m1/export", file);
  ASSERT_FALSE(fetched);
  EXPECT_EQ(fetched.error().code, ErrorCode::kIo);
  EXPECT_EQ(fetched.error().where, file.string());
  EXPECT_EQ(fetched.error().message, "What the server sends cannot be written: File too large.");
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(RestClient, WhatTheServerDoesNotHaveIsNotDownloaded) {
  const RestServer server([](const RestServer::Request&) { return RestServer::Reply{404, "{}", false}; });
  const homeward::testing::ScratchFolder folder;
  RestClient client({false, "127.0.0.1", std::to_string(server.port())}, "token");
  EXPECT_EQ(client.download("/api/v1/maps/m1/export", folder.path() / "map").error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map"));
  const Status nowhere = client.download("/api/v1/maps/m1/export", folder.path() / "none" / "map");
  EXPECT_NE(nowhere.error().message.find("cannot be written"), std::string::npos) << nowhere.error().message;
}

}  // namespace
}  // namespace homeward::agent::rest_client_test
