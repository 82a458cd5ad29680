// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"

#include <gtest/gtest.h>

namespace homeward::agent::address_test {
namespace {

TEST(ParseAddress, TakesSchemeHostAndPort) {
  const auto plain = parse_address("http://127.0.0.1:8080");
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->tls);
  EXPECT_EQ(plain->host_header(), "127.0.0.1:8080");
  const auto safe = parse_address("https://house.example/");
  ASSERT_TRUE(safe);
  EXPECT_TRUE(safe->tls);
  EXPECT_EQ(safe->host, "house.example");
  EXPECT_EQ(safe->port, "443");
  EXPECT_EQ(parse_address("http://house")->port, "80");
}

TEST(ParseAddress, TakesIPv6InBrackets) {
  const auto address = parse_address("http://[::1]:8080");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "::1");
  EXPECT_EQ(address->host_header(), "[::1]:8080");
  EXPECT_EQ(parse_address("https://[fe80::1]")->port, "443");
}

TEST(ParseAddress, KnowsRosbridges) {
  const auto address = parse_websocket_address("ws://192.168.1.7:9090/");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->server.host, "192.168.1.7");
  EXPECT_EQ(address->server.port, "9090");
  EXPECT_FALSE(address->server.tls);
  EXPECT_EQ(address->path, "/");
  EXPECT_EQ(parse_websocket_address("ws://robot:9090")->path, "/");
  for (const char* text : {"http://robot:9090", "robot:9090", "ws://", "wss://", "ws:///path", "ws://robot:ninety/path",
                           "ws://robot/a b", "ws://robot/a\r\nHost: other", "ws://robot/a#b", "ws://robot/\xc3\xa4"}) {
    EXPECT_EQ(parse_websocket_address(text).error().code, ErrorCode::kInvalidInput) << text;
  }
}

TEST(ParseAddress, KnowsRosbridgesWithTlsAndBehindPaths) {
  const auto safe = parse_websocket_address("wss://chair.example/robots/3/rosbridge?of=2");
  ASSERT_TRUE(safe) << safe.error().message;
  EXPECT_TRUE(safe->server.tls);
  EXPECT_EQ(safe->server.host, "chair.example");
  EXPECT_EQ(safe->server.port, "443");
  EXPECT_EQ(safe->path, "/robots/3/rosbridge?of=2");
  const auto deep = parse_websocket_address("ws://[::1]:9090/a:b");
  ASSERT_TRUE(deep) << deep.error().message;
  EXPECT_EQ(deep->server.host, "::1");
  EXPECT_EQ(deep->server.port, "9090");
  EXPECT_EQ(deep->path, "/a:b");
}

TEST(ParseAddress, RefusesTheRestAndNamesIt) {
  for (const char* text : {"", "127.0.0.1:8080", "ftp://house", "http://", "http://:80",
                           "http://house:", "http://house:http", "http://house:123456", "http://house/path"}) {
    const auto address = parse_address(text);
    ASSERT_FALSE(address) << text;
    EXPECT_EQ(address.error().code, ErrorCode::kInvalidInput);
    EXPECT_EQ(address.error().where, text);
  }
}

}  // namespace
}  // namespace homeward::agent::address_test
