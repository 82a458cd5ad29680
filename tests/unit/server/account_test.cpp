// SPDX-License-Identifier: Apache-2.0
#include "support/server_fixture.hpp"

namespace homeward::server::account_test {
namespace {

using testing::Answer;
using testing::HttpClient;

class AccountTest : public testing::ServerTest {};

TEST_F(AccountTest, TheSetUpLinkWorksOnce) {
  EXPECT_FALSE(admin->get("/api/v1/setup").json().at("needed").get<bool>());
  HttpClient thief(app->port());
  const Answer again =
      thief.post("/api/v1/setup", {{"token", setup_token}, {"name", "eve"}, {"password", "long enough"}});
  EXPECT_TRUE(again.status == 403 || again.status == 409) << again.body;
  EXPECT_EQ(thief.get("/api/v1/me").status, 401);
  EXPECT_EQ(admin->get("/api/v1/me").json().at("user").at("role"), "admin");
  restart();
  EXPECT_TRUE(app->setup_link().empty());
  EXPECT_EQ(admin->get("/api/v1/me").json().at("user").at("name"), "anna") << "a session outlives the process";
}

TEST_F(AccountTest, FiveFailuresThenWait) {
  HttpClient client(app->port());
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(client.post("/api/v1/login", {{"name", "anna"}, {"password", "wrong"}}).status, 401) << i;
  }
  const Answer sixth = client.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}});
  EXPECT_EQ(sixth.status, 429);
  EXPECT_GE(std::stoi(sixth.headers.at("retry-after")), 1);
  EXPECT_EQ(client.post("/api/v1/login", {{"name", "nobody"}, {"password", "wrong"}}).status, 401)
      << "another name is another counter";
  clock.pass(std::chrono::seconds(std::stoi(sixth.headers.at("retry-after")) + 1));
  EXPECT_EQ(client.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}}).status, 200)
      << "whoever has waited may try again";
}

TEST_F(AccountTest, TheCookieIsOutOfReachOfScripts) {
  HttpClient client(app->port());
  const Answer login = client.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}});
  ASSERT_EQ(login.status, 200);
  EXPECT_NE(login.headers.at("set-cookie").find("HttpOnly"), std::string::npos);
  EXPECT_NE(login.headers.at("set-cookie").find("SameSite=Strict"), std::string::npos);
  const std::string cookie = client.cookie;
  EXPECT_EQ(client.post("/api/v1/logout").status, 204);
  EXPECT_EQ(client.get("/api/v1/me", {{"Cookie", cookie}}).status, 401) << "signed out means gone on the server too";
}

TEST_F(AccountTest, ASessionEndsAfterThirtyDays) {
  clock.pass(std::chrono::hours(29 * 24));
  EXPECT_EQ(admin->get("/api/v1/me").status, 200);
  clock.pass(std::chrono::hours(2 * 24));
  EXPECT_EQ(admin->get("/api/v1/me").status, 401);
}

TEST_F(AccountTest, RolesBoundWhatIsAllowed) {
  HttpClient carer = signed_in("carla", "carer");
  EXPECT_EQ(carer.get("/api/v1/maps").status, 200);
  EXPECT_EQ(carer.post("/api/v1/robots", {{"name", "r"}}).status, 403);
  EXPECT_EQ(carer.get("/api/v1/users").status, 403);
  EXPECT_EQ(admin->post("/api/v1/users", {{"name", "short"}, {"password", "1234567"}, {"role", "viewer"}}).status, 422);
  EXPECT_EQ(admin->post("/api/v1/users", {{"name", "CARLA"}, {"password", "long enough"}, {"role", "viewer"}}).status,
            409);
  EXPECT_EQ(admin->get("/api/v1/users").json().at("users").size(), 2U);
}

TEST_F(AccountTest, TokensAreShownOnceAndRevoked) {
  const nlohmann::json made = admin->post("/api/v1/tokens", {{"name", "reader"}, {"role", "viewer"}}).json();
  HttpClient program(app->port());
  program.defaults.clear();
  const testing::Headers bearer = {{"Authorization", "Bearer " + made.at("token").get<std::string>()}};
  EXPECT_EQ(program.get("/api/v1/maps", bearer).status, 200);
  EXPECT_EQ(program.get("/api/v1/users", bearer).status, 403);
  EXPECT_EQ(admin->get("/api/v1/tokens").body.find(made.at("token").get<std::string>()), std::string::npos);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tokens/" + made.at("id").get<std::string>()).status, 204);
  EXPECT_EQ(program.get("/api/v1/maps", bearer).status, 401) << "revoked at once";
  HttpClient installer = signed_in("ingo", "installer");
  EXPECT_EQ(installer.post("/api/v1/tokens", {{"name", "x"}, {"role", "admin"}}).status, 403)
      << "nobody hands out more than he has";
}

