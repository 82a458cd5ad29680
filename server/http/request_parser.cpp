// SPDX-License-Identifier: Apache-2.0
#include "server/http/request_parser.hpp"

#include <boost/beast/http/error.hpp>
#include <limits>

namespace homeward::server {
namespace {

namespace http = boost::beast::http;

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

RequestParser::RequestParser(std::size_t max_header_bytes) {
  header_limit(static_cast<std::uint32_t>(max_header_bytes));
  body_limit(std::numeric_limits<std::uint64_t>::max());  // the route decides, once the head was read
}

std::size_t RequestParser::take(boost::asio::const_buffer bytes, boost::beast::error_code& error) {
  // The least that may follow in chunks is their end, "0\r\n\r\n"; Beast asserts that it is given that much of it.
  constexpr std::size_t kLeastOfChunks_bytes = 5;
  if (head_is_read_ && chunked() && bytes.size() < kLeastOfChunks_bytes) {
    error = http::error::need_more;
    return 0;
  }
  const bool in_head = !head_is_read_;
  const std::size_t taken = put(bytes, error);
  const std::string_view text(static_cast<const char*>(bytes.data()), taken);
  const bool folded = text.find("\n ") != text.npos || text.find("\n\t") != text.npos;
  if (in_head && folded && (!error || error == http::error::need_more)) error = http::error::bad_field;
  return taken;
}

Result<Request> RequestParser::head(const std::string& remote) const {
  Request request;
  request.method = method_;
  request.remote = remote;
  if (target_.empty() || target_.front() != '/') {
    return fail(ErrorCode::kInvalidInput, "The request names no path.", "target");
  }
  const std::size_t question = std::min(target_.find('?'), target_.size());
  request.path = target_.substr(0, question);
  if (!percent_decoded(request.path)) {
    return fail(ErrorCode::kInvalidInput, "The path has a broken escape.", "target");
  }
  auto query = parse_query(std::string_view(target_).substr(std::min(question + 1, target_.size())));
  if (!query) return fail(ErrorCode::kInvalidInput, "The query has a broken escape.", "target");
  request.query = std::move(*query);
  int hosts = 0;
  for (const auto& [name, value] : fields_) {
    if (name == "host") ++hosts;
    const auto [at, added] = request.headers.emplace(name, value);
    if (!added && name == "cookie") at->second += "; " + value;
  }
  if (hosts != 1) return fail(ErrorCode::kInvalidInput, "The request needs exactly one Host header.", "Host");
  return request;
}

void RequestParser::on_request_impl(verb, string_view method, string_view target, int version, error_code& error) {
  method_.assign(method.data(), method.size());
  target_.assign(target.data(), target.size());
  version_ = static_cast<unsigned>(version);
  error = {};
}

void RequestParser::on_response_impl(int, string_view, int, error_code& error) { error = http::error::bad_version; }

void RequestParser::on_field_impl(field name, string_view name_text, string_view value, error_code& error) {
  error = {};
  if (head_is_read_) {
    error = http::error::bad_field;
    return;
  }
  std::string text(value.data(), value.size());
  // What is coded in a way that we do not know must not be taken for the next request.
  if (name == field::transfer_encoding && lower(text) != "chunked") {
    error = http::error::bad_transfer_encoding;
    return;
  }
  fields_.emplace_back(lower({name_text.data(), name_text.size()}), std::move(text));
}

void RequestParser::on_header_impl(error_code& error) {
  head_is_read_ = true;
  error = {};
}

void RequestParser::on_body_init_impl(const boost::optional<std::uint64_t>& length, error_code& error) {
  // Within the limit of the body, or this is not reached.
  if (length) body_.reserve(static_cast<std::size_t>(*length));
  error = {};
}

std::size_t RequestParser::on_body_impl(string_view bytes, error_code& error) {
  body_.append(bytes.data(), bytes.size());
  error = {};
  return bytes.size();
}

void RequestParser::on_chunk_header_impl(std::uint64_t, string_view, error_code& error) { error = {}; }

std::size_t RequestParser::on_chunk_body_impl(std::uint64_t, string_view bytes, error_code& error) {
  return on_body_impl(bytes, error);
}

void RequestParser::on_finish_impl(error_code& error) { error = {}; }

}  // namespace homeward::server
