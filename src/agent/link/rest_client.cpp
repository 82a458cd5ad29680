// SPDX-License-Identifier: Apache-2.0
#include "agent/link/rest_client.hpp"

#include <openssl/ssl.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/rfc2818_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <chrono>
#include <random>
#include <thread>

namespace homeward::agent {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;

constexpr std::size_t kMaxAnswerBytes = 64UL * 1024 * 1024;

/// By which the server knows a POST that it has answered before.
std::string new_key() {
  std::random_device random;
  std::string key(32, '0');
  for (char& letter : key) letter = "0123456789abcdef"[random() % 16];
  return key;
}

}  // namespace

struct RestClient::Impl {
  ServerAddress address;
  std::string token;
  asio::io_context context{1};
  asio::ssl::context tls{asio::ssl::context::tls_client};
  std::unique_ptr<beast::tcp_stream> plain;
  std::unique_ptr<beast::ssl_stream<beast::tcp_stream>> secure;

  void connect() {
    const auto targets = Tcp::resolver(context).resolve(address.host, address.port);
    if (!address.tls) {
      plain = std::make_unique<beast::tcp_stream>(context);
      plain->connect(targets);
      return;
    }
    tls.set_default_verify_paths();
    tls.set_verify_mode(asio::ssl::verify_peer);
    secure = std::make_unique<beast::ssl_stream<beast::tcp_stream>>(context, tls);
    secure->set_verify_callback(asio::ssl::rfc2818_verification(address.host));
    // What SSL_set_tlsext_host_name does, without its old-style cast.
    SSL_ctrl(secure->native_handle(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name, address.host.data());
    beast::get_lowest_layer(*secure).connect(targets);
    secure->handshake(asio::ssl::stream_base::client);
  }

  void drop() {
    plain.reset();
    secure.reset();
  }

  template <class Stream>
  RestAnswer exchange(Stream& stream, const http::request<http::string_body>& request) {
    http::write(stream, request);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(kMaxAnswerBytes);
    http::read(stream, buffer, parser);
    const auto& response = parser.get();
    RestAnswer answer{static_cast<int>(response.result_int()), response.body()};
    if (!response.keep_alive()) drop();
    return answer;
  }
};

RestClient::RestClient(ServerAddress address, std::string token) : impl_(std::make_unique<Impl>()) {
  impl_->address = std::move(address);
  impl_->token = std::move(token);
}
RestClient::~RestClient() = default;
RestClient::RestClient(RestClient&&) noexcept = default;
RestClient& RestClient::operator=(RestClient&&) noexcept = default;

Result<RestAnswer> RestClient::call(const std::string& method, const std::string& path, std::string_view body,
                                    const std::map<std::string, std::string>& headers) {
  http::request<http::string_body> request{http::string_to_verb(method), path, 11};
  request.set(http::field::host, impl_->address.host_header());
  request.set(http::field::user_agent, "homeward-agent");
  if (!impl_->token.empty()) request.set(http::field::authorization, "Bearer " + impl_->token);
  if (method == "POST") request.set("Idempotency-Key", new_key());
  for (const auto& [name, value] : headers) request.set(name, value);
  request.body() = std::string(body);
  request.prepare_payload();
  std::string trouble;
  constexpr int kTries = 3;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    try {
      if (!impl_->plain && !impl_->secure) impl_->connect();
      return impl_->plain ? impl_->exchange(*impl_->plain, request) : impl_->exchange(*impl_->secure, request);
    } catch (const std::exception& broken) {
      // A kept connection may have been closed meanwhile. Made again it does nothing twice: a POST has its key.
      trouble = broken.what();
      impl_->drop();
      if (attempt + 1 < kTries) std::this_thread::sleep_for(std::chrono::milliseconds(200 * (attempt + 1)));
    }
  }
  return fail(ErrorCode::kIo, "The server does not answer: " + trouble + ".",
              (impl_->address.tls ? "https://" : "http://") + impl_->address.host_header() + path);
}

}  // namespace homeward::agent
