// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/beast/http/basic_parser.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "server/http/message.hpp"

namespace homeward::server {

/// Reads one request of HTTP/1.1 (RFC 9112) into plain text. Beast's own parser keeps fields in a container that throws
/// for a long one, also for those that come after a chunked body and that no limit holds for; this one refuses them.
///
/// Errors that it adds to Beast's: bad_transfer_encoding for any encoding but "chunked", bad_field for a field after
/// the body.
class RequestParser : public boost::beast::http::basic_parser<true> {
 public:
  /// A head of more than `max_header_bytes` is an error (header_limit).
  explicit RequestParser(std::size_t max_header_bytes);

  /// Takes what it can of these bytes, which have to be in one piece; gives how many. http::error::need_more where it
  /// needs more. A field that is folded over lines (RFC 9112 section 5.2) is an error, bad_field.
  std::size_t take(boost::asio::const_buffer bytes, boost::beast::error_code& error);
  /// The request without its body. Errors: kInvalidInput, saying what is wrong with its head. To be asked once
  /// is_header_done() holds.
  [[nodiscard]] Result<Request> head(const std::string& remote) const;
  [[nodiscard]] const std::string& method() const { return method_; }
  [[nodiscard]] const std::string& target() const { return target_; }
  /// 11 for HTTP/1.1.
  [[nodiscard]] unsigned version() const { return version_; }
  /// The names, in lower case, and values of all fields, in their order.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& fields() const { return fields_; }
  [[nodiscard]] std::string take_body() { return std::move(body_); }

 private:
  using verb = boost::beast::http::verb;
  using field = boost::beast::http::field;
  using string_view = boost::beast::string_view;
  using error_code = boost::beast::error_code;

  void on_request_impl(verb, string_view method, string_view target, int version, error_code& error) override;
  void on_response_impl(int, string_view, int, error_code& error) override;
  void on_field_impl(field name, string_view name_text, string_view value, error_code& error) override;
  void on_header_impl(error_code& error) override;
  void on_body_init_impl(const boost::optional<std::uint64_t>& length, error_code& error) override;
  std::size_t on_body_impl(string_view bytes, error_code& error) override;
  void on_chunk_header_impl(std::uint64_t, string_view, error_code& error) override;
  std::size_t on_chunk_body_impl(std::uint64_t, string_view bytes, error_code& error) override;
  void on_finish_impl(error_code& error) override;

  std::string method_;
  std::string target_;
  unsigned version_ = 11;
  std::vector<std::pair<std::string, std::string>> fields_;
  bool head_is_read_ = false;
  std::string body_;
};

}  // namespace homeward::server
