// SPDX-License-Identifier: Apache-2.0
#include "server/http/http_server.hpp"

#include <utility>

#include <boost/asio.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <future>
#include <limits>
#include <set>
#include <thread>

#include "server/http/access.hpp"
#include "server/ws/websocket_session.hpp"

namespace homeward::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using beast::error_code;
using Parser = http::request_parser<http::string_body>;

/// Lets a coroutine wait for an answer that another thread will post.
template <class T>
struct Waiter {
  explicit Waiter(const asio::any_io_executor& on) : executor(on), timer(on) {
    timer.expires_at(std::chrono::steady_clock::time_point::max());
  }
  asio::any_io_executor executor;
  asio::steady_timer timer;
  std::optional<T> answer;
};

template <class T>
std::function<void(T)> reply_to(std::shared_ptr<Waiter<T>> waiter) {
  return [waiter](T answer) {
    asio::post(waiter->executor, [waiter, answer = std::move(answer)]() mutable {
      waiter->answer = std::move(answer);
      waiter->timer.cancel();
    });
  };
}

std::string text_of(beast::string_view view) { return {view.data(), view.size()}; }

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

// What Beast has read as our own plain struct; a response when it is not worth reading on.
std::variant<std::shared_ptr<Request>, Response> plain_request(const Parser& parser, const std::string& remote) {
  const auto& head = parser.get();
  auto request = std::make_shared<Request>();
  request->method = text_of(head.method_string());
  request->remote = remote;
  const std::string target = text_of(head.target());
  if (target.empty() || target.front() != '/') return problem(400, "Bad request", "The request names no path.");
  const std::size_t question = std::min(target.find('?'), target.size());
  request->path = target.substr(0, question);
  if (!percent_decoded(request->path)) return problem(400, "Bad request", "The path has a broken escape.");
  auto query = parse_query(std::string_view(target).substr(std::min(question + 1, target.size())));
  if (!query) return problem(400, "Bad request", "The query has a broken escape.");
  request->query = std::move(*query);
  int hosts = 0;
  for (const auto& field : head) {
    const std::string name = lower(text_of(field.name_string()));
    if (name == "host") ++hosts;
    const auto [at, added] = request->headers.emplace(name, text_of(field.value()));
    if (!added && name == "cookie") at->second += "; " + text_of(field.value());
  }
  if (hosts != 1) return problem(400, "Bad request", "The request needs exactly one Host header.");
  return request;
}

}  // namespace

struct HttpServer::State {
  State(Front& front_in, const ServerLimits& limits_in) : front(front_in), limits(limits_in), acceptor(context) {}

  asio::awaitable<void> accept_all();
  asio::awaitable<void> serve(beast::tcp_stream stream);
  asio::awaitable<bool> exchange(beast::tcp_stream& stream, beast::flat_buffer& buffer, const std::string& remote);
  asio::awaitable<void> upgrade(beast::tcp_stream& stream, Parser& parser, std::shared_ptr<Request> request);
  asio::awaitable<void> refuse(beast::tcp_stream& stream, Response response, unsigned version, bool head);
  asio::awaitable<bool> write(beast::tcp_stream& stream, Response response, unsigned version, bool head, bool keep);
  void tick(const std::shared_ptr<asio::steady_timer>& timer, int period_ms,
            const std::shared_ptr<std::function<void()>>& call);
  void cut_all();

  Front& front;
  ServerLimits limits;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  std::uint16_t port = 0;
  int connections = 0;
  std::map<const WebSocketSession*, std::weak_ptr<WebSocketSession>> sockets;
  std::set<beast::tcp_stream*> streams;
  std::jthread thread;
  bool stopped = false;
  bool cutting = false;  // socket thread alone
};

asio::awaitable<void> HttpServer::State::accept_all() {
  while (acceptor.is_open()) {
    error_code error;
    tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
    if (error == asio::error::operation_aborted) co_return;
    if (error) {  // out of descriptors, or the other end has gone already
      asio::steady_timer pause(context, std::chrono::milliseconds(50));
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
      continue;
    }
    if (connections >= limits.max_connections) continue;  // closes it
    ++connections;
    asio::co_spawn(context, serve(beast::tcp_stream(std::move(socket))), asio::detached);
  }
}

