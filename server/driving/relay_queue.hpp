// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
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
  static constexpr std::size_t kMostView_bytes = 256UL * 1024;  // one is 27 KB as a rule; a larger one goes to nobody
  static constexpr std::size_t kMost_bytes = 1024UL * 1024;     // of all views
  /// Views go out no faster: what is written lies in the network before a later stop, and nothing overtakes it there.
  static constexpr std::size_t kPerSecond_bytes = 256UL * 1024;
  /// And however small they are, not so often that they keep the receiver busy.
  static constexpr std::chrono::milliseconds kStatesApart{200};
  static constexpr std::chrono::milliseconds kViewsApart{50};

  /// In place of one that waits.
  void put_state(Outgoing state);
  /// Whether there was room for it.
  bool put_view(Outgoing view);
  /// What may go out now, a state before views.
  std::optional<Outgoing> next(SteadyTime now);
  void clear();
  [[nodiscard]] bool empty() const { return !state_ && views_.empty(); }

 private:
  std::optional<Outgoing> state_;
  std::deque<Outgoing> views_;
  std::size_t bytes_ = 0;  // of the views
  SteadyTime next_view_at_ = SteadyTime::min();
  SteadyTime next_state_at_ = SteadyTime::min();
};

}  // namespace homeward::server
