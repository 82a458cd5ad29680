// SPDX-License-Identifier: Apache-2.0
#include "agent/link/json_socket.hpp"

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace homeward::agent {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr auto kConnectLimit = std::chrono::seconds(5);
constexpr auto kSilenceLimit = std::chrono::seconds(2);
constexpr auto kPingPeriod = std::chrono::milliseconds(100);
constexpr auto kFirstPause = std::chrono::milliseconds(200);
constexpr auto kLongestPause = std::chrono::milliseconds(2000);

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

struct JsonSocket::Impl {
  ServerAddress address;
  std::size_t max_message_bytes = 0;
  Events events;

  std::atomic<bool> up{false};
  std::atomic<std::int64_t> answered_ms{0};  // when the newest ping that came back was sent; 0: none
  std::mutex mutex;
  std::deque<std::string> waiting;
  std::optional<std::string> newest;
  Clock::time_point newest_good_until;
  bool finishing = false;
  bool finished = false;       // everything that waited while finishing is sent, or never will be
  std::function<void()> wake;  // makes the connection look at what waits; set while connected
  std::function<void()> cut;
  std::condition_variable_any pause;
  std::condition_variable_any flushed;
  std::jthread thread;

  /// One connection, of the thread's alone.
  struct Connection {
    asio::io_context context{1};
    websocket::stream<beast::tcp_stream> socket{context};
    asio::steady_timer ping_timer{context};
    beast::flat_buffer buffer;
    std::string sending;
    std::string end = "closed";
    bool writing = false;
    bool pinging = false;
    bool open = false;
    bool closing = false;
    bool closed = false;
  };

  void run(const std::stop_token& stop) {
    auto backoff = kFirstPause;
    std::string logged_before;
    while (!stop.stop_requested()) {
      Connection connection;
      try {
        serve(connection, stop);
      } catch (const std::exception& broken) {
        connection.end = broken.what();
      }
      up = false;
      bool ended = false;
      {
        const std::lock_guard lock(mutex);
        wake = nullptr;
        cut = nullptr;
        waiting.clear();
        newest.reset();
        finished = ended = finishing;
      }
      flushed.notify_all();
      if (stop.stop_requested() || ended) return;
      if (connection.open) events.lost();
      const std::string what = (connection.open ? "connection lost: " : "no connection: ") + connection.end;
      // A robot that is switched off is said once, not every two seconds.
      if (what != logged_before) events.log(what);
      logged_before = what;
      backoff = connection.open ? kFirstPause : std::min<std::chrono::milliseconds>(backoff * 2, kLongestPause);
      std::unique_lock lock(mutex);
      pause.wait_for(lock, stop, backoff, [] { return false; });
    }
  }

  void serve(Connection& c, const std::stop_token& stop) {
    Tcp::resolver resolver(c.context);
    const auto targets = resolver.resolve(address.host, address.port);
    beast::get_lowest_layer(c.socket).expires_after(kConnectLimit);
    beast::get_lowest_layer(c.socket).async_connect(targets, [&](beast::error_code error, const Tcp::endpoint&) {
      if (error) return close(c, error.message());
      beast::get_lowest_layer(c.socket).socket().set_option(Tcp::no_delay(true));
      beast::get_lowest_layer(c.socket).expires_never();
      c.socket.set_option(websocket::stream_base::timeout{kConnectLimit, kSilenceLimit, false});
      c.socket.read_message_max(max_message_bytes);
      c.socket.async_handshake(address.host_header(), "/", [&](beast::error_code refused) {
        if (refused) return close(c, "the handshake failed: " + refused.message());
        begin(c);
      });
    });
    {
      const std::lock_guard lock(mutex);
      wake = [&c, this] { asio::post(c.context, [&c, this] { write_next(c); }); };
      cut = [&c, this] { asio::post(c.context, [&c, this] { close(c, "ended"); }); };
    }
    if (!stop.stop_requested()) c.context.run();
  }

  void begin(Connection& c) {
    c.open = true;
    c.socket.text(true);
    c.socket.control_callback([this](websocket::frame_type kind, beast::string_view payload) {
      if (kind != websocket::frame_type::pong || payload.empty() || payload.size() > 18) return;
      std::int64_t sent_ms = 0;
      for (const char digit : payload) {
        if (digit < '0' || digit > '9') return;
        sent_ms = 10 * sent_ms + (digit - '0');
      }
      // Only what was sent can have come back.
      if (sent_ms <= now_ms()) answered_ms = std::max(answered_ms.load(), sent_ms);
    });
    {
      std::vector<std::string> texts = events.greeting();
      const std::lock_guard lock(mutex);
      for (std::string& text : texts) waiting.push_back(std::move(text));
    }
    answered_ms = now_ms();
    up = true;
    events.log("connected to " + address.host_header());
    write_next(c);
    read_next(c);
    ping(c);
  }

  void ping(Connection& c) {
    c.ping_timer.expires_after(kPingPeriod);
    c.ping_timer.async_wait([&c, this](beast::error_code ended) {
      if (ended || c.closed) return;
      if (!std::exchange(c.pinging, true)) {
        const std::string payload = std::to_string(now_ms());
        c.socket.async_ping(websocket::ping_data(payload.data(), payload.size()), [&c, this](beast::error_code error) {
          c.pinging = false;
          if (error) close(c, error.message());
        });
      }
      ping(c);
    });
  }

  void write_next(Connection& c) {
    if (c.writing || !c.open || c.closing || c.closed) return;
    {
      const std::lock_guard lock(mutex);
      if (newest && Clock::now() > newest_good_until) newest.reset();
      if (newest && waiting.empty()) {
        c.sending = std::move(*newest);
        newest.reset();
      } else if (!waiting.empty()) {
        c.sending = std::move(waiting.front());
        waiting.pop_front();
      } else {
        if (!finishing) return;
        // A close in order: a socket that is closed with bytes unread may take back what was sent last.
        c.closing = true;
      }
    }
    if (c.closing) {
      c.socket.async_close(websocket::close_code::normal, [&c, this](beast::error_code) { close(c, "ended"); });
      return;
    }
    c.writing = true;
    c.socket.async_write(asio::buffer(c.sending), [&c, this](beast::error_code error, std::size_t) {
      c.writing = false;
      if (error) return close(c, error.message());
      write_next(c);
    });
  }

  void read_next(Connection& c) {
    c.socket.async_read(c.buffer, [&c, this](beast::error_code error, std::size_t) {
      if (error == websocket::error::message_too_big) return close(c, "a message was larger than allowed");
      if (error) return close(c, error.message());
      events.arrived({static_cast<const char*>(c.buffer.cdata().data()), c.buffer.size()});
      c.buffer.consume(c.buffer.size());
      read_next(c);
    });
  }

  void close(Connection& c, const std::string& why) {
    if (std::exchange(c.closed, true)) return;
    up = false;
    c.end = why;
    beast::get_lowest_layer(c.socket).close();
    c.context.stop();
  }
};

JsonSocket::JsonSocket(ServerAddress address, std::size_t max_message_bytes, Events events)
    : impl_(std::make_unique<Impl>()) {
  impl_->address = std::move(address);
  impl_->max_message_bytes = max_message_bytes;
  impl_->events = std::move(events);
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

JsonSocket::~JsonSocket() {
  impl_->thread.request_stop();
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->cut) impl_->cut();
  }
  impl_->thread.join();
}

bool JsonSocket::up() const { return impl_->up; }

std::chrono::milliseconds JsonSocket::lag() const {
  if (!impl_->up) return std::chrono::hours(1);
  return std::chrono::milliseconds(now_ms() - impl_->answered_ms);
}

void JsonSocket::send_newest(std::string text, std::chrono::steady_clock::time_point good_until) {
  if (!impl_->up) return;
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->wake || impl_->finishing) return;
  impl_->newest = std::move(text);
  impl_->newest_good_until = good_until;
  impl_->wake();
}

void JsonSocket::finish(std::vector<std::string> texts, std::chrono::milliseconds limit) {
  std::unique_lock lock(impl_->mutex);
  impl_->newest.reset();
  impl_->finishing = true;
  if (!impl_->up || !impl_->wake) return;
  for (std::string& text : texts) impl_->waiting.push_back(std::move(text));
  impl_->wake();
  impl_->flushed.wait_for(lock, limit, [&] { return impl_->finished; });
}

}  // namespace homeward::agent
