// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "agent/link/address.hpp"

namespace homeward::agent {

/// A WebSocket over which texts go to and from a machine nearby, in a thread of its own: connects, and connects again
/// when the connection is lost. All functions may be called from any thread and never wait for the network.
class JsonSocket {
 public:
  struct Events {
    /// Asked on each new connection: the texts to begin with.
    std::function<std::vector<std::string>()> greeting;
    std::function<void(std::string_view)> arrived;
    std::function<void()> lost;                   // a connection ended that had been made
    std::function<void(const std::string&)> log;  // connections made and lost
  };
  /// The events are called from the socket's thread. Texts above `max_message_bytes` end the connection.
  JsonSocket(ServerAddress address, std::size_t max_message_bytes, Events events);
  ~JsonSocket();
  JsonSocket(const JsonSocket&) = delete;
  JsonSocket& operator=(const JsonSocket&) = delete;

  [[nodiscard]] bool up() const;
  /// How old at most is what arrives last: the age of the newest ping that came back. Pings queue behind everything
  /// else, so a connection that lags is seen without comparing two machines' clocks. An hour when there is none.
  [[nodiscard]] std::chrono::milliseconds lag() const;
  /// Of texts that wait to be sent only the newest is kept: an order for motion must not arrive late. Dropped when not
  /// connected, or when it can be sent only after `good_until`: a process that was frozen must not
  /// say what it meant before.
  void send_newest(std::string text, std::chrono::steady_clock::time_point good_until);
  /// Sends these last, closes the connection in order within `limit`, and connects no more.
  void finish(std::vector<std::string> texts, std::chrono::milliseconds limit);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::agent
