// SPDX-License-Identifier: Apache-2.0
#include "agent/link/link_client.hpp"

#include <openssl/ssl.h>

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/rfc2818_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <chrono>
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
using Bytes = std::vector<std::uint8_t>;

constexpr auto kConnectLimit = std::chrono::seconds(5);
constexpr std::size_t kMaxWaiting = 256;  // messages; a link that is so far behind is dead

}  // namespace

struct LinkClient::Impl {
  ServerAddress address;
  RobotId robot;
  std::string token;
  wire::Hello hello;
  std::function<void(const std::string&)> log;

  std::atomic<bool> up{false};
  bool welcomed = false;  // the server welcomed this connection; of the connection's thread alone
  std::mutex mutex;
  std::vector<wire::ServerMessage> arrived;
  std::deque<Bytes> waiting;
  std::optional<Bytes> frame;
  std::function<void()> wake;  // makes the connection look at what waits; set while connected
  std::function<void()> cut;
  std::condition_variable_any pause;
  std::condition_variable came;  // something has arrived
  std::jthread thread;

  void run(const std::stop_token& stop) {
    auto backoff = std::chrono::milliseconds(200);
    while (!stop.stop_requested()) {
      const auto begun = Clock::now();
      std::string end;
      try {
        end = address.tls ? connect_with_tls(stop) : connect_plain(stop);
      } catch (const std::exception& broken) {
        end = broken.what();
      }
      up = false;
      const bool was_up = std::exchange(welcomed, false);
      {
        const std::lock_guard lock(mutex);
        wake = nullptr;
        cut = nullptr;
        waiting.clear();
        frame.reset();
      }
      if (stop.stop_requested()) return;
      log((was_up ? "connection lost: " : "no connection: ") + end);
      if (Clock::now() - begun > std::chrono::seconds(5)) backoff = std::chrono::milliseconds(200);
      std::unique_lock lock(mutex);
      pause.wait_for(lock, stop, backoff, [] { return false; });
      backoff = std::min(backoff * 2, std::chrono::milliseconds(2000));
    }
  }

  std::string connect_plain(const std::stop_token& stop) {
    asio::io_context context(1);
    websocket::stream<beast::tcp_stream> socket(context);
    return serve(context, socket, stop);
  }

