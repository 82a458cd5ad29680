// SPDX-License-Identifier: Apache-2.0
#include "support/driving_fixture.hpp"

namespace homeward::server::removal_test {
namespace {

using testing::FakeAgent;
using testing::HttpClient;

/// Removing things, and who may see whose.
class RemovalTest : public testing::ServerTest {
 protected:
  HttpClient program(const std::string& secret) {
    HttpClient client(app->port());
    client.defaults = {{"Authorization", "Bearer " + secret}};
    return client;
  }
  nlohmann::json new_robot(const std::string& name) { return admin->post("/api/v1/robots", {{"name", name}}).json(); }
  static nlohmann::json tour_request() {
    return {{"name", "tour"}, {"camera", wire::camera_to_json(testing::small_panorama_camera())}};
  }
};

TEST_F(RemovalTest, ARobotSeesNoToursButItsOwn) {
  HttpClient chair = program(new_robot("chair").at("token"));
  HttpClient other = program(new_robot("other").at("token"));
  HttpClient uploader = program(admin->post("/api/v1/tokens", {{"name", "u"}, {"role", "robot"}}).json().at("token"));
  const std::string persons = add_tour();
  const std::string own = chair.post("/api/v1/tours", tour_request()).json().at("id");
  const std::string uploaded = uploader.post("/api/v1/tours", tour_request()).json().at("id");
  const std::string picture = testing::room_picture(1, 1);
  const testing::Headers jpeg = {{"Content-Type", "image/jpeg"}};
  const std::string mine = "/api/v1/tours/" + own;
  EXPECT_EQ(chair.get(mine).status, 200);
  EXPECT_EQ(chair.send("PUT", mine + "/images/0", picture, jpeg).status, 201);
  EXPECT_EQ(chair.get(mine + "/images/0").status, 200);
  for (const std::string& tour : {persons, uploaded}) {
    const std::string path = "/api/v1/tours/" + tour;
    ASSERT_EQ(admin->send("PUT", path + "/images/0", picture, jpeg).status, 201);
    EXPECT_EQ(chair.get(path).status, 404);
    EXPECT_EQ(chair.get(path + "/images/0").status, 404);
    EXPECT_EQ(chair.send("PUT", path + "/images/1", picture, jpeg).status, 404);
    EXPECT_EQ(chair.put(path + "/marks", {{"marks", nlohmann::json::array()}}).status, 404);
    EXPECT_EQ(chair.post(path + "/complete").status, 404);
  }
  EXPECT_EQ(other.get(mine).status, 404);
  EXPECT_EQ(chair.get("/api/v1/tours").json().at("tours").size(), 1U);
  EXPECT_EQ(uploader.get("/api/v1/tours").json().at("tours").size(), 1U);
  EXPECT_EQ(admin->get("/api/v1/tours").json().at("tours").size(), 3U);
  restart();
  HttpClient after = program(uploader.defaults.at("Authorization").substr(7));
  EXPECT_EQ(after.get("/api/v1/tours/" + uploaded).status, 200);
}

TEST_F(RemovalTest, ATourGoesUnlessAMapIsBuiltFromIt) {
  const std::string tour = add_tour();
  ASSERT_EQ(put_image(tour, 0, testing::room_picture(1, 1)), 201);
  HttpClient carer = signed_in("carla", "carer");
  EXPECT_EQ(carer.send("DELETE", "/api/v1/tours/" + tour).status, 403);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tours/" + tour).status, 204);
  EXPECT_EQ(admin->get("/api/v1/tours/" + tour).status, 404);
  EXPECT_FALSE(std::filesystem::exists(config.data / "tours" / tour));
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tours/" + tour).status, 404);
  built_map(2);
  const std::string used = admin->get("/api/v1/tours").json().at("tours").at(0).at("id");
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tours/" + used).status, 409);
  EXPECT_EQ(admin->get("/api/v1/tours/" + used).status, 200);
}

TEST_F(RemovalTest, ARobotGoesWithItsTokensAndItsLink) {
  const nlohmann::json robot = new_robot("chair");
  const std::string id = robot.at("id");
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), id, robot.at("token")), 101);
  agent.hello();
  ASSERT_TRUE(agent.await<wire::Welcome>());
  HttpClient carer = signed_in("carla", "carer");
  EXPECT_EQ(carer.send("DELETE", "/api/v1/robots/" + id).status, 403);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/robots/" + id).status, 204);
  EXPECT_FALSE(agent.await<wire::Welcome>(std::chrono::seconds(5)));
  EXPECT_TRUE(agent.socket.closed());
  EXPECT_EQ(admin->get("/api/v1/robots/" + id).status, 404);
  EXPECT_EQ(program(robot.at("token")).get("/api/v1/me").status, 401);
  FakeAgent again;
  EXPECT_EQ(again.connect(app->port(), id, robot.at("token")), 401);
  EXPECT_EQ(admin->send("DELETE", "/api/v1/robots/" + id).status, 404);
}

TEST_F(RemovalTest, ALinkWithoutAHelloIsClosed) {
  const nlohmann::json robot = new_robot("chair");
  FakeAgent silent;
  ASSERT_EQ(silent.connect(app->port(), robot.at("id"), robot.at("token")), 101);
  FakeAgent other;
  ASSERT_EQ(other.connect(app->port(), robot.at("id"), robot.at("token")), 101);
  other.hello();
  ASSERT_TRUE(other.await<wire::Welcome>());
  clock.pass(std::chrono::seconds(4));
  app->tick();
  EXPECT_FALSE(silent.socket.receive(std::chrono::milliseconds(50)));
  EXPECT_FALSE(silent.socket.closed());
  clock.pass(std::chrono::seconds(2));
  app->tick();
  EXPECT_FALSE(silent.socket.receive(std::chrono::seconds(5)));
  EXPECT_TRUE(silent.socket.closed());
}

TEST_F(RemovalTest, AHelloIsPlainText) {
  const nlohmann::json robot = new_robot("chair");
  FakeAgent agent;
  ASSERT_EQ(agent.connect(app->port(), robot.at("id"), robot.at("token")), 101);
  wire::Hello hello;
  hello.agent = "agent\n[info] all is well";
  hello.robot_name = "chair";
  hello.session = "s";
  hello.camera = testing::small_panorama_camera();
  agent.say(hello);
  EXPECT_FALSE(agent.await<wire::Welcome>(std::chrono::seconds(5)));
  EXPECT_TRUE(agent.socket.closed());
}

}  // namespace
}  // namespace homeward::server::removal_test
