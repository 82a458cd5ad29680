// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/result.hpp"
#include "server/http/front.hpp"

namespace homeward::server {

/// HTTP/1.1 and WebSocket on one address. All socket work happens on one thread of its own; Boost.Beast and Asio stay
/// behind this class.
class HttpServer {
 public:
  /// Starts listening. `address`: "127.0.0.1" or "::1"; port 0 picks a free one. Errors: kIo.
  static Result<std::unique_ptr<HttpServer>> start(const std::string& address, std::uint16_t port, Front& front,
                                                   const ServerLimits& limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// Calls `tick` on the socket thread every `period_ms` until the server stops.
  void every(int period_ms, std::function<void()> tick);
  /// Closes all sockets and joins the thread.
  void stop();

 private:
  struct State;
  HttpServer();
  std::unique_ptr<State> state_;
};

}  // namespace homeward::server
