// SPDX-License-Identifier: Apache-2.0
#include "agent/upload/upload.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "files/tour_tables.hpp"
#include "imageio/decode.hpp"
#include "support/rest_server.hpp"
#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::upload_test {
namespace {

using homeward::testing::RestServer;
using nlohmann::json;

/// What a server keeps of tours, so far as an upload asks for it.
class KeptTours {
 public:
  RestServer::Reply answer(const RestServer::Request& request) {
    const std::string& path = request.path;
    const std::string tours = "/api/v1/tours";
    if (request.method == "GET" && path == tours) return {200, list().dump()};
    if (request.method == "POST" && path == tours) {
      names.push_back(json::parse(request.body)["name"]);
      complete.push_back(false);
      pictures.emplace_back();
      return {201, json{{"id", std::to_string(names.size() - 1)}}.dump()};
    }
    const std::size_t tour = std::stoul(path.substr(tours.size() + 1));
    if (path.ends_with("/marks")) return {200, "{}"};
    if (path.ends_with("/complete")) {
      complete[tour] = true;
      return {200, "{}"};
    }
    pictures[tour].insert(path.substr(path.rfind('/') + 1));
    return {201, "{}"};
  }

  std::vector<std::string> names;
  std::vector<bool> complete;
  std::vector<std::set<std::string>> pictures;

 private:
  [[nodiscard]] json list() const {
    json all = json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
      all.push_back({{"id", std::to_string(i)}, {"name", names[i]}, {"state", complete[i] ? "complete" : "open"}});
    }
    return {{"tours", all}};
  }
};

class UploadTest : public ::testing::Test {
 protected:
  UploadTest() {
    const Image black(16, 8, 3);
    files::TourTables tables;
    for (const char* name : {"00000.jpg", "00001.jpg"}) {
      const std::vector<std::uint8_t> jpeg = imageio::encode_jpeg(black, 90);
      folder_.put(name, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
      tables.add(name, 1000, Pose2{}, std::nullopt);
    }
    EXPECT_TRUE(tables.write(folder_.path(), homeward::testing::sphere_camera(16)));
  }

  Result<UploadedTour> upload(bool own_name) {
    RestClient client({false, "127.0.0.1", std::to_string(server_.port())}, "token");
    UploadOptions options;
    options.folder = folder_.path().string();
    options.name = "Exploration x";
    options.own_name = own_name;
    return upload_tour(client, options, [](double) { return true; });
  }

  homeward::testing::ScratchFolder folder_;
  KeptTours tours_;  // the server's thread, but between uploads
  RestServer server_{[this](const RestServer::Request& request) { return tours_.answer(request); }};
};

TEST_F(UploadTest, ATourOfItsOwnNameThatIsCompleteIsNotMadeAgain) {
  const auto first = upload(true);
  ASSERT_TRUE(first) << first.error().message;
  const auto again = upload(true);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->id, first->id);
  EXPECT_EQ(tours_.names.size(), 1U);
  EXPECT_EQ(tours_.pictures[0].size(), 2U);
}

TEST_F(UploadTest, ATourWhoseNameMayComeAgainIsAnotherOne) {
  const auto first = upload(false);
  const auto again = upload(false);
  ASSERT_TRUE(first && again);
  EXPECT_NE(again->id, first->id);
}

}  // namespace
}  // namespace homeward::agent::upload_test
