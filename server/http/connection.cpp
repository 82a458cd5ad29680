// SPDX-License-Identifier: Apache-2.0
#include "server/http/connection.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <sstream>
#include <string_view>

#include "server/http/access.hpp"
#include "server/http/request_parser.hpp"

namespace homeward::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using beast::error_code;

constexpr std::chrono::seconds kSettle{2};
constexpr std::chrono::seconds kSettleOfKnown{10};      // between two pieces; a shaky network may pause for seconds
constexpr std::size_t kReadBuffer_bytes = 32UL * 1024;  // has room for the largest head

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

/// The answer that `ask` gets for the callback that it is called with.
template <class T, class Ask>
asio::awaitable<T> answer_of(asio::io_context& context, Ask ask) {
  auto waiter = std::make_shared<Waiter<T>>(asio::any_io_executor(context.get_executor()));
  ask(reply_to<T>(waiter));
  error_code ignored;
  while (!waiter->answer) co_await waiter->timer.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
  co_return std::move(*waiter->answer);
}

bool is_of_http(const error_code& error) {
  return error.category() == http::make_error_code(http::error::bad_version).category();
}

/// The head of a request as Beast's WebSocket wants it.
WebSocketSession::HttpRequest handshake_of(const RequestParser& parser) {
  WebSocketSession::HttpRequest request;
  request.version(parser.version());
  request.method_string(parser.method());
  request.target(parser.target());
  for (const auto& [name, value] : parser.fields()) request.insert(name, value);
  return request;
}

// What a coroutine is called with is named first: GCC 12 destroys some temporaries of a co_await expression twice.
class Connection {
 public:
  Connection(Serving serving, std::shared_ptr<ConnectionPlace> place, beast::tcp_stream& stream, std::string remote)
      : serving_(serving),
        place_(std::move(place)),
        stream_(stream),
        remote_(std::move(remote)),
        buffer_(kReadBuffer_bytes) {}

  asio::awaitable<bool> exchange();

 private:
  /// How an answer is to be written.
  struct Form {
    unsigned version = 11;
    bool head_alone = false;
  };
  asio::awaitable<error_code> read(RequestParser& parser, bool (RequestParser::*done)() const);
  asio::awaitable<std::shared_ptr<Request>> read_head(RequestParser& parser);
  asio::awaitable<bool> read_body(RequestParser& parser, Request& request, std::size_t limit);
  asio::awaitable<void> upgrade(const RequestParser& parser, std::shared_ptr<Request> request);
  asio::awaitable<void> refuse(Response response, Form form);
  asio::awaitable<bool> write(Response response, Form form, bool keep);
  static Form form_of(const RequestParser& parser) { return {parser.version(), parser.method() == "HEAD"}; }

  Serving serving_;
  std::shared_ptr<ConnectionPlace> place_;
  beast::tcp_stream& stream_;
  std::string remote_;
  beast::flat_buffer buffer_;
};

/// Reads until `done` holds of the parser. What the parser throws is thrown here, to this connection's coroutine.
asio::awaitable<error_code> Connection::read(RequestParser& parser, bool (RequestParser::*done)() const) {
  error_code error;
  while (!(parser.*done)()) {
    if (buffer_.size() > 0) {
      buffer_.consume(parser.take(buffer_.data(), error));
      if (!error) continue;
      if (error != http::error::need_more) co_return error;
    }
    if (buffer_.size() == buffer_.max_size()) co_return http::error::buffer_overflow;
    const auto room = buffer_.prepare(buffer_.max_size() - buffer_.size());
    buffer_.commit(co_await stream_.async_read_some(room, asio::redirect_error(asio::use_awaitable, error)));
    if (error == asio::error::eof) {
      co_return parser.got_some() ? http::error::partial_message : http::error::end_of_stream;
    }
    if (error) co_return error;
  }
  co_return error_code();
}

