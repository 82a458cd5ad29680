// SPDX-License-Identifier: Apache-2.0
#include "agent/link/rest_client.hpp"

#include <openssl/ssl.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/rfc2818_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <thread>

namespace homeward::agent {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;

constexpr std::uint64_t kMaxAnswerBytes = 64ULL * 1024 * 1024;
constexpr std::uint64_t kMaxFileBytes = 16ULL * 1024 * 1024 * 1024;
constexpr int kTries = 3;

/// By which the server knows a POST that it has answered before.
std::string new_key() {
  std::random_device random;
  std::string key(32, '0');
  for (char& letter : key) letter = "0123456789abcdef"[random() % 16];
  return key;
}

/// What a socket never fails with, but a disk does.
bool is_of_disk(const beast::error_code& trouble) {
  namespace errc = boost::system::errc;
  return trouble == errc::no_space_on_device || trouble == errc::file_too_large || trouble == errc::io_error ||
         trouble == errc::read_only_file_system ||
         trouble == beast::error_code(EDQUOT, boost::system::system_category());
}

Status not_written(const std::string& file, const beast::error_code& trouble) {
  return fail(ErrorCode::kIo, "What the server sends cannot be written: " + trouble.message() + ".", file);
}

}  // namespace

struct RestClient::Impl {
  using Request = http::request<http::string_body>;

  ServerAddress address;
  std::string token;
  std::chrono::milliseconds most_silence{};
  asio::io_context context{1};
  asio::ssl::context tls{asio::ssl::context::tls_client};
  std::unique_ptr<beast::tcp_stream> plain;
  std::unique_ptr<beast::ssl_stream<beast::tcp_stream>> secure;

  /// Begins something and waits until it is done or the server has been silent for too long. Throws its error.
  template <class Begin>
  void wait(beast::tcp_stream& stream, Begin begin) {
    beast::error_code trouble;
    stream.expires_after(most_silence);
    begin([&trouble](beast::error_code error, auto&&...) { trouble = error; });
    context.restart();
    context.run();
    if (trouble) throw beast::system_error(trouble);
  }

  void connect() {
    const auto targets = Tcp::resolver(context).resolve(address.host, address.port);
    if (!address.tls) {
      plain = std::make_unique<beast::tcp_stream>(context);
      wait(*plain, [&](auto done) { plain->async_connect(targets, done); });
      return;
    }
    tls.set_default_verify_paths();
    tls.set_verify_mode(asio::ssl::verify_peer);
    secure = std::make_unique<beast::ssl_stream<beast::tcp_stream>>(context, tls);
    secure->set_verify_callback(asio::ssl::rfc2818_verification(address.host));
    // What SSL_set_tlsext_host_name does, without its old-style cast.
    SSL_ctrl(secure->native_handle(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name, address.host.data());
    beast::tcp_stream& below = beast::get_lowest_layer(*secure);
    wait(below, [&](auto done) { below.async_connect(targets, done); });
    wait(below, [&](auto done) { secure->async_handshake(asio::ssl::stream_base::client, done); });
  }

  void drop() {
    plain.reset();
    secure.reset();
  }

  Request request(http::verb method, const std::string& path) const {
    Request made{method, path, 11};
    made.set(http::field::host, address.host_header());
    made.set(http::field::user_agent, "homeward-agent");
    if (!token.empty()) made.set(http::field::authorization, "Bearer " + token);
    return made;
  }

  template <class Stream, class Parser>
  void exchange(Stream& stream, const Request& request, Parser& parser) {
    beast::tcp_stream& below = beast::get_lowest_layer(stream);
    http::request_serializer<http::string_body> serializer(request);
    while (!serializer.is_done()) {
      wait(below, [&](auto done) { http::async_write_some(stream, serializer, done); });
    }
    beast::flat_buffer buffer;
    while (!parser.is_done()) {
      wait(below, [&](auto done) { http::async_read_some(stream, buffer, parser, done); });
    }
    if (!parser.get().keep_alive()) drop();
  }

  /// Asks until there is an answer, with what `begin` makes ready for each try. `into`: the file that is written.
  template <class Parser, class Begin>
  Status ask(const Request& request, std::optional<Parser>& parser, const std::string& into, Begin begin) {
    std::string trouble;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      if (const Status ready = begin(); !ready) return ready;
      try {
        if (!plain && !secure) connect();
        plain ? exchange(*plain, request, *parser) : exchange(*secure, request, *parser);
        return {};
      } catch (const beast::system_error& broken) {
        // A kept connection may have been closed meanwhile. Made again it does nothing twice: a POST has its key.
        trouble = broken.what();
        drop();
        if (is_of_disk(broken.code())) return not_written(into, broken.code());
        if (broken.code() == beast::error::timeout) {
          trouble = "it has said nothing for " + std::to_string(most_silence.count()) + " ms";
          break;
        }
      } catch (const std::exception& broken) {
        trouble = broken.what();
        drop();
      }
      if (attempt + 1 < kTries) std::this_thread::sleep_for(std::chrono::milliseconds(200 * (attempt + 1)));
    }
    return fail(ErrorCode::kIo, "The server does not answer: " + trouble + ".", url(std::string(request.target())));
  }

  std::string url(const std::string& path) const {
    return (address.tls ? "https://" : "http://") + address.host_header() + path;
  }
};

RestClient::RestClient(ServerAddress address, std::string token, std::chrono::milliseconds most_silence)
    : impl_(std::make_unique<Impl>()) {
  impl_->address = std::move(address);
  impl_->token = std::move(token);
  impl_->most_silence = most_silence;
}
RestClient::~RestClient() = default;
RestClient::RestClient(RestClient&&) noexcept = default;
RestClient& RestClient::operator=(RestClient&&) noexcept = default;

Result<RestAnswer> RestClient::call(const std::string& method, const std::string& path, std::string_view body,
                                    const std::map<std::string, std::string>& headers) {
  Impl::Request request = impl_->request(http::string_to_verb(method), path);
  if (method == "POST") request.set("Idempotency-Key", new_key());
  for (const auto& [name, value] : headers) request.set(name, value);
  request.body() = std::string(body);
  request.prepare_payload();
  std::optional<http::response_parser<http::string_body>> parser;
  const Status asked = impl_->ask(request, parser, {}, [&]() -> Status {
    parser.emplace();
    parser->body_limit(kMaxAnswerBytes);
    return {};
  });
  if (!asked) return pass_on(asked);
  return RestAnswer{static_cast<int>(parser->get().result_int()), std::move(parser->get().body())};
}

Status RestClient::download(const std::string& path, const std::filesystem::path& file) {
  const Impl::Request request = impl_->request(http::verb::get, path);
  std::optional<http::response_parser<http::file_body>> parser;
  const Status asked = impl_->ask(request, parser, file.string(), [&]() -> Status {
    parser.emplace();
    parser->body_limit(kMaxFileBytes);
    beast::error_code trouble;
    parser->get().body().open(file.c_str(), beast::file_mode::write, trouble);
    return trouble ? not_written(file.string(), trouble) : Status{};
  });
  const int status = asked ? static_cast<int>(parser->get().result_int()) : 0;
  parser.reset();
  if (status == 200) return {};
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  if (!asked) return pass_on(asked);
  return fail(status == 404 ? ErrorCode::kNotFound : ErrorCode::kIo,
              "The server answered " + std::to_string(status) + " when asked for the file.", impl_->url(path));
}

}  // namespace homeward::agent
