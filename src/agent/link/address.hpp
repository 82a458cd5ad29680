// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"

namespace homeward::agent {

/// Where a server listens.
struct ServerAddress {
  bool tls = false;
  std::string host;
  std::string port;
  /// As in the Host header and in addresses: IPv6 in brackets.
  [[nodiscard]] std::string host_header() const {
    return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port;
  }
};

/// "http://127.0.0.1:8080" or "https://house.example". Errors: kInvalidInput.
Result<ServerAddress> parse_address(const std::string& text);

/// Where a WebSocket is served.
struct WebSocketAddress {
  ServerAddress server;
  std::string path = "/";  // with the query, if there is one
};

/// "ws://192.168.1.7:9090", "wss://chair.example/rosbridge". Errors: kInvalidInput.
Result<WebSocketAddress> parse_websocket_address(const std::string& text);

}  // namespace homeward::agent
