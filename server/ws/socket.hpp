// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace homeward::server {

/// One message to the other end; shared, because the same one may go to many.
struct Outgoing {
  std::shared_ptr<const std::string> bytes;
  bool text = true;
};

/// The near end of an open WebSocket. Callable from any thread.
class Socket {
 public:
  virtual ~Socket() = default;
  /// Says that SocketHandler::next_message has something.
  virtual void wake() = 0;
  /// Closes after the message being written; `reason` goes to the other end.
  virtual void close(std::uint16_t code, const std::string& reason) = 0;
};

/// What a WebSocket is for. All calls come from the socket thread, one at a time; none may wait.
class SocketHandler {
 public:
  virtual ~SocketHandler() = default;
  virtual void on_open(const std::shared_ptr<Socket>& socket) = 0;
  virtual void on_message(std::span<const std::uint8_t> bytes, bool text) = 0;
  /// The next message to write, or nothing. Asked whenever the last one has been written and after each wake().
  virtual std::optional<Outgoing> next_message() = 0;
  virtual void on_closed() = 0;
  /// No message may be larger.
  [[nodiscard]] virtual std::size_t max_message_bytes() const = 0;
};

inline constexpr std::uint16_t kClosePolicy = 1008;
inline constexpr std::uint16_t kCloseGoingAway = 1001;
inline constexpr std::uint16_t kCloseProtocol = 1002;
inline constexpr std::uint16_t kCloseTryLater = 1013;

}  // namespace homeward::server
