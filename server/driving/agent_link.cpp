// SPDX-License-Identifier: Apache-2.0
#include "server/driving/agent_link.hpp"

namespace homeward::server {
namespace {

// An agent that takes nothing for this many messages (permits come twenty times a second) is given up.
constexpr std::size_t kMostWaiting = 100;

}  // namespace

std::shared_ptr<Socket> AgentLink::socket() {
  const std::scoped_lock lock(mutex_);
  return socket_;
}

void AgentLink::send(const wire::ServerMessage& message, bool first) {
  const std::vector<std::uint8_t> bytes = wire::encode(message);
  Outgoing outgoing{std::make_shared<const std::string>(bytes.begin(), bytes.end()), false};
  bool full = false;
  std::shared_ptr<Socket> socket;
  {
    const std::scoped_lock lock(mutex_);
    if (first) {
      waiting_.push_front(std::move(outgoing));
    } else {
      waiting_.push_back(std::move(outgoing));
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
  if (waiting_.empty()) return std::nullopt;
  Outgoing next = std::move(waiting_.front());
  waiting_.pop_front();
  return next;
}

void AgentLink::on_closed() {
  {
    const std::scoped_lock lock(mutex_);
    socket_.reset();
    waiting_.clear();
  }
  listener_.closed(shared_from_this());
}

}  // namespace homeward::server