TEST_F(AccountTest, ASecretHoldsAfterARestartUntilItIsTakenBack) {
  const nlohmann::json made = admin->post("/api/v1/tokens", {{"name", "reader"}, {"role", "viewer"}}).json();
  const testing::Headers bearer = {{"Authorization", "Bearer " + made.at("token").get<std::string>()}};
  restart();
  HttpClient program(app->port());
  EXPECT_EQ(program.get("/api/v1/maps", bearer).status, 200);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tokens/" + made.at("id").get<std::string>()).status, 204);
  EXPECT_EQ(program.get("/api/v1/maps", bearer).status, 401);
  restart();
  EXPECT_EQ(HttpClient(app->port()).get("/api/v1/maps", bearer).status, 401);
}

TEST_F(AccountTest, ASocketEndsWithTheSecretThatOpenedIt) {
  const nlohmann::json made = admin->post("/api/v1/tokens", {{"name", "reader"}, {"role", "viewer"}}).json();
  const testing::Headers bearer = {{"Authorization", "Bearer " + made.at("token").get<std::string>()}};
  testing::SocketClient of_token;
  ASSERT_EQ(of_token.open(app->port(), "/api/v1/events", bearer), 101);
  testing::SocketClient of_admin;
  ASSERT_EQ(
      of_admin.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults["Origin"]}}),
      101);
  const auto read_for = [](testing::SocketClient& socket, std::chrono::milliseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!socket.closed() && std::chrono::steady_clock::now() < end) socket.receive(std::chrono::milliseconds(50));
    return socket.closed();
  };
  EXPECT_FALSE(read_for(of_token, std::chrono::milliseconds(800)));
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tokens/" + made.at("id").get<std::string>()).status, 204);
  EXPECT_TRUE(read_for(of_token, std::chrono::seconds(5)));
  EXPECT_FALSE(read_for(of_admin, std::chrono::milliseconds(800))) << "the others stay";
  EXPECT_EQ(admin->post("/api/v1/logout").status, 204);
  EXPECT_TRUE(read_for(of_admin, std::chrono::seconds(5)));
}

TEST_F(AccountTest, WhoTriesManyNamesHasToWaitAndNobodyElse) {
  config.trusted_proxies = {"127.0.0.1"};
  restart();
  HttpClient attacker(app->port());
  attacker.defaults["X-Forwarded-For"] = "anna's own, 10.0.0.1";
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(attacker.post("/api/v1/login", {{"name", "n" + std::to_string(i)}, {"password", "wrong"}}).status, 401)
        << i;
  }
  EXPECT_EQ(attacker.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}}).status, 429);
  HttpClient anna(app->port());
  anna.defaults["X-Forwarded-For"] = "10.0.0.2";
  EXPECT_EQ(anna.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}}).status, 200);
  clock.pass(std::chrono::seconds(61));
  EXPECT_EQ(attacker.post("/api/v1/login", {{"name", "anna"}, {"password", "correct horse"}}).status, 200);
}

TEST_F(AccountTest, TheSameKeyGetsTheSameAnswer) {
  const testing::Headers key = {{"Idempotency-Key", "k1"}};
  const nlohmann::json body = {{"name", "bert"}, {"password", "long enough"}, {"role", "viewer"}};
  const Answer first = admin->post("/api/v1/users", body, key);
  const Answer second = admin->post("/api/v1/users", body, key);
  EXPECT_EQ(first.status, 201);
  EXPECT_EQ(second.status, 201);
  EXPECT_EQ(first.body, second.body);
  EXPECT_EQ(admin->post("/api/v1/users", body, {{"Idempotency-Key", "k2"}}).status, 409);
  clock.pass(std::chrono::hours(23));
  EXPECT_EQ(admin->post("/api/v1/users", body, key).body, first.body);
  clock.pass(std::chrono::hours(2));
  EXPECT_EQ(admin->post("/api/v1/users", body, key).status, 409) << "a day later the key is forgotten";
}

}  // namespace
}  // namespace homeward::server::account_test
