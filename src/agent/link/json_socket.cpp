// SPDX-License-Identifier: Apache-2.0
#include "agent/link/json_socket.hpp"

#include <utility>

namespace homeward::agent {
namespace {

constexpr auto kPingPeriod = std::chrono::milliseconds(100);

ReconnectingSocket::Message bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

std::vector<ReconnectingSocket::Message> bytes_of(const std::vector<std::string>& texts) {
  std::vector<ReconnectingSocket::Message> messages;
  messages.reserve(texts.size());
  for (const std::string& text : texts) messages.push_back(bytes_of(std::string_view(text)));
  return messages;
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {static_cast<const char*>(static_cast<const void*>(bytes.data())), bytes.size()};
}

SocketOptions options_for(WebSocketAddress address, std::size_t max_message_bytes) {
  SocketOptions options;
  options.address = std::move(address.server);
  options.path = std::move(address.path);
  options.text = true;
  options.max_message_bytes = max_message_bytes;
  options.ping_period = kPingPeriod;
  return options;
}

}  // namespace

JsonSocket::JsonSocket(WebSocketAddress address, std::size_t max_message_bytes, Events events)
    : events_(std::move(events)),
      name_(address.server.host_header()),
      socket_(options_for(std::move(address), max_message_bytes), {[this] { return greeting(); },
                                                                   [this](std::span<const std::uint8_t> message) {
                                                                     arrived(text_of(message));
                                                                     return Status();
                                                                   },
                                                                   [this](const ConnectionEnd& end) { ended(end); }}) {}

void JsonSocket::send_newest(std::string_view text, std::chrono::steady_clock::time_point good_until) {
  if (socket_.up()) socket_.send_newest(bytes_of(text), good_until);
}

void JsonSocket::finish(const std::vector<std::string>& texts, std::chrono::milliseconds limit) {
  socket_.finish(bytes_of(texts), limit);
}

std::vector<ReconnectingSocket::Message> JsonSocket::greeting() {
  auto messages = bytes_of(events_.greeting());
  if (!unheard_) events_.log("connected to " + name_);
  return messages;
}

void JsonSocket::arrived(std::string_view text) {
  if (std::exchange(unheard_, false)) events_.log("connected to " + name_);
  events_.arrived(text, socket_.lag());
}

void JsonSocket::ended(const ConnectionEnd& end) {
  const bool was_open = end.stage == ConnectionEnd::Stage::kOpen;
  if (was_open) events_.lost();
  std::string what = was_open ? "connection lost: " : "no connection: ";
  if (end.stage == ConnectionEnd::Stage::kHandshake) what += "the handshake failed: ";
  what += end.why;
  const bool unheard = was_open && !end.heard;
  if (unheard) what += "; it said nothing before" + (events_.if_unheard.empty() ? "" : ": " + events_.if_unheard);
  // It may end now in this way, now in that.
  if (std::exchange(unheard_, unheard) && unheard) return;
  if (what != logged_before_) events_.log(what);
  logged_before_ = std::move(what);
}

}  // namespace homeward::agent
