// SPDX-License-Identifier: Apache-2.0
#include "agent/link/socket_connection.hpp"

#include <openssl/ssl.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/rfc2818_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <type_traits>
#include <utility>

namespace homeward::agent {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Plain = beast::tcp_stream;
using Secure = beast::ssl_stream<beast::tcp_stream>;

/// When a ping was sent, as its payload says; nothing for a payload that is not ours.
std::optional<std::int64_t> sent_ms_of(beast::string_view payload) {
  if (payload.empty() || payload.size() > 18) return std::nullopt;
  std::int64_t sent_ms = 0;
  for (const char digit : payload) {
    if (digit < '0' || digit > '9') return std::nullopt;
    sent_ms = 10 * sent_ms + (digit - '0');
  }
  // Only what was sent can have come back.
  return sent_ms <= steady_now_ms() ? std::optional(sent_ms) : std::nullopt;
}

/// A context that trusts whom the system trusts.
asio::ssl::context verifying_context() {
  asio::ssl::context tls(asio::ssl::context::tls_client);
  tls.set_default_verify_paths();
  tls.set_verify_mode(asio::ssl::verify_peer);
  return tls;
}

/// `Stream`: Plain or Secure. Arguments of its constructor are what the stream takes besides the context.
template <class Stream>
class BeastConnection : public SocketConnection {
 public:
  template <class... Arguments>
  BeastConnection(const SocketOptions& options, ConnectionOwner& owner, Arguments&... arguments)
      : options_(options), owner_(owner), socket_(context_, arguments...) {}

  std::string run() override {
    Tcp::resolver resolver(context_);
    const auto targets = resolver.resolve(options_.address.host, options_.address.port);
    lowest().expires_after(options_.connect_limit);
    lowest().async_connect(targets, [this](beast::error_code error, const Tcp::endpoint&) {
      if (error) return close(error.message());
      lowest().socket().set_option(Tcp::no_delay(true));
      secure();
    });
    context_.run();
    return end_;
  }

  [[nodiscard]] ConnectionEnd::Stage stage() const override { return stage_; }

  void wake() override {
    asio::post(context_, [this] { write_next(); });
  }

  void cut(const std::string& why) override {
    asio::post(context_, [this, why] { close(why); });
  }

 protected:
  websocket::stream<Stream>& socket() { return socket_; }

 private:
  beast::tcp_stream& lowest() { return beast::get_lowest_layer(socket_); }

  void secure() {
    if constexpr (std::is_same_v<Stream, Secure>) {
      socket_.next_layer().async_handshake(asio::ssl::stream_base::client, [this](beast::error_code error) {
        if (error) return close(error.message());
        upgrade();
      });
    } else {
      upgrade();
    }
  }

  void upgrade() {
    stage_ = ConnectionEnd::Stage::kHandshake;
    lowest().expires_never();
    // With pings of Beast's own, or else its timer counts messages only, and whoever has nothing to say is lost.
    socket_.set_option(websocket::stream_base::timeout{options_.connect_limit, options_.silence_limit, true});
    socket_.set_option(websocket::stream_base::decorator([this](websocket::request_type& request) {
      for (const auto& [name, value] : options_.headers) request.set(name, value);
    }));
    socket_.read_message_max(options_.max_message_bytes);
    socket_.async_handshake(options_.address.host_header(), options_.path, [this](beast::error_code error) {
      if (error) return close(error.message());
      begin();
    });
  }

  void begin() {
    stage_ = ConnectionEnd::Stage::kOpen;
    socket_.text(options_.text);
    if (options_.ping_period) {
      socket_.control_callback([this](websocket::frame_type kind, beast::string_view payload) {
        if (kind != websocket::frame_type::pong) return;
        if (const auto sent_ms = sent_ms_of(payload)) owner_.answered(*sent_ms);
      });
    }
    owner_.opened();
    write_next();
    read_next();
    if (options_.ping_period) ping();
  }

