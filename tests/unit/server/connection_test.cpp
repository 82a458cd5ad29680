// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutate.hpp"
#include "support/server_fixture.hpp"

namespace homeward::server::connection_test {
namespace {

using testing::RawConnection;

/// What strangers and broken programs send to the port.
class ConnectionTest : public testing::ServerTest {
 protected:
  [[nodiscard]] std::string head(const std::string& line, const std::string& fields) const {
    return line + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(app->port()) + "\r\n" + fields + "\r\n";
  }
  /// The status of the answer to these bytes; 0 when the connection ends without one.
  int status_of(const std::string& bytes) {
    RawConnection connection(app->port());
    connection.send(bytes);
    const std::string answer = connection.receive("\r\n");
    return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
  }
  int health() { return admin->get("/healthz").status; }
};

TEST_F(ConnectionTest, AFieldAfterTheBodyIsRefusedHoweverLongItIs) {
  const std::string login = head("POST /api/v1/login", "Transfer-Encoding: chunked\r\n");
  for (const std::size_t length : {1UL, 1000UL, 65'000UL, 65'530UL, 65'534UL, 65'536UL, 70'000UL, 300'000UL}) {
    const std::string text(length, 'x');
    EXPECT_NE(status_of(login + "2\r\n{}\r\n0\r\nName: " + text + "\r\n\r\n"), 422) << length;
    EXPECT_NE(status_of(login + "2\r\n{}\r\n0\r\n" + text + ": value\r\n\r\n"), 422) << length;
    ASSERT_EQ(health(), 200) << length;
  }
  EXPECT_EQ(status_of(login + "2\r\n{}\r\n0\r\nName: x\r\n\r\n"), 400);
  EXPECT_EQ(status_of(login + "2\r\n{}\r\n0\r\n\r\n"), 422) << "without one the body is read";
}

TEST_F(ConnectionTest, AnExtensionOfAChunkTakesNoMoreMemoryThanAHead) {
  RawConnection connection(app->port());
  connection.send(head("POST /api/v1/login", "Transfer-Encoding: chunked\r\n") + "2;");
  const std::string more(64UL * 1024, 'x');
  for (int i = 0; i < 64 && connection.send(more); ++i) continue;
  connection.receive();
  EXPECT_TRUE(connection.closed());
  EXPECT_EQ(health(), 200);
}

TEST_F(ConnectionTest, WhatIsCodedInAnUnknownWayIsRefused) {
  const std::string after = head("GET /healthz", "");
  EXPECT_EQ(status_of(head("POST /api/v1/login", "Transfer-Encoding: gzip\r\n") + after), 400);
  EXPECT_EQ(status_of(head("POST /api/v1/login", "Transfer-Encoding: gzip, chunked\r\n") + after), 400);
  EXPECT_EQ(status_of(head("POST /api/v1/login", "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n") + after), 400);
}

TEST_F(ConnectionTest, ABodyIsReadOfNobodyWhoMayNotSendIt) {
  const auto import = [&](const std::string& secret) {
    return head("POST /api/v1/maps/import", "Content-Length: 250000000\r\nAuthorization: Bearer " + secret + "\r\n");
  };
  const std::string viewer =
      admin->post("/api/v1/tokens", {{"name", "v"}, {"role", "viewer"}}).json().at("token").get<std::string>();
  EXPECT_EQ(status_of(import("wrong")), 401);
  EXPECT_EQ(status_of(import(viewer)), 403);
  EXPECT_EQ(status_of(import(viewer)), 403) << "who is remembered by now";
  const std::string installer =
      admin->post("/api/v1/tokens", {{"name", "i"}, {"role", "installer"}}).json().at("token").get<std::string>();
  RawConnection connection(app->port());
  connection.send(import(installer));
  EXPECT_EQ(connection.receive("\r\n", std::chrono::milliseconds(300)), "") << "who may send it is waited for";
}

TEST_F(ConnectionTest, AFoldedFieldIsRefused) {
  EXPECT_EQ(status_of(head("GET /healthz", "X-Long: a\r\n b\r\n")), 400);
  EXPECT_EQ(status_of(head("GET /healthz", "X-Long: a\r\n\tb\r\n")), 400);
  EXPECT_EQ(status_of("GET /healthz HTTP/1.1\r\n Host: 127.0.0.1\r\n\r\n"), 400);
  EXPECT_EQ(status_of(head("GET /healthz", "X-Long: a b\r\n")), 200);
  EXPECT_EQ(status_of(head("POST /api/v1/login", "Content-Length: 5\r\n") + "{}\n {"), 400) << "no JSON, but a body";
}

TEST_F(ConnectionTest, WhatIsTooLargeIsAnsweredToWhoSendsAllOfItFirst) {
  const std::string installer =
      admin->post("/api/v1/tokens", {{"name", "i"}, {"role", "installer"}}).json().at("token").get<std::string>();
  const std::string body(50'000'000, 'x');  // made first: under a sanitizer that takes longer than the server waits
  RawConnection connection(app->port());
  connection.send(
      head("POST /api/v1/tours", "Content-Length: 50000000\r\nAuthorization: Bearer " + installer + "\r\n"));
  ASSERT_TRUE(connection.send(body));
  EXPECT_NE(connection.receive().find("HTTP/1.1 413"), std::string::npos);
}

TEST_F(ConnectionTest, AStrangerMayNotSendMoreThanASecret) {
  const std::string text(20'000, ' ');
  EXPECT_EQ(status_of(head("POST /api/v1/login", "Content-Length: 20000\r\n") + text), 413);
  EXPECT_EQ(
      status_of(head("POST /api/v1/setup", "Transfer-Encoding: chunked\r\n") + "4e20\r\n" + text + "\r\n0\r\n\r\n"),
      413);
}

TEST_F(ConnectionTest, AFloodOfHalfRequestsKeepsNobodyOut) {
  std::vector<std::unique_ptr<RawConnection>> flood;
  for (int i = 0; i < 400; ++i) {
    flood.push_back(std::make_unique<RawConnection>(app->port()));
    flood.back()->send("GET /healthz HTTP/1.1\r\nHost:");
    if (i % 20 == 0) {
      ASSERT_EQ(health(), 200) << i;
    }
  }
  for (int i = 0; i < 40; ++i) ASSERT_EQ(admin->get("/api/v1/robots").status, 200) << i;
  EXPECT_TRUE(flood.front()->receive().empty());
  EXPECT_TRUE(flood.front()->closed()) << "who has waited longest had to go";
}

TEST_F(ConnectionTest, DamagedRequestsEndNothingButTheirConnection) {
  testing::Mutator mutator(7);
  const std::string cookie = "Cookie: " + admin->cookie + "\r\n";
  const std::vector<std::string> requests = {
      head("GET /api/v1/maps?from=a%20b", cookie),
      head("POST /api/v1/login", "Content-Length: 31\r\n") + R"({"name":"anna","password":"no"})",
      head("POST /api/v1/login", "Transfer-Encoding: chunked\r\n") + "3;a=b\r\n{\"n\r\n4\r\name\"\r\n0\r\n\r\n",
      head("GET /api/v1/events", cookie + "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n" +
                                     "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nOrigin: http://127.0.0.1\r\n"),
      head("HEAD /index.html", "If-None-Match: \"a\"\r\n") + head("GET /readyz", "")};
  for (int i = 0; i < 400; ++i) {
    const std::string& whole = requests[static_cast<std::size_t>(i) % requests.size()];
    const testing::Bytes damaged = mutator.damaged(testing::Bytes(whole.begin(), whole.end()));
    RawConnection connection(app->port());
    connection.send({damaged.begin(), damaged.end()});
    if (i % 10 == 0) {
      ASSERT_EQ(health(), 200) << i;
    }
  }
  EXPECT_EQ(health(), 200);
}

TEST_F(ConnectionTest, DamagedFramesEndNothingButTheirSocket) {
  testing::Mutator mutator(8);
  const std::string port = std::to_string(app->port());
  const std::string handshake =
      head("GET /api/v1/events", "Cookie: " + admin->cookie + "\r\nOrigin: http://127.0.0.1:" + port +
                                     "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n" +
                                     "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n");
  // Masked with zeros: a text, a ping, the two halves of a text, a length of 64 bits, and a farewell.
  const std::string zeros(4, '\0');
  const std::string frames = "\x81\x82" + zeros + "{}" + "\x89\x81" + zeros + "p" + std::string("\x01\x81", 2) + zeros +
                             "{" + "\x80\x81" + zeros + "}" + "\x82\xFF" + std::string("\0\0\0\0\0\0\0\x02", 8) +
                             zeros + "ab" + "\x88\x82" + zeros + "\x03\xE8";
  for (int i = 0; i < 150; ++i) {
    RawConnection connection(app->port());
    connection.send(handshake);
    ASSERT_TRUE(connection.receive("\r\n\r\n").starts_with("HTTP/1.1 101")) << i;
    const testing::Bytes damaged = mutator.damaged(testing::Bytes(frames.begin(), frames.end()));
    connection.send({damaged.begin(), damaged.end()});
    if (i % 10 == 0) {
      ASSERT_EQ(health(), 200) << i;
    }
  }
  EXPECT_EQ(health(), 200);
}

}  // namespace
}  // namespace homeward::server::connection_test
