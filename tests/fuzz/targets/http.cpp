// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>

#include "fuzz/targets/require.hpp"
#include "server/http/access.hpp"
#include "server/http/request_parser.hpp"

namespace homeward::fuzz {
namespace {

namespace http = boost::beast::http;

constexpr std::size_t kMaxHead_bytes = 4096;
constexpr std::size_t kMaxBody_bytes = 1000;

/// What the front looks at before anybody is known.
void look_at(const server::Request& request) {
  const server::AccessPolicy access({"house.example"}, {"127.0.0.1"});
  (void)access.host_allowed(request.header("host"));
  (void)access.from_own_page(request);
  (void)access.sender_of(request);
  (void)access.came_by_tls(request);
  (void)server::names_tag(request.header("if-none-match"), "\"r1\"");
  (void)server::cookie_value(request.header("cookie"), "homeward_session");
}

}  // namespace

void http_requests(Input input) {
  if (input.empty()) return;
  const std::size_t piece = 1 + input[0];
  std::string waiting;
  Input unread = input.subspan(1);
  server::RequestParser parser(kMaxHead_bytes);
  parser.body_limit(kMaxBody_bytes);
  boost::beast::error_code error;
  while (!parser.is_done() && !(error && error != http::error::need_more)) {
    const std::size_t taken = waiting.empty() ? 0 : parser.take(boost::asio::buffer(waiting), error);
    require(taken <= waiting.size(), "no more is taken than there is");
    waiting.erase(0, taken);
    if (taken > 0 && !error) continue;
    if (error && error != http::error::need_more) break;
    if (unread.empty()) break;
    const Input next = unread.first(std::min(piece, unread.size()));
    waiting.append(next.begin(), next.end());
    unread = unread.subspan(next.size());
  }
  if (!parser.is_header_done()) return;
  const auto head = parser.head("192.0.2.1");
  require_value_or_sentence(head);
  if (head) look_at(*head);
  require(parser.take_body().size() <= kMaxBody_bytes, "a body is no larger than allowed");
}

}  // namespace homeward::fuzz
