// SPDX-License-Identifier: Apache-2.0
#include "agent/link/rest_client.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/rest_server.hpp"

namespace homeward::agent::rest_client_test {
namespace {

using homeward::testing::RestServer;

TEST(RestClient, APostWhoseAnswerIsLostIsMadeAgainAsTheSameAndTheNextIsAnother) {
  std::vector<std::string> keys;  // the server's thread, but after an answer
  const RestServer server([&](const RestServer::Request& request) {
    keys.push_back(request.idempotency_key);
    return RestServer::Reply{201, "made", keys.size() == 1};
  });
  RestClient client({false, "127.0.0.1", std::to_string(server.port())}, "token");
  const auto answer = client.call("POST", "/api/v1/tours", "{}", {});
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->body, "made");
  ASSERT_TRUE(client.call("POST", "/api/v1/tours", "{}", {}));
  ASSERT_EQ(keys.size(), 3U);
  EXPECT_FALSE(keys[0].empty());
  EXPECT_EQ(keys[1], keys[0]);
  EXPECT_NE(keys[2], keys[0]);
}

}  // namespace
}  // namespace homeward::agent::rest_client_test
