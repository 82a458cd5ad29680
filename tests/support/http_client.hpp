// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace homeward::testing {

struct Answer {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(body); }
  [[nodiscard]] std::string code() const { return json().value("code", ""); }
};

using Headers = std::map<std::string, std::string>;

/// A browser-like caller over a real socket: keeps its cookie, says its origin. One connection for each request.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port) : port_(port), host_("127.0.0.1:" + std::to_string(port)) {
    defaults["Origin"] = "http://" + host_;
  }

  Answer send(const std::string& method, const std::string& path, const std::string& body = "",
              const Headers& headers = {}) {
    namespace http = boost::beast::http;
    boost::asio::io_context context;
    boost::asio::ip::tcp::socket socket(context);
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), port_});
    http::request<http::string_body> request(http::string_to_verb(method), path, 11);
    request.set(http::field::host, host_);
    for (const auto& [name, value] : defaults) request.set(name, value);
    if (!cookie.empty()) request.set(http::field::cookie, cookie);
    for (const auto& [name, value] : headers) request.set(name, value);
    request.body() = body;
    request.prepare_payload();
    http::write(socket, request);
    boost::beast::flat_buffer buffer;
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

  Answer get(const std::string& path, const Headers& headers = {}) { return send("GET", path, "", headers); }
  Answer post(const std::string& path, const nlohmann::json& body = nlohmann::json::object(),
              const Headers& headers = {}) {
    return send("POST", path, body.dump(), headers);
  }
  Answer put(const std::string& path, const nlohmann::json& body) { return send("PUT", path, body.dump()); }

  Headers defaults;
  std::string cookie;

 private:
  std::uint16_t port_;
  std::string host_;
};

/// A WebSocket whose reads end after a while.
class SocketClient {
 public:
  SocketClient() : stream_(context_) {}

  /// The status of the handshake: 101 when it is open.
  int open(std::uint16_t port, const std::string& path, const Headers& headers) {
    namespace websocket = boost::beast::websocket;
    const std::string host = "127.0.0.1:" + std::to_string(port);
    boost::beast::get_lowest_layer(stream_).connect({boost::asio::ip::make_address("127.0.0.1"), port});
    stream_.set_option(websocket::stream_base::decorator([headers](websocket::request_type& request) {
      for (const auto& [name, value] : headers) request.set(name, value);
    }));
    stream_.read_message_max(64UL * 1024 * 1024);
    websocket::response_type response;
    boost::beast::error_code error;
    stream_.handshake(response, host, path, error);
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

  void send(const std::string& bytes, bool text) {
    stream_.text(text);
    stream_.write(boost::asio::buffer(bytes));
  }

  /// The next message, or nothing when none comes in time or the other end has closed.
  std::optional<std::string> receive(std::chrono::milliseconds patience = std::chrono::seconds(10)) {
    if (!reading_ && !closed_) {
      reading_ = true;
      stream_.async_read(buffer_, [this](boost::beast::error_code error, std::size_t) {
        reading_ = false;
        closed_ = static_cast<bool>(error);
      });
    }
    context_.restart();
    context_.run_for(patience);
    if (reading_ || closed_) return std::nullopt;
    std::string message = boost::beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    return message;
  }

  [[nodiscard]] bool closed() const { return closed_; }
  /// Cuts the connection as a dead network would, without a word.
  void cut() { boost::beast::get_lowest_layer(stream_).socket().close(); }

 private:
  boost::asio::io_context context_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer buffer_;
  bool reading_ = false;
  bool closed_ = false;
};

}  // namespace homeward::testing
