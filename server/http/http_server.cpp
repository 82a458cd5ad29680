// SPDX-License-Identifier: Apache-2.0
#include "server/http/http_server.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include <boost/asio.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <chrono>
#include <future>
#include <thread>

#include "server/http/connection.hpp"

namespace homeward::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using beast::error_code;

}  // namespace

struct HttpServer::State {
  State(Front& front_in, const ServerLimits& limits_in) : front(front_in), limits(limits_in), acceptor(context) {}

  void run();
  asio::awaitable<void> accept_all();
  void begin(tcp::socket socket);
  void accept_waiting();
  void tick(const std::shared_ptr<asio::steady_timer>& timer, int period_ms,
            const std::shared_ptr<std::function<void()>>& call);
  void close_unwelcome();
  void cut_all();

  Front& front;
  ServerLimits limits;
  OpenConnections open{limits.connections};  // outlives the context: what waits there gives its place back when it goes
  std::vector<OpenSocket> sockets;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  std::uint16_t port = 0;
  std::jthread thread;
  bool stopped = false;
  bool ending = false;  // socket thread alone
};

void HttpServer::State::begin(tcp::socket socket) {
  asio::co_spawn(
      context, serve_connection({front, limits, context, open, sockets, ending}, beast::tcp_stream(std::move(socket))),
      asio::detached);
}

// Connections that wait behind the one that was accepted. One at a time would be one for each round of all that is
// ready: fewer than a flood opens while large answers are written, and who comes to stop a robot would wait behind
// them.
void HttpServer::State::accept_waiting() {
  constexpr int kAtOnce = 64;
  for (int i = 0; i < kAtOnce && acceptor.is_open(); ++i) {
    error_code error;
    tcp::socket socket(context);
    acceptor.accept(socket, error);
    if (error) return;
    begin(std::move(socket));
  }
}

asio::awaitable<void> HttpServer::State::accept_all() {
  while (acceptor.is_open()) {
    error_code error;
    bool short_of_something = false;  // descriptors or memory; or the other end has gone already
    try {
      tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
      if (error == asio::error::operation_aborted) co_return;
      short_of_something = static_cast<bool>(error);
      if (!error) {
        begin(std::move(socket));
        accept_waiting();
      }
    } catch (const std::exception& exception) {
      spdlog::error("a connection could not be taken: {}", exception.what());
      short_of_something = true;
    }
    if (!short_of_something) continue;
    asio::steady_timer pause(context, std::chrono::milliseconds(50));
    co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
  }
}

// What a connection throws outside its own coroutine ends what it was in the middle of, and with it the connection. All
// others go on.
void HttpServer::State::run() {
  while (!context.stopped()) {
    try {
      context.run();
    } catch (const std::exception& exception) {
      spdlog::error("a connection was ended by a fault: {}", exception.what());
    }
  }
}

void HttpServer::State::tick(const std::shared_ptr<asio::steady_timer>& timer, int period_ms,
                             const std::shared_ptr<std::function<void()>>& call) {
  timer->expires_after(std::chrono::milliseconds(period_ms));
  timer->async_wait([this, timer, period_ms, call](error_code error) {
    if (error) return;
    try {
      (*call)();
    } catch (const std::exception& exception) {
      spdlog::error("what is done every {} ms has failed: {}", period_ms, exception.what());
    }
    tick(timer, period_ms, call);
  });
}

void HttpServer::State::close_unwelcome() {
  std::erase_if(sockets, [&](const OpenSocket& socket) {
    const auto session = socket.session.lock();
    if (!session) return true;
    if (front.still_welcome(*socket.handshake)) return false;
    session->close(kClosePolicy, "What this was opened with does not hold any more.");
    return true;
  });
}

void HttpServer::State::cut_all() {
  ending = true;
  error_code ignored;
  acceptor.close(ignored);
  open.cut_all();
}

HttpServer::HttpServer() = default;

Result<std::unique_ptr<HttpServer>> HttpServer::start(const std::string& address, std::uint16_t port, Front& front,
                                                      const ServerLimits& limits) {
  std::unique_ptr<HttpServer> server(new HttpServer());
  server->state_ = std::make_unique<State>(front, limits);
  State& state = *server->state_;
  const std::string where = address + ":" + std::to_string(port);
  error_code error;
  const auto ip = asio::ip::make_address(address == "localhost" ? "127.0.0.1" : address, error);
  if (error) return fail(ErrorCode::kInvalidInput, "\"" + address + "\" is not an IP address to listen on.", where);
  const tcp::endpoint endpoint(ip, port);
  state.acceptor.open(endpoint.protocol(), error);
  if (!error) state.acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) state.acceptor.bind(endpoint, error);
  if (!error) state.acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) state.acceptor.non_blocking(true, error);
  if (error) return fail(ErrorCode::kIo, "Cannot listen on " + where + ": " + error.message() + ".", where);
  state.port = state.acceptor.local_endpoint().port();
  asio::co_spawn(state.context, state.accept_all(), asio::detached);
  constexpr int kLookAtSocketsEvery_ms = 500;
  server->every(kLookAtSocketsEvery_ms, [&state] { state.close_unwelcome(); });
  state.thread = std::jthread([&state] { state.run(); });
  return server;
}

HttpServer::~HttpServer() { stop(); }

std::uint16_t HttpServer::port() const { return state_->port; }

void HttpServer::every(int period_ms, std::function<void()> call) {
  auto shared = std::make_shared<std::function<void()>>(std::move(call));
  asio::post(state_->context, [this, period_ms, shared] {
    state_->tick(std::make_shared<asio::steady_timer>(state_->context), period_ms, shared);
  });
}

void HttpServer::stop() {
  if (!state_ || state_->stopped) return;
  state_->stopped = true;
  if (!state_->thread.joinable()) return;
  std::promise<void> cut;
  asio::post(state_->context, [this, &cut] {
    state_->cut_all();
    cut.set_value();
  });
  cut.get_future().wait();
  state_->context.stop();
  state_->thread.join();
}

}  // namespace homeward::server
