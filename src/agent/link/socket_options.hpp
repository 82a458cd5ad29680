// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "agent/link/address.hpp"

namespace homeward::agent {

/// How a WebSocket connects, and what it bears.
struct SocketOptions {
  ServerAddress address;  // with TLS, the host's certificate has to be valid for its name
  std::string path = "/";
  std::map<std::string, std::string> headers = {};  // of the handshake
  bool text = false;                                // messages are texts, else bytes
  std::size_t max_message_bytes = 1U << 20U;        // a larger one that arrives ends the connection
  std::size_t max_waiting = 256;                    // messages; a connection that is so far behind is dead

  std::chrono::milliseconds connect_limit{5000};  // for connecting, with TLS, and again for the handshake
  std::chrono::milliseconds silence_limit{2000};  // without a byte for so long, the connection is lost
  /// A ping is sent so often to measure the lag. Nothing: only when the other side is silent, to hear whether it lives.
  /// Either way a side that has nothing to say lives as long as it answers pings.
  std::optional<std::chrono::milliseconds> ping_period = std::nullopt;
  /// The pauses between connections begin anew after a connection that took longer than this from its beginning to its
  /// end, made or not. Nothing: after any on which a message came and that was not given up by `restart`.
  std::optional<std::chrono::milliseconds> settled_after = std::nullopt;
};

/// How a connection ended.
struct ConnectionEnd {
  enum class Stage {
    kConnecting,  // the host was not reached
    kHandshake,   // it was, and gave no WebSocket
    kOpen,        // the connection had been made
  };
  Stage stage = Stage::kConnecting;
  std::string why;
  bool heard = false;     // a message came on it
  bool given_up = false;  // by `restart`
};

}  // namespace homeward::agent
