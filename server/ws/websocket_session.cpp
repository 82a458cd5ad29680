// SPDX-License-Identifier: Apache-2.0
#include "server/ws/websocket_session.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

namespace homeward::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using beast::error_code;

constexpr std::chrono::seconds kHandshakeTimeout{10};
// Pings go out at half of it; an end that does not even answer those is gone.
constexpr std::chrono::seconds kIdleTimeout{20};
// For each 64 KiB of a message to be taken, and a part of them; an end that reads nothing may still send.
constexpr std::chrono::seconds kTakenWithin{10};
constexpr std::size_t kTaken_bytes = 64UL * 1024;

}  // namespace

WebSocketSession::WebSocketSession(beast::tcp_stream stream, std::shared_ptr<SocketHandler> handler,
                                   std::function<void()> on_end)
    : stream_(std::move(stream)),
      executor_(stream_.get_executor()),
      handler_(std::move(handler)),
      on_end_(std::move(on_end)),
      taken_within_(executor_) {}

WebSocketSession::~WebSocketSession() { end(); }

template <class Call>
bool WebSocketSession::guarded(const Call& call) {
  try {
    call();
    return true;
  } catch (const std::exception& exception) {
    spdlog::error("a socket was ended by a fault: {}", exception.what());
    cut();
    return false;
  }
}

void WebSocketSession::accept(HttpRequest request) {
  request_ = std::move(request);
  beast::get_lowest_layer(stream_).expires_never();
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = kHandshakeTimeout;
  timeout.idle_timeout = kIdleTimeout;
  timeout.keep_alive_pings = true;
  stream_.set_option(timeout);
  stream_.read_message_max(handler_->max_message_bytes());
  error_code ignored;
  beast::get_lowest_layer(stream_).socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  stream_.async_accept(request_, [self = shared_from_this()](error_code error) {
    if (error || self->ended_) return self->end();
    self->open_ = true;
    self->request_ = {};
    if (!self->guarded([&] { self->handler_->on_open(self); })) return;
    self->read();
    self->write();
  });
}

void WebSocketSession::wake() {
  asio::post(executor_, [self = shared_from_this()] { self->write(); });
}

void WebSocketSession::close(std::uint16_t code, const std::string& reason) {
  // A close frame has room for 123 bytes.
  websocket::close_reason why(static_cast<websocket::close_code>(code), reason.substr(0, 120));
  asio::post(executor_, [self = shared_from_this(), why] {
    if (self->closing_ || self->ended_) return;
    self->closing_ = true;
    self->close_reason_ = why;
    if (!self->writing_) self->begin_close();
  });
}

void WebSocketSession::cut() {
  error_code ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
  end();
}

void WebSocketSession::begin_close() {
  if (!open_) return cut();
  stream_.async_close(close_reason_, [self = shared_from_this()](error_code) { self->cut(); });
}

void WebSocketSession::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->cut();
    if (self->ended_) return;
    const auto data = self->buffer_.cdata();
    const bool text = self->stream_.got_text();
    const std::span bytes(static_cast<const std::uint8_t*>(data.data()), data.size());
    if (!self->guarded([&] { self->handler_->on_message(bytes, text); })) return;
    self->buffer_.consume(self->buffer_.size());
    self->read();
  });
}

void WebSocketSession::write() {
  if (!open_ || writing_ || ended_) return;
  if (closing_) return;
  std::optional<Outgoing> next;
  if (!guarded([&] { next = handler_->next_message(); }) || !next) return;
  being_written_ = std::move(*next);
  writing_ = true;
  taken_within_.expires_after(kTakenWithin * (1 + static_cast<int>(being_written_.bytes->size() / kTaken_bytes)));
  taken_within_.async_wait([weak = weak_from_this()](error_code error) {
    const auto self = weak.lock();
    // It may have run out just as that message was taken, and the next one was begun.
    const bool late = self && self->taken_within_.expiry() <= std::chrono::steady_clock::now();
    if (!error && late && self->writing_) self->cut();
  });
  stream_.text(being_written_.text);
  stream_.async_write(asio::buffer(*being_written_.bytes), [self = shared_from_this()](error_code error, std::size_t) {
    self->writing_ = false;
    self->taken_within_.cancel();
    if (error) return self->cut();
    if (self->closing_) return self->begin_close();
    self->write();
  });
}

void WebSocketSession::end() {
  if (ended_) return;
  ended_ = true;
  if (open_) handler_->on_closed();
  if (on_end_) on_end_();
}

}  // namespace homeward::server
