// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "server/app.hpp"
#include "support/http_client.hpp"
#include "support/moved_clock.hpp"
#include "support/room_picture.hpp"
#include "wire/camera_json.hpp"

namespace homeward::testing {

/// A server of its own on a free port with a folder of its own; signed in as the first administrator.
class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "homeward-server-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    config.data = name;
    config.port = 0;
    config.threads = 2;
    start();
    const std::string link = app->setup_link();
    setup_token = link.substr(link.find("token=") + 6);
    const Answer made =
        admin->post("/api/v1/setup", {{"token", setup_token}, {"name", "anna"}, {"password", "correct horse"}});
    ASSERT_EQ(made.status, 201) << made.body;
  }
  void TearDown() override {
    app.reset();
    std::filesystem::remove_all(config.data);
  }
  void start() {
    auto started = server::App::start(config, clock);
    ASSERT_TRUE(started) << started.error().message;
    app = std::move(*started);
    const std::string cookie = admin ? admin->cookie : "";
    admin.emplace(app->port());
    admin->cookie = cookie;
  }
  void restart() {
    app.reset();
    start();
  }

  HttpClient signed_in(const std::string& name, const std::string& role) {
    EXPECT_EQ(admin->post("/api/v1/users", {{"name", name}, {"password", "a long password"}, {"role", role}}).status,
              201);
    HttpClient client(app->port());
    EXPECT_EQ(client.post("/api/v1/login", {{"name", name}, {"password", "a long password"}}).status, 200);
    return client;
  }

  std::string add_tour() {
    return admin->post("/api/v1/tours", {{"name", "tour"}, {"camera", wire::camera_to_json(small_panorama_camera())}})
        .json()
        .at("id");
  }
  int put_image(const std::string& tour, int number, const std::string& bytes) {
    return admin
        ->send("PUT", "/api/v1/tours/" + tour + "/images/" + std::to_string(number), bytes,
               {{"Content-Type", "image/jpeg"}})
        .status;
  }
  /// A complete tour through `rooms` rooms with three pictures each; the last picture is marked "home".
  std::string complete_tour(int rooms) {
    const std::string tour = add_tour();
    for (int i = 0; i < rooms * 3; ++i) {
      EXPECT_EQ(put_image(tour, i, room_picture(static_cast<unsigned>(i / 3 + 1), static_cast<unsigned>(i))), 201);
    }
    char last[32];
    std::snprintf(last, sizeof last, "%06d.jpg", rooms * 3 - 1);
    const nlohmann::json marks = {{"marks", {{{"image", last}, {"label", "home"}}}}};
    const Answer marked = admin->put("/api/v1/tours/" + tour + "/marks", marks);
    EXPECT_EQ(marked.status, 200) << marked.body;
    EXPECT_EQ(admin->post("/api/v1/tours/" + tour + "/complete").status, 200);
    return tour;
  }
  nlohmann::json wait_for_job(const std::string& job) {
    for (int i = 0; i < 12'000; ++i) {
      nlohmann::json state = admin->get("/api/v1/jobs/" + job).json();
      if (state.at("state") != "queued" && state.at("state") != "running") return state;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {{"state", "never ended"}};
  }
  std::string built_map(int rooms) {
    const Answer begun = admin->post("/api/v1/maps", {{"name", "house"}, {"tours", {complete_tour(rooms)}}});
    EXPECT_EQ(begun.status, 202) << begun.body;
    const nlohmann::json job = wait_for_job(begun.json().at("job").at("id"));
    EXPECT_EQ(job.at("state"), "done") << job.dump();
    return begun.json().at("map").at("id");
  }

  MovedClock clock;
  server::AppConfig config;
  std::unique_ptr<server::App> app;
  std::optional<HttpClient> admin;
  std::string setup_token;
};

}  // namespace homeward::testing
