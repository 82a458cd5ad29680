// SPDX-License-Identifier: Apache-2.0
#include "build_load.hpp"

#include "support/room_picture.hpp"
#include "wire/camera_json.hpp"

namespace homeward::bench {
namespace {

constexpr int kPictures = 40;
constexpr int kPicturesOfRoom = 3;
constexpr std::chrono::milliseconds kAsksEvery{200};

std::string uploaded_tour(ServerProcess& server) {
  testing::HttpClient& admin = server.admin();
  const nlohmann::json about = {{"name", "tour"}, {"camera", wire::camera_to_json(testing::small_panorama_camera())}};
  const std::string tour = server.expect(201, admin.post("/api/v1/tours", about)).json().at("id");
  for (int i = 0; i < kPictures; ++i) {
    const std::string jpeg =
        testing::room_picture(static_cast<unsigned>(i / kPicturesOfRoom + 1), static_cast<unsigned>(i));
    const std::string path = "/api/v1/tours/" + tour + "/images/" + std::to_string(i);
    server.expect(201, admin.send("PUT", path, jpeg, {{"Content-Type", "image/jpeg"}}));
  }
  server.expect(200, admin.post("/api/v1/tours/" + tour + "/complete"));
  return tour;
}

}  // namespace

BuildLoad::BuildLoad(ServerProcess& server) {
  const nlohmann::json wanted = {{"name", "built"}, {"tours", {uploaded_tour(server)}}};
  const nlohmann::json begun = server.expect(202, server.admin().post("/api/v1/maps", wanted)).json();
  const std::string map = begun.at("map").at("id");
  thread_ = std::jthread([this, client = server.admin(), map,
                          job = begun.at("job").at("id").get<std::string>()](const std::stop_token& told) mutable {
    while (!told.stop_requested()) {
      std::this_thread::sleep_for(kAsksEvery);
      const std::string state = client.get("/api/v1/jobs/" + job).json().at("state");
      if (state == "queued" || state == "running") continue;
      if (state == "done") ++done_;
      job = client.post("/api/v1/maps/" + map + "/builds").json().at("job").at("id");
    }
  });
}

}  // namespace homeward::bench
