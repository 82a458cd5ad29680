// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "agent/link/address.hpp"
#include "agent/link/reconnecting_socket.hpp"

namespace homeward::agent {

/// A ReconnectingSocket for texts to and from a machine nearby, whose lag is measured. All functions may be called from
/// any thread and never wait for the network, but for `finish`.
class JsonSocket {
 public:
  struct Events {
    /// Asked on each new connection: the texts to begin with.
    std::function<std::vector<std::string>()> greeting;
    /// A text came, while the connection lagged by so much.
    std::function<void(std::string_view, std::chrono::milliseconds)> arrived;
    std::function<void()> lost;  // a connection ended that had been made
    // Connections made and lost; a machine that is switched off, or that takes connections and ends them without a
    // word, is said once, not every two seconds.
    std::function<void(const std::string&)> log;
    std::string if_unheard = {};  // what it may mean when a connection ends without a word, for the log
  };
  /// The events are called from the socket's thread. Texts above `max_message_bytes` end the connection.
  JsonSocket(WebSocketAddress address, std::size_t max_message_bytes, Events events);

  // As of a ReconnectingSocket.
  [[nodiscard]] bool up() const { return socket_.up(); }
  [[nodiscard]] std::chrono::milliseconds lag() const { return socket_.lag(); }
  void send(std::string_view text) { socket_.send({text.begin(), text.end()}); }
  void send_newest(std::string_view text, std::chrono::steady_clock::time_point good_until);
  void restart(const std::string& why) { socket_.restart(why); }
  void finish(const std::vector<std::string>& texts, std::chrono::milliseconds limit);

 private:
  std::vector<ReconnectingSocket::Message> greeting();
  void arrived(std::string_view text);
  void ended(const ConnectionEnd& end);

  Events events_;
  std::string name_;           // the machine's, in the log
  std::string logged_before_;  // of the socket's thread alone, as the next one
  bool unheard_ = false;  // the connection before ended without a word: this one is not worth a line until it has one
  ReconnectingSocket socket_;  // last: it uses all of the above
};

}  // namespace homeward::agent
