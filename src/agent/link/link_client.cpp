// SPDX-License-Identifier: Apache-2.0
#include "agent/link/link_client.hpp"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "agent/link/reconnecting_socket.hpp"

namespace homeward::agent {
namespace {

SocketOptions options_for(ServerAddress address, const RobotId& robot, const std::string& token,
                          const wire::Hello& hello) {
  SocketOptions options;
  options.address = std::move(address);
  options.path = "/api/v1/robots/" + robot.str() + "/link";
  options.headers = {{"Authorization", "Bearer " + token}, {"User-Agent", hello.agent}};
  options.max_message_bytes = wire::kMaxLinkMessageBytes;
  // A server that sends robots away as soon as they come is asked less and less often.
  options.settled_after = std::chrono::seconds(5);
  return options;
}

}  // namespace

struct LinkClient::Impl {
  Impl(ServerAddress address, const RobotId& robot, const std::string& token, wire::Hello agent_hello,
       std::function<void(const std::string&)> agent_log)
      : hello(std::move(agent_hello)),
        log(std::move(agent_log)),
        server(address.host_header()),
        socket(options_for(std::move(address), robot, token, hello),
               {[this] { return std::vector<ReconnectingSocket::Message>{wire::encode(wire::AgentMessage(hello))}; },
                [this](std::span<const std::uint8_t> bytes) { return take(bytes); },
                [this](const ConnectionEnd& end) { ended(end); }}) {}

  const wire::Hello hello;
  const std::function<void(const std::string&)> log;
  const std::string server;           // its name in the log
  std::atomic<bool> welcomed{false};  // the server welcomed the connection that there is or was last
  std::mutex mutex;                   // of the messages
  std::vector<wire::ServerMessage> messages;
  std::condition_variable came;  // something has arrived
  ReconnectingSocket socket;     // last: it uses all of the above

  Status take(std::span<const std::uint8_t> bytes) {
    auto message = wire::decode_server_message(bytes);
    if (!message) {
      return fail(message.error().code, "the server sent what is no message: " + message.error().message);
    }
    // Before the message can be taken: whoever has it finds the link up.
    if (std::holds_alternative<wire::Welcome>(*message)) {
      welcomed = true;
      log("connected to " + server);
    }
    {
      const std::lock_guard lock(mutex);
      messages.push_back(std::move(*message));
    }
    came.notify_one();
    return {};
  }

  void ended(const ConnectionEnd& end) {
    std::string what = welcomed.exchange(false) ? "connection lost: " : "no connection: ";
    if (end.stage == ConnectionEnd::Stage::kHandshake) what += "the server refused the link: ";
    log(what + end.why);
  }
};

LinkClient::LinkClient(ServerAddress address, const RobotId& robot, const std::string& token, wire::Hello hello,
                       std::function<void(const std::string&)> log)
    : impl_(std::make_unique<Impl>(std::move(address), robot, token, std::move(hello), std::move(log))) {}

LinkClient::~LinkClient() = default;

bool LinkClient::up() const { return impl_->socket.up() && impl_->welcomed; }

std::vector<wire::ServerMessage> LinkClient::take_messages() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->messages, {});
}

void LinkClient::wait_for_message(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(impl_->mutex);
  impl_->came.wait_until(lock, until, [this] { return !impl_->messages.empty(); });
}

void LinkClient::send(const wire::AgentMessage& message) {
  if (!up()) return;
  auto bytes = wire::encode(message);
  if (std::holds_alternative<wire::Frame>(message)) {
    impl_->socket.send_newest(std::move(bytes));
  } else {
    impl_->socket.send(std::move(bytes));
  }
}

void LinkClient::send_encoded(std::vector<std::uint8_t> message) {
  if (up()) impl_->socket.send(std::move(message));
}

}  // namespace homeward::agent
