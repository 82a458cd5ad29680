// SPDX-License-Identifier: Apache-2.0
#include "support/rest_server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

namespace homeward::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;

struct RestServer::Impl {
  explicit Impl(Handler reply)
      : handler(std::move(reply)), acceptor(context, {asio::ip::make_address("127.0.0.1"), 0}) {
    accept();
    thread = std::jthread([this] { context.run(); });
  }
  ~Impl() {
    context.stop();
    thread.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void accept() {
    acceptor.async_accept([this](const beast::error_code& error, Tcp::socket socket) {
      if (error) return;
      stream.emplace(std::move(socket));
      buffer.clear();
      read();
      accept();
    });
  }

  void read() {
    request = {};
    http::async_read(*stream, buffer, request, [this](const beast::error_code& error, std::size_t) {
      if (!error) answer();
    });
  }

  void answer() {
    const Reply reply = handler({std::string(request.method_string()), std::string(request.target()),
                                 std::string(request["Idempotency-Key"]), request.body()});
    if (reply.lost) return stream->close();
    http::response<http::string_body> response(static_cast<http::status>(reply.status), request.version());
    response.body() = reply.body;
    response.keep_alive(true);
    response.prepare_payload();
    beast::error_code error;
    http::write(*stream, response, error);
    if (!error) read();
  }

  const Handler handler;
  asio::io_context context{1};
  Tcp::acceptor acceptor;
  std::optional<beast::tcp_stream> stream;
  beast::flat_buffer buffer;
  http::request<http::string_body> request;
  std::jthread thread;  // last: it uses all of the above
};

RestServer::RestServer(Handler handler) : impl_(std::make_unique<Impl>(std::move(handler))) {}
RestServer::~RestServer() = default;

unsigned short RestServer::port() const { return impl_->acceptor.local_endpoint().port(); }

}  // namespace homeward::testing
