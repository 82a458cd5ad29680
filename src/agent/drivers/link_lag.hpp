// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "agent/drivers/rosbridge_config.hpp"
#include "driving/milliseconds.hpp"

namespace homeward::agent {

/// How old the messages of one topic are when they arrive, by the stamps of the robot's clock and the times of arrival
/// by ours, whatever the two clocks say: a message is as old as it was under way longer than the quickest one so far.
/// What is taken for the quickest grows slowly, since no two clocks run alike. Ours. Holds no clock.
class StampedDelay {
 public:
  explicit StampedDelay(double most_drift) : most_drift_(most_drift) {}

  /// The age of a message that bears this stamp and arrives now, from 0.
  driving::Milliseconds age_ms(std::int64_t stamp_us, driving::Milliseconds now_ms);
  void forget() { quickest_ms_.reset(); }

 private:
  double most_drift_;
  std::optional<double> quickest_ms_;  // arrival less stamp, any number
  driving::Milliseconds at_ms_ = 0;    // when that held
};

/// Whether one connection brings what is new. All messages come in one stream of bytes, so that the ages of those with
/// a stamp tell of those without; pings tell of what waits between the two machines, stamps also of what waited in the
/// bridge. Holds no clock. Not for several threads.
class LinkLag {
 public:
  explicit LinkLag(const LinkLagConfig& config) : config_(config) {}

  /// A connection was made, on which nothing has been heard.
  void begin(driving::Milliseconds now_ms);
  /// A message with a stamp arrived on a topic that is small and regular, so that its age is the connection's.
  void heard(driving::Milliseconds age_ms, driving::Milliseconds now_ms);
  /// What the pings say now: the connection lags by so much.
  void pinged(driving::Milliseconds lag_ms, driving::Milliseconds now_ms);

  /// The most by which anything was late in the time that is remembered.
  [[nodiscard]] driving::Milliseconds worst_ms(driving::Milliseconds now_ms) const;
  /// Whether a message without a stamp that arrives now may be old: something was late in the time that is remembered,
  /// or the newest message with a stamp is old by now. Where none ever bore a stamp only the pings speak.
  [[nodiscard]] bool late(driving::Milliseconds now_ms) const;
  /// Whether the connection is as old as what is remembered, so that its word is one.
  [[nodiscard]] bool settled(driving::Milliseconds now_ms) const;
  /// Whether it has lagged without a break for so long that it counts as lost.
  [[nodiscard]] bool lost(driving::Milliseconds now_ms) const;

 private:
  void note(driving::Milliseconds late_ms, driving::Milliseconds now_ms);

  struct Late {
    driving::Milliseconds at_ms = 0;
    driving::Milliseconds by_ms = 0;
  };
  LinkLagConfig config_;
  driving::Milliseconds begun_ms_ = 0;
  std::deque<Late> late_;                                // by more than is allowed, of the time that is remembered
  std::optional<driving::Milliseconds> lags_since_ms_;   // without a break
  std::optional<driving::Milliseconds> newest_from_ms_;  // when the newest message with a stamp was sent, by our clock
};

}  // namespace homeward::agent
