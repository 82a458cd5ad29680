// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "server/time/clock.hpp"

namespace homeward::server {

/// How many connections may be open at once.
struct ConnectionLimits {
  std::size_t most = 512;
  std::size_t strangers = 256;             // who have not shown a secret that holds
  std::size_t strangers_of_address = 128;  // all who come through a proxy have its address
};

/// Who is connected, and who has to go so that somebody else can come: strangers, who has sent no whole request for
/// longest before the others, and last of all one whose request is being answered. A flood of half requests so
/// displaces itself, and whoever comes to stop a robot is let in. WebSockets keep their places. Of the socket thread
/// alone; the clock is handed in.
class OpenConnections {
 public:
  using Id = std::uint64_t;

  explicit OpenConnections(const ConnectionLimits& limits) : limits_(limits) {}

  /// A place for a new connection; `cut`: ends it, and may be called until it has left. Nothing when all are taken by
  /// those who must not go.
  std::optional<Id> enter(const std::string& address, std::function<void()> cut, SteadyTime now);
  /// Whether the head of a request has come with a secret that holds.
  void recognised(Id id, bool known);
  [[nodiscard]] bool is_recognised(Id id) const;
  /// A whole request has come, and is being answered.
  void began(Id id);
  /// That request was answered.
  void ended(Id id, SteadyTime now);
  /// The connection is a WebSocket from now on, which `cut` ends.
  void became_socket(Id id, std::function<void()> cut);
  void leave(Id id) { connections_.erase(id); }

  [[nodiscard]] std::size_t size() const { return connections_.size(); }
  void cut_all();

 private:
  struct Connection {
    std::string address;
    std::function<void()> cut;
    SteadyTime since;  // when it came, or its last request was answered
    bool known = false;
    bool busy = false;
    bool socket = false;
    [[nodiscard]] bool is_stranger() const { return !known && !socket; }
  };
  using Matches = std::function<bool(const Connection&)>;
  [[nodiscard]] std::size_t count(const Matches& matches) const;
  bool evict(const Matches& matches);

  ConnectionLimits limits_;
  std::map<Id, Connection> connections_;
  Id next_ = 1;
};

}  // namespace homeward::server
