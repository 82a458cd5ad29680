// SPDX-License-Identifier: Apache-2.0
#include "support/server_fixture.hpp"

namespace homeward::server::user_test {
namespace {

using testing::Answer;
using testing::HttpClient;

class UserTest : public testing::ServerTest {
 protected:
  std::string id_of(const std::string& name) {
    const nlohmann::json users = admin->get("/api/v1/users").json().at("users");
    for (const auto& user : users) {
      if (user.at("name") == name) return user.at("id");
    }
    return "none";
  }
  Answer password(HttpClient& client, const std::string& user, const nlohmann::json& body) {
    return client.put("/api/v1/users/" + user + "/password", body);
  }
  int login(const std::string& name, const std::string& password) {
    HttpClient client(app->port());
    return client.post("/api/v1/login", {{"name", name}, {"password", password}}).status;
  }
};

TEST_F(UserTest, OnesOwnPasswordIsChangedAgainstTheOldOneAndEndsAllOtherSessions) {
  HttpClient carla = signed_in("carla", "carer");
  HttpClient other(app->port());
  ASSERT_EQ(other.post("/api/v1/login", {{"name", "carla"}, {"password", "a long password"}}).status, 200);
  const std::string id = id_of("carla");
  EXPECT_EQ(password(carla, id, {{"password", "another password"}}).status, 422) << "without the old one";
  EXPECT_EQ(password(carla, id, {{"password", "another password"}, {"old_password", "wrong"}}).status, 403);
  EXPECT_EQ(password(carla, id, {{"password", "short"}, {"old_password", "a long password"}}).status, 422);
  EXPECT_EQ(other.get("/api/v1/me").status, 200) << "nothing has changed yet";
  EXPECT_EQ(password(carla, id, {{"password", "another password"}, {"old_password", "a long password"}}).status, 204);
  EXPECT_EQ(carla.get("/api/v1/me").status, 200);
  EXPECT_EQ(other.get("/api/v1/me").status, 401);
  EXPECT_EQ(login("carla", "a long password"), 401);
  EXPECT_EQ(login("carla", "another password"), 200);
  restart();
  EXPECT_EQ(login("carla", "another password"), 200);
}

TEST_F(UserTest, TheOldPasswordIsNotGuessedFasterThanAtTheLogin) {
  HttpClient carla = signed_in("carla", "carer");
  const std::string id = id_of("carla");
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(password(carla, id, {{"password", "another password"}, {"old_password", "wrong"}}).status, 403) << i;
  }
  EXPECT_EQ(password(carla, id, {{"password", "another password"}, {"old_password", "a long password"}}).status, 429);
}

TEST_F(UserTest, SomebodyElsesPasswordIsSetByAnAdminAlone) {
  HttpClient carla = signed_in("carla", "carer");
  HttpClient ingo = signed_in("ingo", "installer");
  const std::string id = id_of("carla");
  EXPECT_EQ(password(ingo, id, {{"password", "another password"}}).status, 403);
  EXPECT_EQ(password(*admin, id, {{"password", "another password"}}).status, 204);
  EXPECT_EQ(carla.get("/api/v1/me").status, 401);
  EXPECT_EQ(login("carla", "another password"), 200);
  EXPECT_EQ(password(*admin, "nobody", {{"password", "another password"}}).status, 404);
}

TEST_F(UserTest, ANewRoleHoldsAtOnce) {
  HttpClient carla = signed_in("carla", "viewer");
  const std::string path = "/api/v1/users/" + id_of("carla") + "/role";
  EXPECT_EQ(carla.put(path, {{"role", "admin"}}).status, 403);
  EXPECT_EQ(carla.post("/api/v1/robots", {{"name", "r"}}).status, 403);
  EXPECT_EQ(admin->put(path, {{"role", "installer"}}).status, 204);
  EXPECT_EQ(carla.post("/api/v1/robots", {{"name", "r"}}).status, 201);
  EXPECT_EQ(admin->put(path, {{"role", "robot"}}).status, 422);
  EXPECT_EQ(admin->put("/api/v1/users/" + id_of("anna") + "/role", {{"role", "viewer"}}).status, 409)
      << "the last admin";
}

TEST_F(UserTest, WhoIsRemovedIsGone) {
  HttpClient carla = signed_in("carla", "admin");
  EXPECT_EQ(admin->send("DELETE", "/api/v1/users/" + id_of("carla")).status, 204);
  EXPECT_EQ(carla.get("/api/v1/me").status, 401);
  EXPECT_EQ(login("carla", "a long password"), 401);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/users/" + id_of("anna")).status, 409) << "the last admin";
  EXPECT_EQ(admin->send("DELETE", "/api/v1/users/nobody").status, 404);
}

TEST_F(UserTest, ANameIsOneLineOfPlainText) {
  for (const std::string& name :
       {std::string("a\nb"), std::string("\x1b[2J"), std::string("\u202egnp"), std::string("a\u0085")}) {
    EXPECT_EQ(
        admin->post("/api/v1/users", {{"name", name}, {"password", "a long password"}, {"role", "viewer"}}).status,
        422);
    EXPECT_EQ(admin->post("/api/v1/robots", {{"name", name}}).status, 422);
    EXPECT_EQ(admin->post("/api/v1/tokens", {{"name", name}, {"role", "viewer"}}).status, 422);
    EXPECT_EQ(admin->post("/api/v1/maps", {{"name", name}, {"tours", {"t"}}}).status, 422);
  }
  EXPECT_EQ(admin->post("/api/v1/robots", {{"name", "Zoë’s chair"}}).status, 201);
}

TEST_F(UserTest, TheCookieIsKeptToTlsWhereItCameByIt) {
  const nlohmann::json login = {{"name", "anna"}, {"password", "correct horse"}};
  HttpClient client(app->port());
  const testing::Headers by_tls = {{"X-Forwarded-Proto", "https"}, {"X-Forwarded-For", "10.0.0.9"}};
  EXPECT_EQ(client.post("/api/v1/login", login, by_tls).headers.at("set-cookie").find("Secure"), std::string::npos)
      << "anybody may say so";
  config.trusted_proxies = {"127.0.0.1"};
  restart();
  HttpClient behind(app->port());
  EXPECT_NE(behind.post("/api/v1/login", login, by_tls).headers.at("set-cookie").find("; Secure"), std::string::npos);
  EXPECT_EQ(behind.post("/api/v1/login", login).headers.at("set-cookie").find("Secure"), std::string::npos);
}

}  // namespace
}  // namespace homeward::server::user_test
