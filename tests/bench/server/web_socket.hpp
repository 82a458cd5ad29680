// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "plain_socket.hpp"

namespace homeward::bench {

/// The client's end of a WebSocket (RFC 6455). Its masking key is zero, so that what is sent need not be masked byte
/// for byte. Of one thread.
class WebSocket {
 public:
  /// Called with each message that has come.
  using Heard = std::function<void(std::string_view message)>;

  /// False when the server refuses.
  bool open(std::uint16_t port, const std::string& path, const std::string& token);
  /// One binary message. False when the connection has ended.
  bool send(std::string_view message) { return send_frame(kBinary, message); }
  /// Takes what comes until that time, and answers pings. False when the connection has ended.
  bool hear_until(std::chrono::steady_clock::time_point end, const Heard& heard);

 private:
  static constexpr int kBinary = 2;  // the parts of a message have lower numbers too, all others are of control
  static constexpr int kClose = 8;
  static constexpr int kPing = 9;
  static constexpr int kPong = 10;

  bool send_frame(int opcode, std::string_view payload);
  /// The whole frames of what has come.
  bool take_frames(const Heard& heard);

  PlainSocket socket_;
  std::string come_;     // not yet a whole frame
  std::string message_;  // its frames so far
};

}  // namespace homeward::bench
