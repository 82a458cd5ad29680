// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>

#include "server/driving/relay_queue.hpp"
#include "server/time/clock.hpp"
#include "server/ws/socket.hpp"
#include "wire/link_messages.hpp"

namespace homeward::server {

class AgentLink;

/// Receives what agents send. Called on the socket thread; must not wait.
class LinkListener {
 public:
  virtual ~LinkListener() = default;
  virtual void received(const std::shared_ptr<AgentLink>& link, wire::AgentMessage message) = 0;
  virtual void closed(const std::shared_ptr<AgentLink>& link) = 0;
};

/// The connection to one robot: CBOR messages both ways. A stop overtakes everything that waits to be sent, and
/// everything overtakes what other robots say to this one.
class AgentLink : public SocketHandler, public std::enable_shared_from_this<AgentLink> {
 public:
  AgentLink(LinkListener& listener, RobotId robot, const Clock& clock)
      : listener_(listener), robot_(std::move(robot)), clock_(clock), last_heard_(clock.steady()) {}

  /// From any thread. `first`: before all that waits.
  void send(const wire::ServerMessage& message, bool first = false);
  /// What the robot that this one explores with says to it: after all else, and dropped where too much waits.
  void relay(const wire::CompanionView& view);
  void relay(const wire::CompanionState& state);
  /// Nothing of what was relayed and still waits goes out.
  void forget_relayed();
  /// To be called every now and then: relayed views may have to wait (RelayQueue).
  void send_what_is_due();
  void close(std::uint16_t code, const std::string& reason);
  [[nodiscard]] const RobotId& robot() const { return robot_; }
  /// Whether its hello has come.
  [[nodiscard]] bool greeted() const { return greeted_; }
  /// When the last message came in, or the link was opened.
  [[nodiscard]] SteadyTime last_heard() const { return last_heard_.load(); }

  void on_open(const std::shared_ptr<Socket>& socket) override;
  void on_message(std::span<const std::uint8_t> bytes, bool text) override;
  std::optional<Outgoing> next_message() override;
  void on_closed() override;
  [[nodiscard]] std::size_t max_message_bytes() const override { return wire::kMaxLinkMessageBytes; }

 private:
  std::shared_ptr<Socket> socket();

  LinkListener& listener_;
  RobotId robot_;
  const Clock& clock_;
  std::atomic<SteadyTime> last_heard_;
  std::atomic<bool> greeted_ = false;
  bool broken_ = false;  // socket thread alone
  std::mutex mutex_;
  std::shared_ptr<Socket> socket_;
  std::deque<Outgoing> waiting_;
  RelayQueue relayed_;
};

}  // namespace homeward::server
