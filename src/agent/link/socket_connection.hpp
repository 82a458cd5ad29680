// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "agent/link/socket_options.hpp"
#include "core/result.hpp"

namespace homeward::agent {

/// Whose a connection is: gives what is to be sent, takes what has come. Called from within `SocketConnection::run`.
class ConnectionOwner {
 public:
  /// The handshake is done.
  virtual void opened() = 0;
  /// What to send next; nothing when nothing waits.
  virtual std::optional<std::vector<std::uint8_t>> next_message() = 0;
  /// Whether to close in order as soon as nothing waits.
  virtual bool closing() = 0;
  /// A whole message came. An error ends the connection.
  virtual Status arrived(std::span<const std::uint8_t> message) = 0;
  /// A ping came back that was sent then, in milliseconds of the steady clock.
  virtual void answered(std::int64_t sent_ms) = 0;
  /// The connection is over, or was never made; `run` is about to return.
  virtual void down() = 0;

 protected:
  ~ConnectionOwner() = default;
};

/// One connection from its first byte to its last.
class SocketConnection {
 public:
  virtual ~SocketConnection() = default;
  /// Connects and goes on until the connection ends. Gives why it did. Throws when the host's name leads nowhere, and
  /// what the owner throws.
  virtual std::string run() = 0;
  /// How far it came; from the thread that ran it.
  [[nodiscard]] virtual ConnectionEnd::Stage stage() const = 0;
  /// Asks the owner for what waits. From any thread.
  virtual void wake() = 0;
  /// Ends it without a word, also one that does not run yet; `run` gives `why`. From any thread.
  virtual void cut(const std::string& why) = 0;
};

/// A connection, plain or with TLS as the address says; it keeps both references. Throws when TLS cannot be set up.
std::unique_ptr<SocketConnection> make_connection(const SocketOptions& options, ConnectionOwner& owner);

/// The steady clock's time, which pings bear.
std::int64_t steady_now_ms();

}  // namespace homeward::agent
