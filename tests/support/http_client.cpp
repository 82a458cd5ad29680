// SPDX-License-Identifier: Apache-2.0
#include "support/http_client.hpp"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cctype>
#include <deque>

namespace homeward::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

nlohmann::json Answer::json() const { return nlohmann::json::parse(body); }

std::string Answer::code() const { return json().value("code", ""); }

HttpClient::HttpClient(std::uint16_t port) : port_(port), host_("127.0.0.1:" + std::to_string(port)) {
  defaults["Origin"] = "http://" + host_;
}

Answer HttpClient::send(const std::string& method, const std::string& path, const std::string& body,
                        const Headers& headers) {
  asio::io_context context;
  asio::ip::tcp::socket socket(context);
  socket.connect({asio::ip::make_address("127.0.0.1"), port_});
  http::request<http::string_body> request(http::string_to_verb(method), path, 11);
  request.set(http::field::host, host_);
  for (const auto& [name, value] : defaults) request.set(name, value);
  if (!cookie.empty()) request.set(http::field::cookie, cookie);
  for (const auto& [name, value] : headers) request.set(name, value);
  request.body() = body;
  request.prepare_payload();
  http::write(socket, request);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(256UL * 1024 * 1024);
  parser.skip(method == "HEAD");
  http::read(socket, buffer, parser);
  Answer answer;
  answer.status = static_cast<int>(parser.get().result_int());
  answer.body = parser.get().body();
  for (const auto& field : parser.get()) {
    std::string name(field.name_string());
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    answer.headers[name] = std::string(field.value());
  }
  if (answer.headers.contains("set-cookie")) {
    const std::string& text = answer.headers["set-cookie"];
    cookie = text.substr(0, text.find(';'));
  }
  return answer;
}

Answer HttpClient::get(const std::string& path, const Headers& headers) { return send("GET", path, "", headers); }

Answer HttpClient::post(const std::string& path, const nlohmann::json& body, const Headers& headers) {
  return send("POST", path, body.dump(), headers);
}

Answer HttpClient::put(const std::string& path, const nlohmann::json& body) { return send("PUT", path, body.dump()); }

struct RawConnection::Connection {
  asio::io_context context;
  asio::ip::tcp::socket socket{context};
  bool closed = false;
};

RawConnection::RawConnection(std::uint16_t port) : connection_(std::make_unique<Connection>()) {
  connection_->socket.connect({asio::ip::make_address("127.0.0.1"), port});
}

RawConnection::~RawConnection() = default;

bool RawConnection::send(const std::string& bytes) {
  beast::error_code error;
  asio::write(connection_->socket, asio::buffer(bytes), error);
  return !error;
}

std::string RawConnection::receive(const std::string& last, std::chrono::milliseconds patience) {
  Connection& c = *connection_;
  const auto end = std::chrono::steady_clock::now() + patience;
  std::string all;
  std::array<char, 16384> piece{};
  bool waiting = false;
  std::size_t come = 0;
  while (!c.closed && std::chrono::steady_clock::now() < end && (last.empty() || all.find(last) == std::string::npos)) {
    if (!waiting) {
      waiting = true;
      c.socket.async_read_some(asio::buffer(piece), [&](beast::error_code error, std::size_t count) {
        waiting = false;
        come = count;
        c.closed = static_cast<bool>(error);
      });
    }
    c.context.restart();
    if (c.context.run_one_until(end) == 0) break;
    if (waiting) continue;
    all.append(piece.data(), come);
    come = 0;
  }
  if (waiting) {
    c.socket.cancel();
    c.context.restart();
    c.context.run();
    all.append(piece.data(), come);  // what came just before
    c.closed = false;
  }
  return all;
}

bool RawConnection::closed() const { return connection_->closed; }

struct SocketClient::Connection {
  asio::io_context context;
  websocket::stream<beast::tcp_stream> stream{context};
  beast::flat_buffer buffer;
  std::deque<std::string> received;  // not asked for yet
  std::int64_t pings = 0;
  std::string answered;  // the last ping
  bool pinging = false;
  bool reading = false;
  bool closed = false;
};

SocketClient::SocketClient() : connection_(std::make_unique<Connection>()) {}

SocketClient::~SocketClient() = default;

int SocketClient::open(std::uint16_t port, const std::string& path, const Headers& headers) {
  auto& stream = connection_->stream;
  const std::string host = "127.0.0.1:" + std::to_string(port);
  beast::get_lowest_layer(stream).connect({asio::ip::make_address("127.0.0.1"), port});
  stream.set_option(websocket::stream_base::decorator([headers](websocket::request_type& request) {
    for (const auto& [name, value] : headers) request.set(name, value);
  }));
  stream.read_message_max(64UL * 1024 * 1024);
  stream.control_callback([this](websocket::frame_type kind, beast::string_view payload) {
    if (kind == websocket::frame_type::pong) connection_->answered = std::string(payload);
  });
  websocket::response_type response;
  beast::error_code error;
  stream.handshake(response, host, path, error);
  if (!error) return static_cast<int>(response.result_int());
  // Beast tells nothing of a refusal that has a body: ask again in plain HTTP.
  HttpClient plain(port);
  plain.defaults = headers;
  return plain
      .get(path, {{"Connection", "Upgrade"},
                  {"Upgrade", "websocket"},
                  {"Sec-WebSocket-Version", "13"},
                  {"Sec-WebSocket-Key", "MDEyMzQ1Njc4OWFiY2RlZg=="}})
      .status;
}

void SocketClient::send(const std::string& bytes, bool text) {
  connection_->stream.text(text);
  connection_->stream.write(asio::buffer(bytes));
}

void SocketClient::begin_reading() {
  Connection& c = *connection_;
  if (c.reading || c.closed) return;
  c.reading = true;
  c.stream.async_read(c.buffer, [&c](beast::error_code error, std::size_t) {
    c.reading = false;
    c.closed = static_cast<bool>(error);
    if (!error) c.received.push_back(beast::buffers_to_string(c.buffer.data()));
    c.buffer.consume(c.buffer.size());
  });
}

std::optional<std::string> SocketClient::receive(std::chrono::milliseconds patience) {
  Connection& c = *connection_;
  if (c.received.empty()) {
    begin_reading();
    c.context.restart();
    c.context.run_for(patience);
  }
  if (c.received.empty()) return std::nullopt;
  std::string message = std::move(c.received.front());
  c.received.pop_front();
  return message;
}

bool SocketClient::take_in_all() {
  Connection& c = *connection_;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  bool more = true;
  while (more && !c.closed) {
    const std::size_t before = c.received.size();
    const std::string number = std::to_string(++c.pings);
    c.pinging = true;
    c.stream.async_ping(websocket::ping_data(number), [&c](beast::error_code) { c.pinging = false; });
    while ((c.pinging || c.answered != number) && !c.closed) {
      begin_reading();
      c.context.restart();
      if (c.context.run_one_until(end) == 0) return false;
    }
    more = c.received.size() > before;
  }
  return !c.closed;
}

bool SocketClient::closed() const { return connection_->closed && connection_->received.empty(); }

void SocketClient::cut() { beast::get_lowest_layer(connection_->stream).socket().close(); }

}  // namespace homeward::testing