  void ping() {
    ping_timer_.expires_after(*options_.ping_period);
    ping_timer_.async_wait([this](beast::error_code ended) {
      if (ended || closed_) return;
      if (!std::exchange(pinging_, true)) {
        const std::string payload = std::to_string(steady_now_ms());
        socket_.async_ping(websocket::ping_data(payload.data(), payload.size()), [this](beast::error_code error) {
          pinging_ = false;
          if (error) close(error.message());
        });
      }
      ping();
    });
  }

  void write_next() {
    if (writing_ || stage_ != ConnectionEnd::Stage::kOpen || closing_ || closed_) return;
    auto message = owner_.next_message();
    if (!message) {
      if (!owner_.closing()) return;
      // A close in order: a socket that is closed with bytes unread may take back what was sent last.
      closing_ = true;
      socket_.async_close(websocket::close_code::normal, [this](beast::error_code) { close("ended"); });
      return;
    }
    sending_ = std::move(*message);
    writing_ = true;
    socket_.async_write(asio::buffer(sending_), [this](beast::error_code error, std::size_t) {
      writing_ = false;
      if (error) return close(error.message());
      write_next();
    });
  }

  void read_next() {
    socket_.async_read(buffer_, [this](beast::error_code error, std::size_t) {
      if (error == websocket::error::message_too_big) return close("a message was larger than allowed");
      if (error == websocket::error::closed) return close("the other side closed it" + said_at_the_end());
      if (error) return close(error.message());
      const auto taken = owner_.arrived({static_cast<const std::uint8_t*>(buffer_.cdata().data()), buffer_.size()});
      buffer_.consume(buffer_.size());
      if (!taken) return close(taken.error().message);
      read_next();
    });
  }

  /// Why the other side closed the connection, where it says so; foreign words.
  [[nodiscard]] std::string said_at_the_end() const {
    std::string words(socket_.reason().reason.data(), socket_.reason().reason.size());
    for (char& c : words) {
      if (c < 0x20 || c > 0x7E) c = '?';
    }
    return words.empty() ? words : ": " + words;
  }

  void close(const std::string& why) {
    if (std::exchange(closed_, true)) return;
    // Down at once: nobody must trust the connection while timers of the socket run out.
    owner_.down();
    end_ = why;
    lowest().close();
    context_.stop();
  }

  const SocketOptions& options_;
  ConnectionOwner& owner_;
  asio::io_context context_{1};
  websocket::stream<Stream> socket_;
  asio::steady_timer ping_timer_{context_};
  beast::flat_buffer buffer_;
  std::vector<std::uint8_t> sending_;
  std::string end_ = "closed";
  ConnectionEnd::Stage stage_ = ConnectionEnd::Stage::kConnecting;
  bool writing_ = false;
  bool pinging_ = false;
  bool closing_ = false;
  bool closed_ = false;
};

/// Holds what the connection below it is made with.
struct Trust {
  asio::ssl::context tls = verifying_context();
};

class SecureConnection final : private Trust, public BeastConnection<Secure> {
 public:
  SecureConnection(const SocketOptions& options, ConnectionOwner& owner)
      : BeastConnection<Secure>(options, owner, Trust::tls) {
    Secure& stream = socket().next_layer();
    stream.set_verify_callback(asio::ssl::rfc2818_verification(options.address.host));
    // What SSL_set_tlsext_host_name does, without its old-style cast. It copies the name, which it does not change.
    std::string host = options.address.host;
    SSL_ctrl(stream.native_handle(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name, host.data());
  }
};

}  // namespace

std::int64_t steady_now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::unique_ptr<SocketConnection> make_connection(const SocketOptions& options, ConnectionOwner& owner) {
  if (options.address.tls) return std::make_unique<SecureConnection>(options, owner);
  return std::make_unique<BeastConnection<Plain>>(options, owner);
}

}  // namespace homeward::agent
