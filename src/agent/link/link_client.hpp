// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "agent/link/address.hpp"
#include "core/ids.hpp"
#include "wire/link_messages.hpp"

namespace homeward::agent {

/// The robot's side of the link, over a ReconnectingSocket: says hello on each connection, and waits for the server's
/// welcome. All functions may be called from any thread and never wait for the network.
class LinkClient {
 public:
  /// `log`, called from the link's thread, gets a line for each connection made and lost.
  LinkClient(ServerAddress address, const RobotId& robot, const std::string& token, wire::Hello hello,
             std::function<void(const std::string&)> log);
  ~LinkClient();
  LinkClient(const LinkClient&) = delete;
  LinkClient& operator=(const LinkClient&) = delete;

  /// Whether the server has said welcome on the present connection.
  [[nodiscard]] bool up() const;
  /// What has arrived since the last call, in order.
  std::vector<wire::ServerMessage> take_messages();
  /// Waits until a message is there to be taken, at the longest until then.
  void wait_for_message(std::chrono::steady_clock::time_point until);
  /// Sends a message when connected, else drops it. Of frames only the newest waits, and always behind other messages.
  void send(const wire::AgentMessage& message);
  /// The same for what is no frame and was encoded before: large messages, by who may take a while for that.
  void send_encoded(std::vector<std::uint8_t> message);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::agent
