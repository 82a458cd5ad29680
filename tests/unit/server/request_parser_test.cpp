// SPDX-License-Identifier: Apache-2.0
#include "server/http/request_parser.hpp"

#include <gtest/gtest.h>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>

#include "fuzz/mutate.hpp"

namespace homeward::server::request_parser_test {
namespace {

namespace http = boost::beast::http;
using boost::beast::error_code;

/// Reads `bytes` in pieces of at most `piece` bytes, as from a network.
error_code read(RequestParser& parser, const std::string& bytes, std::size_t piece) {
  std::string unread;
  error_code error;
  for (std::size_t at = 0; at < bytes.size() && !parser.is_done();) {
    unread += bytes.substr(at, piece);
    at += piece;
    while (!unread.empty() && !parser.is_done()) {
      unread.erase(0, parser.take(boost::asio::buffer(unread), error));
      if (error == http::error::need_more) break;
      if (error) return error;
    }
  }
  return parser.is_done() ? error_code() : error;
}

const std::string kChunked =
    "PUT /a%20b?x=1&y=%41 HTTP/1.1\r\nHost: me\r\nTransfer-Encoding: chunked\r\nCookie: a=1\r\nCookie: b=2\r\n\r\n"
    "3;quiet\r\nabc\r\n2\r\nde\r\n0\r\n\r\n";

TEST(RequestParser, ReadsTheSameInAnyPieces) {
  for (std::size_t piece = 1; piece <= kChunked.size(); ++piece) {
    RequestParser parser(16UL * 1024);
    ASSERT_FALSE(read(parser, kChunked, piece)) << piece;
    const auto head = parser.head("10.0.0.1");
    ASSERT_TRUE(head);
    EXPECT_EQ(head->method, "PUT");
    EXPECT_EQ(head->path, "/a%20b");
    EXPECT_EQ(head->query.at("y"), "A");
    EXPECT_EQ(head->header("cookie"), "a=1; b=2");
    EXPECT_EQ(head->remote, "10.0.0.1");
    EXPECT_EQ(parser.take_body(), "abcde");
  }
}

TEST(RequestParser, ReadsABodyOfNoChunksInAnyPieces) {
  const std::string whole = "PUT / HTTP/1.1\r\nHost: me\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n";
  for (std::size_t piece = 1; piece <= whole.size(); ++piece) {
    RequestParser parser(16UL * 1024);
    ASSERT_FALSE(read(parser, whole, piece)) << piece;
    EXPECT_EQ(parser.take_body(), "");
  }
}

TEST(RequestParser, SaysWhatAHeadLacks) {
  const auto error_of = [](const std::string& head) {
    RequestParser parser(16UL * 1024);
    EXPECT_FALSE(read(parser, head, head.size()));
    const auto request = parser.head("");
    return request ? std::string() : request.error().message;
  };
  EXPECT_EQ(error_of("GET / HTTP/1.1\r\nHost: me\r\n\r\n"), "");
  EXPECT_NE(error_of("GET / HTTP/1.1\r\n\r\n").find("Host"), std::string::npos);
  EXPECT_NE(error_of("GET / HTTP/1.1\r\nHost: me\r\nHost: you\r\n\r\n").find("Host"), std::string::npos);
  EXPECT_NE(error_of("GET * HTTP/1.1\r\nHost: me\r\n\r\n").find("path"), std::string::npos);
  EXPECT_NE(error_of("GET /%zz HTTP/1.1\r\nHost: me\r\n\r\n").find("path"), std::string::npos);
  EXPECT_NE(error_of("GET /?a=%zz HTTP/1.1\r\nHost: me\r\n\r\n").find("query"), std::string::npos);
}

TEST(RequestParser, RefusesAFieldAfterTheBodyAndAnUnknownCoding) {
  const std::string head = "PUT / HTTP/1.1\r\nHost: me\r\nTransfer-Encoding: ";
  RequestParser trailer(16UL * 1024);
  EXPECT_EQ(read(trailer, head + "chunked\r\n\r\n0\r\nA: b\r\n\r\n", 7), http::error::bad_field);
  RequestParser coded(16UL * 1024);
  EXPECT_EQ(read(coded, head + "gzip\r\n\r\n", 7), http::error::bad_transfer_encoding);
}

TEST(RequestParser, HoldsItsLimits) {
  RequestParser head(100);
  EXPECT_EQ(read(head, "GET / HTTP/1.1\r\nHost: me\r\nA: " + std::string(200, 'a') + "\r\n\r\n", 10),
            http::error::header_limit);
  RequestParser body(16UL * 1024);
  body.body_limit(4);
  EXPECT_EQ(read(body, kChunked, 10), http::error::body_limit);
}

TEST(RequestParser, DamagedBytesGiveAnErrorOrARequest) {
  testing::Mutator mutator(3);
  const std::string plain = "POST /api HTTP/1.1\r\nHost: me\r\nContent-Length: 5\r\nX: y\r\n\r\nabcde";
  int requests = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string& whole = i % 2 == 0 ? kChunked : plain;
    const testing::Bytes damaged = mutator.damaged(testing::Bytes(whole.begin(), whole.end()));
    RequestParser parser(16UL * 1024);
    parser.body_limit(1000);
    const error_code error = read(parser, {damaged.begin(), damaged.end()}, 1 + static_cast<std::size_t>(i) % 40);
    if (error || !parser.is_header_done()) continue;
    if (parser.head("")) ++requests;
    EXPECT_LE(parser.take_body().size(), 1000U);
  }
  EXPECT_GT(requests, 1000) << "most damages are of what may be anything";
}

}  // namespace
}  // namespace homeward::server::request_parser_test
