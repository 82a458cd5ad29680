// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "server/time/clock.hpp"
#include "server/ws/socket.hpp"

namespace homeward::server {

/// What another robot says to this one and waits to be sent. It stays small whatever the two do: of states the newest
/// waits, of views those that fit; who sent one that was dropped tells it again, as it is not among what has arrived.
class RelayQueue {
 public:
  static constexpr std::size_t kMostViews = 8;
  static constexpr std::size_t kMost_bytes = 1024UL * 1024;  // of views; of a larger one, that alone
  /// Views go out no faster: what is written lies in the network before a later stop, and nothing overtakes it there.
  static constexpr std::size_t kPerSecond_bytes = 256UL * 1024;

  /// In place of one that waits.
  void put_state(Outgoing state);
  /// Whether there was room for it.
  bool put_view(Outgoing view);
  /// What may go out now, first of all a state.
  std::optional<Outgoing> next(SteadyTime now);
  void clear();
  [[nodiscard]] bool empty() const { return !state_ && views_.empty(); }

 private:
  std::optional<Outgoing> state_;
  std::deque<Outgoing> views_;
  std::size_t bytes_ = 0;  // of the views
  SteadyTime next_view_at_ = SteadyTime::min();
};

}  // namespace homeward::server