/// The request of a head, without its body; nothing when there is none, which was answered where there was anything.
asio::awaitable<std::shared_ptr<Request>> Connection::read_head(RequestParser& parser) {
  stream_.expires_after(std::chrono::milliseconds(serving_.limits.header_timeout_ms));
  const error_code error = co_await read(parser, &RequestParser::is_header_done);
  if (error == http::error::end_of_stream) co_return nullptr;
  const Form unknown;
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    Response large = problem(431, "Header too large", "The head of the request is larger than 16 KiB.");
    co_await refuse(std::move(large), unknown);
    co_return nullptr;
  }
  if (error) {
    if (is_of_http(error)) {
      Response bad = problem(400, "Bad request", "This is not HTTP/1.1: " + error.message() + ".");
      co_await refuse(std::move(bad), unknown);
    }
    co_return nullptr;
  }
  auto request = parser.head(remote_);
  if (!request) {
    Response bad = problem(400, "Bad request", request.error().message);
    co_await refuse(std::move(bad), form_of(parser));
    co_return nullptr;
  }
  co_return std::make_shared<Request>(std::move(*request));
}

/// Whether the body could be read; if not, that was answered where there was anything to answer.
asio::awaitable<bool> Connection::read_body(RequestParser& parser, Request& request, std::size_t limit) {
  parser.body_limit(limit);
  stream_.expires_after(std::chrono::milliseconds(serving_.limits.body_timeout_ms));
  if (beast::iequals(request.header("expect"), "100-continue")) {
    http::response<http::empty_body> go_on(http::status::continue_, parser.version());
    error_code ignored;
    co_await http::async_write(stream_, go_on, asio::redirect_error(asio::use_awaitable, ignored));
  }
  const error_code error = co_await read(parser, &RequestParser::is_done);
  if (error == http::error::body_limit) {
    Response large = problem({ErrorCode::kTooLarge, "The body is larger than this route takes.", request.path});
    co_await refuse(std::move(large), form_of(parser));
  } else if (is_of_http(error) && error != http::error::partial_message) {
    Response bad = problem(400, "Bad request", "The body cannot be read: " + error.message() + ".");
    co_await refuse(std::move(bad), form_of(parser));
  }
  request.body = parser.take_body();
  co_return !error;
}

/// One request and its answer. Returns whether the connection stays.
asio::awaitable<bool> Connection::exchange() {
  RequestParser parser(serving_.limits.max_header_bytes);
  const std::shared_ptr<Request> request = co_await read_head(parser);
  if (!request) co_return false;
  stream_.expires_never();
  if (parser.upgrade() && beast::websocket::is_upgrade(handshake_of(parser))) {
    co_await upgrade(parser, request);
    co_return false;
  }
  const bool has_body = !parser.is_done();
  std::variant<std::size_t, Response> admitted = serving_.front.admit(*request);
  serving_.open.recognised(place_->id(), !request->caller.id.empty());
  const auto* limit = std::get_if<std::size_t>(&admitted);
  const auto length = parser.content_length();
  if (limit != nullptr && length && *length > *limit) {
    const std::string bytes = std::to_string(*length) + " bytes; at most " + std::to_string(*limit);
    admitted = problem({ErrorCode::kTooLarge, "The body has " + bytes + " are taken here.", request->path});
  }
  if (auto* refusal = std::get_if<Response>(&admitted)) {
    if (!has_body) {
      const bool kept = co_await write(std::move(*refusal), form_of(parser), parser.keep_alive());
      co_return kept;
    }
    co_await refuse(std::move(*refusal), form_of(parser));
    co_return false;
  }
  if (has_body) {
    const bool read_whole = co_await read_body(parser, *request, std::get<std::size_t>(admitted));
    if (!read_whole) co_return false;
  }
  serving_.open.began(place_->id());
  stream_.expires_never();
  Response response = co_await answer_of<Response>(
      serving_.context, [&](Reply reply) { serving_.front.answer(request, std::move(reply)); });
  const bool kept = co_await write(std::move(response), form_of(parser), parser.keep_alive());
  co_return kept;
}

