// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"

#include <gtest/gtest.h>

namespace homeward::agent {
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
}  // namespace homeward::agent