asio::awaitable<void> HttpServer::State::serve(beast::tcp_stream stream) {
  streams.insert(&stream);
  error_code error;
  stream.socket().set_option(tcp::no_delay(true), error);
  const tcp::endpoint peer = stream.socket().remote_endpoint(error);
  if (!error) {
    const std::string remote = peer.address().to_string();
    beast::flat_buffer buffer;
    bool more = true;
    try {
      while (more) more = co_await exchange(stream, buffer, remote);
    } catch (const std::exception&) {
      // The connection is dropped; there is nobody to tell.
    }
  }
  streams.erase(&stream);
  --connections;
  if (stream.socket().is_open()) {
    stream.socket().shutdown(tcp::socket::shutdown_both, error);
    stream.socket().close(error);
  }
}

/// One request and its answer. Returns whether the connection stays.
asio::awaitable<bool> HttpServer::State::exchange(beast::tcp_stream& stream, beast::flat_buffer& buffer,
                                                  const std::string& remote) {
  Parser parser;
  parser.header_limit(static_cast<std::uint32_t>(limits.max_header_bytes));
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // the route decides, once the head was read
  error_code error;
  stream.expires_after(std::chrono::milliseconds(limits.header_timeout_ms));
  co_await http::async_read_header(stream, buffer, parser, asio::redirect_error(asio::use_awaitable, error));
  if (error == http::error::header_limit) {
    Response large = problem(431, "Header too large", "The head of the request is larger than 16 KiB.");
    co_await refuse(stream, std::move(large), 11, false);
    co_return false;
  }
  if (error == http::error::end_of_stream || error == asio::error::operation_aborted ||
      error == beast::error::timeout) {
    co_return false;
  }
  if (error) {
    if (error.category() == http::make_error_code(http::error::bad_version).category()) {
      Response bad = problem(400, "Bad request", "This is not HTTP/1.1: " + error.message() + ".");
      co_await write(stream, std::move(bad), 11, false, false);
    }
    co_return false;
  }
  const unsigned version = parser.get().version();
  const bool head = parser.get().method() == http::verb::head;
  auto read = plain_request(parser, remote);
  if (auto* refusal = std::get_if<Response>(&read)) {
    co_await write(stream, std::move(*refusal), version, head, false);
    co_return false;
  }
  std::shared_ptr<Request> request = std::get<std::shared_ptr<Request>>(read);
  if (beast::websocket::is_upgrade(parser.get())) {
    co_await upgrade(stream, parser, request);
    co_return false;
  }
  auto admitted = front.admit(*request);
  if (auto* limit = std::get_if<std::size_t>(&admitted)) {
    const auto length = parser.content_length();
    if (length && *length > *limit) {
      admitted = problem(
          {ErrorCode::kTooLarge,
           "The body has " + std::to_string(*length) + " bytes; at most " + std::to_string(*limit) + " are taken here.",
           request->path});
    }
  }
  if (auto* refusal = std::get_if<Response>(&admitted)) {
    if (!parser.is_done()) {
      co_await refuse(stream, std::move(*refusal), version, head);
      co_return false;
    }
    const bool keep = parser.get().keep_alive();
    const bool kept = co_await write(stream, std::move(*refusal), version, head, keep);
    co_return kept;
  }
  if (!parser.is_done()) {
    parser.body_limit(std::get<std::size_t>(admitted));
    stream.expires_after(std::chrono::milliseconds(limits.body_timeout_ms));
    if (lower(request->header("expect")) == "100-continue") {
      http::response<http::empty_body> go_on(http::status::continue_, version);
      co_await http::async_write(stream, go_on, asio::redirect_error(asio::use_awaitable, error));
    }
    co_await http::async_read(stream, buffer, parser, asio::redirect_error(asio::use_awaitable, error));
    if (error == http::error::body_limit) {
      Response large = problem({ErrorCode::kTooLarge, "The body is larger than this route takes.", request->path});
      co_await refuse(stream, std::move(large), version, head);
      co_return false;
    }
    if (error) co_return false;
  }
  const bool keep = parser.get().keep_alive();
  request->body = std::move(parser.get().body());
  stream.expires_never();
  auto waiter = std::make_shared<Waiter<Response>>(asio::any_io_executor(context.get_executor()));
  front.answer(request, reply_to<Response>(waiter));
  while (!waiter->answer) co_await waiter->timer.async_wait(asio::redirect_error(asio::use_awaitable, error));
  Response response = std::move(*waiter->answer);
  const bool kept = co_await write(stream, std::move(response), version, head, keep);
  co_return kept;
}