/// Answers before the request was read to its end, then takes what still comes: closing at once would make the other
/// end's system throw the answer away, and some programs read no answer before they have sent all. Of who is known as
/// long as more comes; of a stranger for a moment.
asio::awaitable<void> Connection::refuse(Response response, Form form) {
  co_await write(std::move(response), form, false);
  error_code error;
  stream_.socket().shutdown(tcp::socket::shutdown_send, error);
  const bool known = serving_.open.is_recognised(place_->id());
  const std::size_t most = known ? kMaxMapBody : kMaxImageBody;
  stream_.expires_after(kSettle);
  std::size_t total = 0;
  while (!error && total < most) {
    if (known) stream_.expires_after(kSettleOfKnown);
    buffer_.clear();
    total += co_await stream_.async_read_some(buffer_.prepare(buffer_.max_size()),
                                              asio::redirect_error(asio::use_awaitable, error));
  }
}

asio::awaitable<bool> Connection::write(Response response, Form form, bool keep) {
  add_security_headers(response);
  http::response<http::empty_body> message;
  message.version(form.version);
  message.result(static_cast<unsigned>(response.status));
  for (const auto& [name, value] : response.headers) message.set(name, value);
  message.keep_alive(keep);
  const bool no_body = response.status == 204 || response.status == 304;
  if (!no_body) message.content_length(response.body.size());
  error_code error;
  const std::chrono::milliseconds within(serving_.limits.answer_timeout_ms);
  std::ostringstream head;
  head << message.base();
  const std::string head_text = head.str();
  std::string_view unsent_head = head_text;
  std::string_view unsent = form.head_alone || no_body ? std::string_view() : std::string_view(response.body);
  do {
    const std::string_view slice = unsent.substr(0, kAnswerSlice_bytes);
    const std::array<asio::const_buffer, 2> bytes{asio::buffer(unsent_head), asio::buffer(slice)};
    stream_.expires_after(within);
    co_await asio::async_write(stream_, bytes, asio::redirect_error(asio::use_awaitable, error));
    unsent_head = {};
    unsent.remove_prefix(slice.size());
  } while (!error && !unsent.empty());
  co_return keep && !error;
}

asio::awaitable<void> Connection::upgrade(const RequestParser& parser, std::shared_ptr<Request> request) {
  Upgrade answer = co_await answer_of<Upgrade>(
      serving_.context, [&](std::function<void(Upgrade)> reply) { serving_.front.upgrade(request, std::move(reply)); });
  if (serving_.ending) co_return;
  if (auto* refusal = std::get_if<Response>(&answer)) {
    co_await write(std::move(*refusal), form_of(parser), false);
    co_return;
  }
  auto session =
      std::make_shared<WebSocketSession>(std::move(stream_), std::get<std::shared_ptr<SocketHandler>>(answer),
                                         [place = place_]() mutable { place.reset(); });
  serving_.open.became_socket(place_->id(), [weak = std::weak_ptr(session)] {
    if (const auto open = weak.lock()) open->cut();
  });
  serving_.sockets.push_back({request, session});
  session->accept(handshake_of(parser));
}

}  // namespace

asio::awaitable<void> serve_connection(Serving serving, beast::tcp_stream stream) {
  error_code error;
  stream.socket().set_option(tcp::no_delay(true), error);
  const tcp::endpoint peer = stream.socket().remote_endpoint(error);
  if (error) co_return;  // gone already
  const std::string remote = peer.address().to_string();
  const auto cut = [&stream] {
    error_code ignored;
    stream.socket().close(ignored);
  };
  const auto id = serving.open.enter(remote, cut, std::chrono::steady_clock::now());
  if (!id) co_return;
  Connection connection(serving, std::make_shared<ConnectionPlace>(serving.open, *id), stream, remote);
  try {
    bool more = true;
    while (more) {
      more = co_await connection.exchange();
      serving.open.ended(*id, std::chrono::steady_clock::now());
    }
  } catch (const std::exception& exception) {
    spdlog::error("the connection of {} was ended by a fault: {}", remote, exception.what());
  }
  stream.socket().shutdown(tcp::socket::shutdown_both, error);
}

}  // namespace homeward::server