  std::string connect_with_tls(const std::stop_token& stop) {
    asio::io_context context(1);
    asio::ssl::context tls(asio::ssl::context::tls_client);
    tls.set_default_verify_paths();
    tls.set_verify_mode(asio::ssl::verify_peer);
    websocket::stream<beast::ssl_stream<beast::tcp_stream>> socket(context, tls);
    socket.next_layer().set_verify_callback(asio::ssl::rfc2818_verification(address.host));
    // What SSL_set_tlsext_host_name does, without its old-style cast.
    SSL_ctrl(socket.next_layer().native_handle(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
             address.host.data());
    return serve(context, socket, stop);
  }

  /// One connection from its first byte to its last. Returns why it ended.
  template <class Socket>
  std::string serve(asio::io_context& context, Socket& socket, const std::stop_token& stop) {
    std::string end = "closed";
    beast::flat_buffer buffer;
    bool writing = false;
    bool hello_sent = false;
    Bytes sending;
    bool closed = false;
    const auto close = [&](const std::string& why) {
      if (std::exchange(closed, true)) return;
      // Down at once: the robot must not trust the link while timers of the socket run out.
      up = false;
      end = why;
      beast::get_lowest_layer(socket).close();
      context.stop();
    };
    std::function<void()> write_next = [&] {
      if (writing || !hello_sent) return;
      {
        const std::lock_guard lock(mutex);
        if (!waiting.empty()) {
          sending = std::move(waiting.front());
          waiting.pop_front();
        } else if (frame) {
          sending = std::move(*frame);
          frame.reset();
        } else {
          return;
        }
      }
      writing = true;
      socket.async_write(asio::buffer(sending), [&](beast::error_code error, std::size_t) {
        writing = false;
        if (error) return close(error.message());
        write_next();
      });
    };
    std::function<void()> read_next = [&] {
      socket.async_read(buffer, [&](beast::error_code error, std::size_t) {
        if (error) return close(error.message());
        const auto* bytes = static_cast<const std::uint8_t*>(buffer.cdata().data());
        auto message = wire::decode_server_message({bytes, buffer.size()});
        buffer.consume(buffer.size());
        if (!message) return close("the server sent what is no message: " + message.error().message);
        if (std::holds_alternative<wire::Welcome>(*message)) {
          up = welcomed = true;
          log("connected to " + address.host_header());
        }
        {
          const std::lock_guard lock(mutex);
          arrived.push_back(std::move(*message));
        }
        came.notify_one();
        read_next();
      });
    };
    const auto greet = [&] {
      socket.binary(true);
      socket.read_message_max(wire::kMaxLinkMessageBytes);
      sending = wire::encode(wire::AgentMessage(hello));
      writing = true;
      hello_sent = true;
      socket.async_write(asio::buffer(sending), [&](beast::error_code error, std::size_t) {
        writing = false;
        if (error) return close(error.message());
        write_next();
      });
      read_next();
    };
    const auto upgrade = [&] {
      beast::get_lowest_layer(socket).expires_never();
      websocket::stream_base::timeout limits{kConnectLimit, std::chrono::seconds(2), true};
      socket.set_option(limits);
      socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
        request.set(beast::http::field::authorization, "Bearer " + token);
        request.set(beast::http::field::user_agent, hello.agent);
      }));
      socket.async_handshake(address.host_header(), "/api/v1/robots/" + robot.str() + "/link",
                             [&](beast::error_code error) {
                               if (error) return close("the server refused the link: " + error.message());
                               greet();
                             });
    };
    Tcp::resolver resolver(context);
    const auto targets = resolver.resolve(address.host, address.port);
    beast::get_lowest_layer(socket).expires_after(kConnectLimit);
    beast::get_lowest_layer(socket).async_connect(targets, [&](beast::error_code error, const Tcp::endpoint&) {
      if (error) return close(error.message());
      beast::get_lowest_layer(socket).socket().set_option(Tcp::no_delay(true));
      if constexpr (requires {
                      socket.next_layer().async_handshake(asio::ssl::stream_base::client, [](beast::error_code) {});
                    }) {
        socket.next_layer().async_handshake(asio::ssl::stream_base::client, [&](beast::error_code tls_error) {
          if (tls_error) return close(tls_error.message());
          upgrade();
        });
      } else {
        upgrade();
      }
    });
    {
      const std::lock_guard lock(mutex);
      wake = [&] { asio::post(context, [&] { write_next(); }); };
      cut = [&] { asio::post(context, [&] { close("ended"); }); };
    }
    if (stop.stop_requested()) return "ended";
    context.run();
    return end;
  }
};

LinkClient::LinkClient(ServerAddress address, RobotId robot, std::string token, wire::Hello hello,
                       std::function<void(const std::string&)> log)
    : impl_(std::make_unique<Impl>()) {
  impl_->address = std::move(address);
  impl_->robot = std::move(robot);
  impl_->token = std::move(token);
  impl_->hello = std::move(hello);
  impl_->log = std::move(log);
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

LinkClient::~LinkClient() {
  impl_->thread.request_stop();
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->cut) impl_->cut();
  }
  impl_->thread.join();
}

bool LinkClient::up() const { return impl_->up; }

std::vector<wire::ServerMessage> LinkClient::take_messages() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->arrived, {});
}

void LinkClient::wait_for_message(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(impl_->mutex);
  impl_->came.wait_until(lock, until, [this] { return !impl_->arrived.empty(); });
}

void LinkClient::send(const wire::AgentMessage& message) {
  if (!impl_->up) return;
  Bytes bytes = wire::encode(message);
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->wake) return;
  if (std::holds_alternative<wire::Frame>(message)) {
    impl_->frame = std::move(bytes);
  } else {
    impl_->waiting.push_back(std::move(bytes));
    if (impl_->waiting.size() > kMaxWaiting && impl_->cut) impl_->cut();
  }
  impl_->wake();
}

}  // namespace homeward::agent
