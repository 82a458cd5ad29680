// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace homeward::testing {

struct Answer {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string code() const;
};

using Headers = std::map<std::string, std::string>;

/// A browser-like caller over a real socket: keeps its cookie, says its origin. One connection for each request.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port);

  Answer send(const std::string& method, const std::string& path, const std::string& body = "",
              const Headers& headers = {});
  Answer get(const std::string& path, const Headers& headers = {});
  Answer post(const std::string& path, const nlohmann::json& body = nlohmann::json::object(),
              const Headers& headers = {});
  Answer put(const std::string& path, const nlohmann::json& body);

  Headers defaults;
  std::string cookie;

 private:
  std::uint16_t port_;
  std::string host_;
};

/// A connection that sends whatever bytes it is told to.
class RawConnection {
 public:
  explicit RawConnection(std::uint16_t port);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  /// False when the other end has closed.
  bool send(const std::string& bytes);
  /// All that comes until the other end closes, `last` has come or the time is over.
  std::string receive(const std::string& last = "", std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// The other end has closed; known once receive() has met the end.
  [[nodiscard]] bool closed() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

/// A WebSocket whose reads end after a while.
class SocketClient {
 public:
  SocketClient();
  ~SocketClient();
  SocketClient(const SocketClient&) = delete;
  SocketClient& operator=(const SocketClient&) = delete;

  /// The status of the handshake: 101 when it is open.
  int open(std::uint16_t port, const std::string& path, const Headers& headers);
  void send(const std::string& bytes, bool text);
  /// The next message, or nothing when none comes in time or the other end has closed.
  std::optional<std::string> receive(std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// Returns once the other end has taken up all that was sent, and what it had to send by then has come and waits to
  /// be received. It proves that by pings: each is answered after what the other end read before it, and at the latest
  /// between two messages that it has to send, so that it has none left once nothing comes before the answer. False
  /// when the connection has ended or a minute was not enough.
  bool take_in_all();

  /// The other end has closed, and nothing of it is left to be received.
  [[nodiscard]] bool closed() const;
  /// Cuts the connection as a dead network would, without a word.
  void cut();

 private:
  struct Connection;
  void begin_reading();
  std::unique_ptr<Connection> connection_;
};

}  // namespace homeward::testing
