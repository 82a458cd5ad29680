// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "agent/link/socket_options.hpp"
#include "core/result.hpp"

namespace homeward::agent {

/// A WebSocket in a thread of its own, which connects, and connects again when the connection is lost: first after
/// 0.2 s, then after twice as long each time, up to 2 s; which connections end that, its options say. All functions may
/// be called from any thread and never wait for the network, but for `finish` and the end.
class ReconnectingSocket {
 public:
  using Message = std::vector<std::uint8_t>;

  /// Called from the socket's thread. What they throw ends the connection.
  struct Events {
    /// Asked on each new connection, which is up once this has returned: the messages to begin with, before all others.
    std::function<std::vector<Message>()> greeting;
    /// A whole message came. An error ends the connection for the reason that its message gives.
    std::function<Status(std::span<const std::uint8_t>)> arrived;
    /// A connection ended or could not be made, and another will be tried.
    std::function<void(const ConnectionEnd&)> ended;
  };

  ReconnectingSocket(SocketOptions options, Events events);
  /// Cuts the connection; `finish` comes before where it has to end in order.
  ~ReconnectingSocket();
  ReconnectingSocket(const ReconnectingSocket&) = delete;
  ReconnectingSocket& operator=(const ReconnectingSocket&) = delete;

  /// Whether there is a connection. False as soon as it is known to be lost, before any timer runs out.
  [[nodiscard]] bool up() const;
  /// How old at most is what arrives last: the age of the newest ping that came back. Pings queue behind everything
  /// else, so a connection that lags is seen without comparing two machines' clocks. An hour when there is no
  /// connection, or the options want no pings.
  [[nodiscard]] std::chrono::milliseconds lag() const;

  /// Sends a message after those that wait; drops it when not connected. A connection that is `max_waiting` messages
  /// behind is cut. What waits when a connection is lost is never sent.
  void send(Message message);
  /// Of these only the newest waits, behind all other messages: an order for motion must not arrive late. Dropped when
  /// not connected, or when it can be sent only after `good_until`: a process that was frozen must not say what it
  /// meant before.
  void send_newest(Message message,
                   std::chrono::steady_clock::time_point good_until = std::chrono::steady_clock::time_point::max());
  /// Gives the present connection up for this reason, with all that waits, and makes another.
  void restart(const std::string& why);
  /// Sends what waits and then these, but not the newest; closes the connection in order within `limit`, and connects
  /// no more.
  void finish(std::vector<Message> messages, std::chrono::milliseconds limit);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::agent