/// Answers before the request was read to its end, then takes what still comes for a moment: closing at once would make
/// the other end's system throw the answer away.
asio::awaitable<void> HttpServer::State::refuse(beast::tcp_stream& stream, Response response, unsigned version,
                                                bool head) {
  co_await write(stream, std::move(response), version, head, false);
  error_code error;
  stream.socket().shutdown(tcp::socket::shutdown_send, error);
  stream.expires_after(std::chrono::seconds(2));
  std::array<char, 16384> thrown_away{};
  std::size_t total = 0;
  while (!error && total < kMaxImageBody) {
    total +=
        co_await stream.async_read_some(asio::buffer(thrown_away), asio::redirect_error(asio::use_awaitable, error));
  }
}

asio::awaitable<bool> HttpServer::State::write(beast::tcp_stream& stream, Response response, unsigned version,
                                               bool head, bool keep) {
  add_security_headers(response);
  http::response<http::string_body> message;
  message.version(version);
  message.result(static_cast<unsigned>(response.status));
  for (const auto& [name, value] : response.headers) message.set(name, value);
  message.keep_alive(keep);
  const bool no_body = response.status == 204 || response.status == 304;
  if (!no_body) message.content_length(response.body.size());
  if (!head && !no_body) message.body() = std::move(response.body);
  error_code error;
  stream.expires_after(std::chrono::milliseconds(limits.body_timeout_ms));
  http::response_serializer<http::string_body> serializer(message);
  if (head || no_body) {
    co_await http::async_write_header(stream, serializer, asio::redirect_error(asio::use_awaitable, error));
  } else {
    co_await http::async_write(stream, serializer, asio::redirect_error(asio::use_awaitable, error));
  }
  co_return keep && !error;
}

asio::awaitable<void> HttpServer::State::upgrade(beast::tcp_stream& stream, Parser& parser,
                                                 std::shared_ptr<Request> request) {
  auto waiter = std::make_shared<Waiter<Upgrade>>(asio::any_io_executor(context.get_executor()));
  stream.expires_never();
  front.upgrade(request, reply_to<Upgrade>(waiter));
  error_code error;
  while (!waiter->answer) co_await waiter->timer.async_wait(asio::redirect_error(asio::use_awaitable, error));
  Upgrade answer = std::move(*waiter->answer);
  if (cutting) co_return;
  if (auto* refusal = std::get_if<Response>(&answer)) {
    co_await write(stream, std::move(*refusal), parser.get().version(), false, false);
    co_return;
  }
  // The connection is now the socket's; the place it took is given back when the socket ends.
  ++connections;
  auto key = std::make_shared<const WebSocketSession*>(nullptr);
  auto session = std::make_shared<WebSocketSession>(std::move(stream), std::get<std::shared_ptr<SocketHandler>>(answer),
                                                    [this, key] {
                                                      --connections;
                                                      sockets.erase(*key);
                                                    });
  *key = session.get();
  sockets[session.get()] = session;
  session->accept(parser.release());
}

void HttpServer::State::tick(const std::shared_ptr<asio::steady_timer>& timer, int period_ms,
                             const std::shared_ptr<std::function<void()>>& call) {
  timer->expires_after(std::chrono::milliseconds(period_ms));
  timer->async_wait([this, timer, period_ms, call](error_code error) {
    if (error) return;
    (*call)();
    tick(timer, period_ms, call);
  });
}

void HttpServer::State::cut_all() {
  cutting = true;
  error_code ignored;
  acceptor.close(ignored);
  const auto open = sockets;
  for (const auto& [key, weak] : open) {
    if (const auto session = weak.lock()) session->cut();
  }
  for (beast::tcp_stream* stream : streams) stream->cancel();
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
  if (error) return fail(ErrorCode::kIo, "Cannot listen on " + where + ": " + error.message() + ".", where);
  state.port = state.acceptor.local_endpoint().port();
  asio::co_spawn(state.context, state.accept_all(), asio::detached);
  state.thread = std::jthread([&state] { state.context.run(); });
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
