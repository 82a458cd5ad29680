// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "driving/body.hpp"

namespace homeward::agent {

/// Whether what is published to the wheels is published indeed. A rosbridge tells nobody what it refuses; but a topic
/// that is both published and subscribed to gives every message back. Not for several threads.
class CommandEcho {
 public:
  /// After `most_unheard` commands of which none came back they are missed.
  explicit CommandEcho(int most_unheard) : most_unheard_(most_unheard) {}

  /// A command was sent. Gives whether commands are missed now; again after as many more.
  bool sent(const driving::Motion& motion);
  /// A command came, perhaps of somebody else. Gives whether ours come back after they had been missed.
  bool heard(const driving::Motion& motion);
  /// A connection was made: nothing of before comes back on it.
  void begin();
  /// Whether none has come back since commands were missed.
  [[nodiscard]] bool missed() const { return missed_; }

 private:
  int most_unheard_;
  std::deque<driving::Motion> sent_;  // the latest, at most `most_unheard_`
  int unheard_ = 0;                   // sent since one came back
  bool missed_ = false;
};

}  // namespace homeward::agent
