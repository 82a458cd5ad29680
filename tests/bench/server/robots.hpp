// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "figures.hpp"
#include "server_process.hpp"

namespace homeward::bench {

/// When robots sent their frames, and when the beliefs that follow them were heard. Callable from any thread.
class FrameLog {
 public:
  void sent(const std::string& robot, std::int64_t t_us);
  void believed(const std::string& robot, std::int64_t t_us, bool lost);
  /// A link or the event socket has ended: what follows is worth nothing.
  void broke(const std::string& what);

  /// How many robots have a belief.
  [[nodiscard]] std::size_t robots_believed() const;
  /// What was sent before now counts no more.
  void begin();
  /// What is sent from now on counts no more.
  void end();
  /// Of the frames that count: how many were sent, how many of these were followed by their belief, their share, how
  /// many beliefs said lost, and the times from sending a frame to hearing its belief. A frame that a newer one
  /// overtook in the server has none.
  [[nodiscard]] nlohmann::json figures() const;

 private:
  struct Frame {
    Clock::time_point sent_at;
    bool counts = false;
    double belief_ms = -1.0;  // after it; below zero: not heard
    bool lost = false;
  };
  mutable std::mutex mutex_;
  std::map<std::string, std::unordered_map<std::int64_t, Frame>> frames_;  // of each robot, by t_us
  std::map<std::string, int> beliefs_;                                     // of each robot
  std::vector<std::string> broken_;
  bool counting_ = false;
};

/// Robots that stand in rooms of a map and send frames as an agent does, and somebody who hears the events.
class Robots {
 public:
  static constexpr int kCount = 4;

  /// `map`: on the server, with rooms. Returns when each robot has a belief; throws std::runtime_error when that takes
  /// too long.
  Robots(ServerProcess& server, const std::string& map);
  ~Robots();

  [[nodiscard]] const std::string& id(std::size_t index) const { return robots_.at(index).id; }
  FrameLog log;

 private:
  std::uint16_t port_;
  std::array<Robot, kCount> robots_;
  std::vector<std::jthread> threads_;  // last: they use what is above
};

}  // namespace homeward::bench
