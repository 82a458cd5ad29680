// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "server/services/tours.hpp"
#include "support/server_fixture.hpp"

namespace homeward::server::tour_test {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::room_picture;

class TourTest : public testing::ServerTest {
 protected:
  /// Takes a change back that closed the ways from one place to another, makes it again, and takes it back.
  void step_through_the_change(const std::string& root, const Answer& closed, const std::string& from,
                               const std::string& to) {
    const auto route = [&] { return admin->get(root + "/route?from=" + from + "&to=" + to).status; };
    std::string tag = closed.headers.at("etag");
    for (const auto& [step, answered] : {std::pair("/undo", 200), {"/redo", 409}, {"/undo", 200}}) {
      EXPECT_EQ(admin->post(root + step, json::object(), {{"If-Match", "\"r1\""}}).code(), "stale_revision");
      EXPECT_EQ(admin->post(root + step).status, 428);
      const Answer made = admin->post(root + step, json::object(), {{"If-Match", tag}});
      ASSERT_EQ(made.status, 200) << made.body;
      tag = made.headers.at("etag");
      EXPECT_EQ(route(), answered) << step;
    }
    const json edits = admin->get(root + "/history").json().at("edits");
    EXPECT_EQ(edits.front().at("change"), 1);
    EXPECT_FALSE(edits.front().at("undone").get<bool>()) << "the change before stands";
    for (std::size_t i = 1; i < edits.size(); ++i) {
      EXPECT_EQ(edits[i].at("change"), 2) << "one request, one change";
      EXPECT_TRUE(edits[i].at("undone").get<bool>() && edits[i].at("redoable").get<bool>());
    }
  }
  Answer put(const std::string& tour, const std::string& number, const std::string& bytes,
             const testing::Headers& headers = {}) {
    return admin->send("PUT", "/api/v1/tours/" + tour + "/images/" + number, bytes, headers);
  }
};

TEST_F(TourTest, OnlyWholePicturesOfTheRightKindAreKept) {
  const std::string tour = add_tour();
  const std::string picture = room_picture(1, 1);
  Answer text = put(tour, "0", "this is no picture", {{"Content-Type", "image/jpeg"}});
  EXPECT_EQ(text.status, 415);
  EXPECT_EQ(text.code(), "unsupported_image");
  Answer half = put(tour, "0", picture.substr(0, picture.size() / 2));
  EXPECT_EQ(half.status, 422);
  EXPECT_EQ(half.code(), "truncated_image");
  const auto small = imageio::encode_jpeg(Image(64, 64, 3), 80);
  Answer wrong = put(tour, "0", {small.begin(), small.end()});
  EXPECT_EQ(wrong.status, 422);
  EXPECT_EQ(wrong.code(), "wrong_image_size");
  EXPECT_EQ(put(tour, "0", "").status, 415);
  EXPECT_EQ(admin->get("/api/v1/tours/" + tour).json().at("images"), 0) << "nothing of it was kept";
  EXPECT_EQ(put(tour, "-1", picture).status, 422);
  EXPECT_EQ(put(tour, "1x", picture).status, 422);
  EXPECT_EQ(put("none", "0", picture).status, 404);
  EXPECT_EQ(put(tour, "0", picture, {{"X-Homeward-Filename", "../x.jpg"}}).status, 422);
  EXPECT_EQ(put(tour, "0", picture, {{"X-Homeward-Odometry", "1,2"}}).status, 422);
  EXPECT_EQ(put(tour, "0", picture, {{"X-Homeward-Odometry", "1,2,nan"}}).status, 422);
}

TEST_F(TourTest, UploadsAreIdempotentAndResumable) {
  const std::string tour = add_tour();
  const std::string a = room_picture(1, 1);
  const std::string b = room_picture(1, 2);
  const Answer first = put(tour, "0", a, {{"X-Homeward-Filename", "a.jpg"}, {"X-Homeward-Odometry", "0.5,-1,3.1"}});
  EXPECT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(first.json().at("image"), tour + "/a.jpg");
  EXPECT_EQ(put(tour, "0", a, {{"X-Homeward-Filename", "a.jpg"}}).status, 200);
  EXPECT_EQ(put(tour, "0", b, {{"X-Homeward-Filename", "a.jpg"}}).status, 409);
  EXPECT_EQ(put(tour, "3", b).status, 201);
  EXPECT_EQ(admin->get("/api/v1/tours/" + tour).json().at("missing"), json({1, 2}));
  EXPECT_EQ(admin->post("/api/v1/tours/" + tour + "/complete").status, 409) << "two pictures are missing";
  restart();
  EXPECT_EQ(put(tour, "0", a, {{"X-Homeward-Filename", "a.jpg"}}).status, 200) << "kept over a restart";
  EXPECT_EQ(put(tour, "1", room_picture(1, 3)).status, 201);
  EXPECT_EQ(put(tour, "2", room_picture(1, 4)).status, 201);
  EXPECT_EQ(admin->put("/api/v1/tours/" + tour + "/marks", {{"marks", {{{"image", "z.jpg"}, {"label", "x"}}}}}).status,
            422);
  EXPECT_EQ(admin->post("/api/v1/tours/" + tour + "/complete").json().at("state"), "complete");
  EXPECT_EQ(put(tour, "4", a).status, 409) << "a complete tour takes no more";
  EXPECT_EQ(admin->get("/api/v1/tours/" + tour + "/images/0").body, a);
  EXPECT_EQ(admin->get("/api/v1/tours/" + tour + "/images/9").status, 404);
}

TEST_F(TourTest, SweepsComeWithTheirPicturesAndReachTheBuild) {
  const std::string tour = add_tour();
  const auto put_sweep = [&](const std::string& of, const std::string& number, const json& sweep) {
    return admin->put("/api/v1/tours/" + of + "/images/" + number + "/sweep", sweep);
  };
  json sweep = {{"ranges_m", {1.25, nullptr, 0.5}},
                {"angle_min_rad", -0.5},
                {"angle_step_rad", 0.5},
                {"range_max_m", 12.0},
                {"robot_from_scan", {{"x_m", 0.3}, {"y_m", 0.0}, {"theta_rad", 0.0}}}};
  EXPECT_EQ(put_sweep(tour, "0", sweep).status, 404) << "its picture is not there";
  for (const int number : {0, 1, 2}) {
    ASSERT_EQ(put(tour, std::to_string(number), room_picture(1, static_cast<unsigned>(number))).status, 201);
  }
  EXPECT_EQ(put_sweep(tour, "1", sweep).status, 204);
  EXPECT_EQ(put_sweep(tour, "1", sweep).status, 204) << "again";
  restart();
  json other = sweep;
  other["ranges_m"][0] = 1.26;
  const Answer changed = put_sweep(tour, "1", other);
  EXPECT_EQ(changed.status, 409);
  EXPECT_EQ(changed.json().at("where"), "tours/" + tour + "/images/1/sweep");
  other["ranges_m"][0] = -1.0;
  const Answer wrong = put_sweep(tour, "0", other);
  EXPECT_EQ(wrong.status, 422);
  EXPECT_EQ(wrong.json().at("where"), "body/ranges_m/0");
  const json text = sweep;
  EXPECT_EQ(admin
                ->send("PUT", "/api/v1/tours/" + tour + "/images/0/sweep", text.dump(),
                       {{"Content-Type", "application/json"}, {"X-Homeward-Filename", "z.jpg"}})
                .code(),
            "conflict")
      << "a sweep of another picture";
  EXPECT_EQ(put_sweep("none", "1", sweep).status, 404);
  EXPECT_EQ(put_sweep(tour, "x", sweep).status, 422);
  EXPECT_EQ(admin->send("PUT", "/api/v1/tours/" + tour + "/images/0/sweep", "[1,").status, 400);
  other = sweep;
  other["ranges_m"] = std::vector<double>(10'001, 1.0);
  const Answer many = put_sweep(tour, "0", other);
  EXPECT_EQ(many.status, 422) << "too many rays";
  EXPECT_EQ(many.json().at("where"), "body/ranges_m");
  EXPECT_EQ(admin->send("PUT", "/api/v1/tours/" + tour + "/images/0/sweep", std::string(1'100'000, ' ')).status, 413);
  other["ranges_m"] = std::vector<double>(10'000, 1.0);
  EXPECT_EQ(put_sweep(tour, "2", other).status, 204) << "as many as there may be";
  EXPECT_EQ(admin->post("/api/v1/tours/" + tour + "/complete").json().at("state"), "complete");
  EXPECT_EQ(put_sweep(tour, "1", sweep).status, 204) << "was there before";
  EXPECT_EQ(put_sweep(tour, "0", sweep).status, 409) << "a complete tour takes no more";

  app.reset();
  const auto store = db::open_sqlite_store(config.data);
  ASSERT_TRUE(store) << store.error().message;
  const auto source = stored_tour(**store, TourId(tour));
  ASSERT_TRUE(source) << source.error().message;
  const auto& images = (*source)->images();
  EXPECT_FALSE(images[0].sweep);
  ASSERT_TRUE(images[1].sweep);
  EXPECT_FLOAT_EQ(images[1].sweep->ranges_m[0], 1.25F);
  EXPECT_TRUE(std::isinf(images[1].sweep->ranges_m[1]));
  EXPECT_EQ(images[1].sweep->robot_from_scan.x_m, 0.3);
}

TEST_F(TourTest, AMapIsBuiltAskedAndEdited) {
  EXPECT_EQ(admin->post("/api/v1/maps", {{"name", "m"}, {"tours", {add_tour()}}}).status, 409) << "not complete";
  EXPECT_EQ(admin->post("/api/v1/maps", {{"name", "m"}, {"tours", {"none"}}}).status, 404);
  const std::string map = built_map(3);
  const std::string root = "/api/v1/maps/" + map;
  EXPECT_EQ(admin->get(root).json().at("state"), "ready");

  const Answer graph = admin->get(root + "/graph");
  ASSERT_EQ(graph.status, 200) << graph.body;
  EXPECT_EQ(graph.headers.at("etag"), "\"r1\"");
  EXPECT_EQ(admin->get(root + "/graph", {{"If-None-Match", "\"r1\""}}).status, 304);
  const json places = graph.json().at("places");
  ASSERT_GE(places.size(), 3U);
  ASSERT_EQ(graph.json().at("destinations").size(), 1U);
  EXPECT_EQ(graph.json().at("destinations")[0].at("label"), "home");
  const std::string first = places.front().at("id");
  const std::string last = places.back().at("id");
  EXPECT_EQ(admin->get(root + "/places/" + first + "/thumbnail").headers["content-type"], "image/jpeg");
  EXPECT_EQ(admin->get(root + "/places/p999/thumbnail").code(), "unknown_place");
  EXPECT_EQ(
      admin->get(root + "/images/" + places.front().at("members").back().get<std::string>() + "/thumbnail").status,
      200);

  const Answer belief = admin->send("POST", root + "/localise", room_picture(1, 77));
  ASSERT_EQ(belief.status, 200) << belief.body;
  EXPECT_FALSE(belief.json().at("lost").get<bool>());
  EXPECT_EQ(admin->send("POST", root + "/localise", "no picture").status, 415);

  EXPECT_EQ(admin->get(root + "/route?from=" + first + "&to=" + last).json().at("places").back(), last);
  EXPECT_EQ(admin->get(root + "/route?from=" + first + "&to=p999").code(), "unknown_place");

  const json rename = {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "porch"}}}}};
  EXPECT_EQ(admin->post(root + "/edits", rename).status, 428);
  EXPECT_EQ(admin->post(root + "/edits", rename, {{"If-Match", "\"r7\""}}).code(), "stale_revision");
  EXPECT_EQ(admin->post(root + "/edits", rename, {{"If-Match", "\"r1\""}}).json().at("revision"), 2);
  EXPECT_EQ(admin->get(root + "/history").json().at("edits")[0].at("by"), "anna");

  json block = {{"edits", json::array()}};
  const json edges = graph.json().at("edges");
  for (const json& edge : edges) {
    if (edge.at("to") == last) {
      block["edits"].push_back({{"kind", "block_edge"}, {"from", edge.at("from")}, {"to", last}, {"blocked", true}});
    }
  }
  const Answer blocked = admin->post(root + "/edits", block, {{"If-Match", "\"r2\""}});
  ASSERT_EQ(blocked.status, 200) << blocked.body;
  const Answer no_way = admin->get(root + "/route?from=" + first + "&to=" + last);
  EXPECT_EQ(no_way.status, 409);
  EXPECT_EQ(no_way.code(), "no_route");
  step_through_the_change(root, blocked, first, last);

  restart();
  EXPECT_EQ(admin->get(root + "/graph").json().at("places").front().at("label"), "porch");
  const Answer file = admin->get(root + "/export");
  EXPECT_EQ(file.headers.at("content-type"), "application/vnd.sqlite3");
  const Answer imported = admin->send("POST", "/api/v1/maps/import?name=copy", file.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  EXPECT_EQ(imported.json().at("map").at("places"), places.size());
  EXPECT_EQ(admin->send("POST", "/api/v1/maps/import", "no map").status, 422);
  EXPECT_EQ(admin->send("DELETE", root).status, 204);
  EXPECT_EQ(admin->get(root).status, 404);
}

