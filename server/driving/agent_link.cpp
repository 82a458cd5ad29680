// SPDX-License-Identifier: Apache-2.0
#include "server/driving/agent_link.hpp"

namespace homeward::server {
namespace {

// An agent that takes nothing for this many messages (permits come twenty times a second) is given up.
constexpr std::size_t kMostWaiting = 100;

Outgoing outgoing(const wire::ServerMessage& message) {
  const std::vector<std::uint8_t> bytes = wire::encode(message);
  return {std::make_shared<const std::string>(bytes.begin(), bytes.end()), false};
}

}  // namespace

std::shared_ptr<Socket> AgentLink::socket() {
  const std::scoped_lock lock(mutex_);
  return socket_;
}

void AgentLink::send(const wire::ServerMessage& message, bool first) {
  Outgoing next = outgoing(message);
  bool full = false;
  std::shared_ptr<Socket> socket;
  {
    const std::scoped_lock lock(mutex_);
    if (first) {
      waiting_.push_front(std::move(next));
    } else {
      waiting_.push_back(std::move(next));
    }
    full = waiting_.size() > kMostWaiting;
    socket = socket_;
  }
  if (!socket) return;
  if (full) {
    socket->close(kCloseTryLater, "the agent does not read");
  } else {
    socket->wake();
  }
}

void AgentLink::relay(const wire::CompanionView& view) {
  const auto open = socket();
  if (!open) return;
  Outgoing next = outgoing(view);
  {
    const std::scoped_lock lock(mutex_);
    if (!relayed_.put_view(std::move(next))) return;
  }
  open->wake();
}

void AgentLink::relay(const wire::CompanionState& state) {
  const auto open = socket();
  if (!open) return;
  Outgoing next = outgoing(state);
  {
    const std::scoped_lock lock(mutex_);
    relayed_.put_state(std::move(next));
  }
  open->wake();
}

void AgentLink::forget_relayed() {
  const std::scoped_lock lock(mutex_);
  relayed_.clear();
}

void AgentLink::send_what_is_due() {
  std::shared_ptr<Socket> open;
  {
    const std::scoped_lock lock(mutex_);
    if (!relayed_.empty()) open = socket_;
  }
  if (open) open->wake();
}

void AgentLink::close(std::uint16_t code, const std::string& reason) {
  if (const auto open = socket()) open->close(code, reason);
}

void AgentLink::on_open(const std::shared_ptr<Socket>& socket) {
  last_heard_ = clock_.steady();
  const std::scoped_lock lock(mutex_);
  socket_ = socket;
}

void AgentLink::on_message(std::span<const std::uint8_t> bytes, bool text) {
  if (broken_) return;
  last_heard_ = clock_.steady();
  const auto refuse = [&](const std::string& code, const std::string& message) {
    broken_ = true;
    send(wire::LinkError{code, message}, true);
    // The close frame follows the message being written; the error is that message, as nothing else goes out now.
    close(kCloseProtocol, message);
  };
  if (text) return refuse("invalid_input", "Messages of the link are binary.");
  auto message = wire::decode_agent_message(bytes);
  if (!message) return refuse("invalid_input", message.error().where + ": " + message.error().message);
  const bool hello = std::holds_alternative<wire::Hello>(*message);
  if (hello == greeted_) return refuse("invalid_input", hello ? "One hello is enough." : "The first message is hello.");
  greeted_ = true;
  listener_.received(shared_from_this(), std::move(*message));
}

std::optional<Outgoing> AgentLink::next_message() {
  const std::scoped_lock lock(mutex_);
  if (waiting_.empty()) return relayed_.next(clock_.steady());
  Outgoing next = std::move(waiting_.front());
  waiting_.pop_front();
  return next;
}

void AgentLink::on_closed() {
  {
    const std::scoped_lock lock(mutex_);
    socket_.reset();
    waiting_.clear();
    relayed_.clear();
  }
  listener_.closed(shared_from_this());
}

}  // namespace homeward::server