TEST_F(TourTest, AMapWhoseFileIsGoneIsToldAndBuiltAgain) {
  const std::string map = built_map(2);
  app.reset();
  std::filesystem::remove(config.data / "maps" / (map + ".r1.homeward"));
  start();
  EXPECT_EQ(admin->get("/readyz").status, 503);
  EXPECT_EQ(admin->get("/api/v1/maps/" + map + "/graph").status, 404);
  const testing::Answer begun = admin->post("/api/v1/maps/" + map + "/builds");
  ASSERT_EQ(begun.status, 202) << begun.body;
  const nlohmann::json job = wait_for_job(begun.json().at("job").at("id"));
  EXPECT_EQ(job.at("state"), "done") << job.dump();
  EXPECT_EQ(admin->get("/api/v1/maps/" + map + "/graph").status, 200);
  EXPECT_EQ(admin->get("/readyz").status, 200);
}

TEST_F(TourTest, ABuildDoesWithoutPicturesThatWereDamagedAndSaysSo) {
  const std::string tour = complete_tour(3);
  const auto damage = [&](int number) {
    const auto file = config.data / "tours" / tour / (std::to_string(number) + ".jpg");
    ASSERT_TRUE(std::filesystem::exists(file));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  };
  damage(1);
  damage(8);  // "home"
  const json begun = admin->post("/api/v1/maps", {{"name", "damaged"}, {"tours", {tour}}}).json();
  EXPECT_EQ(begun.at("job").at("skipped"), 0);
  const json done = wait_for_job(begun.at("job").at("id"));
  ASSERT_EQ(done.at("state"), "done") << done.dump();
  EXPECT_EQ(done.at("skipped"), 2);
  ASSERT_EQ(done.at("notes").size(), 1U);
  EXPECT_EQ(done.at("notes")[0].at("code"), "pictures_left_out_of") << done.dump();
  EXPECT_EQ(done.at("notes")[0].at("parameters").at("left_out"), 2);
  EXPECT_EQ(done.at("notes")[0].at("parameters").at("all"), 9);
  const std::string map = "/api/v1/maps/" + begun.at("map").at("id").get<std::string>();
  EXPECT_EQ(admin->get(map).json().at("images"), 7);
  EXPECT_TRUE(admin->get(map + "/graph").json().at("destinations").empty());
  restart();
  EXPECT_EQ(admin->get("/api/v1/jobs/" + done.at("id").get<std::string>()).json(), done);
  for (int number = 0; number < 9; ++number) {
    if (number != 1 && number != 8) damage(number);
  }
  const json again = admin->post(map + "/builds").json();
  const json failed = wait_for_job(again.at("job").at("id"));
  EXPECT_EQ(failed.at("state"), "failed");
  EXPECT_NE(failed.at("error").at("detail").get<std::string>().find("None of the 9 pictures"), std::string::npos);
  EXPECT_EQ(admin->get(map).json().at("images"), 7) << "the map of before is still there";
}

TEST_F(TourTest, ABuildIsCancelledOrOutlivesARestart) {
  const std::string tour = complete_tour(6);
  const json first = admin->post("/api/v1/maps", {{"name", "a"}, {"tours", {tour}}}).json();
  const json second = admin->post("/api/v1/maps", {{"name", "b"}, {"tours", {tour}}}).json();
  const std::string second_job = second.at("job").at("id");
  EXPECT_EQ(admin->post("/api/v1/jobs/" + second_job + "/cancel").status, 202);
  EXPECT_EQ(wait_for_job(second_job).at("state"), "cancelled");
  EXPECT_EQ(admin->get("/api/v1/maps/" + second.at("map").at("id").get<std::string>()).json().at("state"), "failed");
  restart();
  const json ended = wait_for_job(first.at("job").at("id"));
  EXPECT_EQ(ended.at("state"), "done") << ended.dump();
  EXPECT_EQ(admin->post("/api/v1/jobs/" + first.at("job").at("id").get<std::string>() + "/cancel").status, 409);
  EXPECT_EQ(admin->get("/api/v1/jobs/none").status, 404);
}

}  // namespace
}  // namespace homeward::server::tour_test
