// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "db/store.hpp"
#include "map/lookup.hpp"
#include "pipeline/eye.hpp"
#include "support/driving_fixture.hpp"
#include "wire/appearance_blob.hpp"

// Several maps are built in these, which takes minutes there; the threads that meet are those of the other tests.
#if defined(__SANITIZE_THREAD__)
#define HOMEWARD_NOT_UNDER_THREAD_SANITIZER() GTEST_SKIP() << "takes minutes under the thread sanitizer"
#else
#define HOMEWARD_NOT_UNDER_THREAD_SANITIZER() static_cast<void>(0)
#endif

namespace homeward::server::learning_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::Answer;
using testing::FakeAgent;
using testing::room_picture;

class LearningTest : public testing::DrivingTest {
 protected:
  static std::string at(const std::string& id) { return "/api/v1/maps/" + id; }
  Answer learn(const std::string& of_map, const std::string& kind, const std::vector<std::string>& tours) {
    return admin->post(at(of_map) + "/builds", {{"kind", kind}, {"tours", tours}});
  }
  json ended(const Answer& begun) {
    EXPECT_EQ(begun.status, 202) << begun.body;
    return begun.status == 202 ? wait_for_job(begun.json().at("job").at("id")) : json::object();
  }
  json graph(const std::string& of_map) { return admin->get(at(of_map) + "/graph").json(); }
  /// The newest job that learns from drives, as dashboards are told when all jobs rest.
  json drive_job() {
    app->work_off();
    testing::SocketClient page;
    EXPECT_EQ(
        page.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults.at("Origin")}}),
        101);
    const auto snapshot = page.receive();
    if (!snapshot) return json();
    json newest;
    const json state = json::parse(*snapshot);
    for (const json& job : state.at("jobs")) {
      if (job.at("kind") == "refine") newest = job;
    }
    return newest;
  }
  /// What the store has while the server is down; then the server starts again.
  template <class Body>
  void with_store(const Body& body) {
    app.reset();
    {
      const auto store = db::open_sqlite_store(config.data);
      ASSERT_TRUE(store) << store.error().message;
      body(**store);
    }
    start();
  }
  /// A room from a little further on than the map knows it, most of it by another light.
  static Image by_night() {
    const auto bytes_of = [](const std::string& text) { return std::vector<std::uint8_t>(text.begin(), text.end()); };
    const Image day = *imageio::decode(bytes_of(room_picture(1, 3)), "day");
    Image picture = *imageio::decode(bytes_of(room_picture(40, 3)), "night");
    constexpr int kKnownColumns = 15 * testing::kRoomWidth_px / 32;
    constexpr int kHorizon = testing::kRoomHeight_px / 2;
    constexpr double kFurther_rad = 0.14;  // of walls all around
    for (int v = 0; v < picture.height_px; ++v) {
      for (int u = 0; u < kKnownColumns; ++u) {
        const double azimuth = 2.0 * std::numbers::pi * u / picture.width_px;
        const double across = picture.width_px / (2.0 * std::numbers::pi) * kFurther_rad * std::sin(azimuth);
        const double nearer = 1.0 - kFurther_rad * std::cos(azimuth);
        const int from_u = (u + static_cast<int>(std::lround(across)) + picture.width_px) % picture.width_px;
        const int from_v =
            std::clamp(kHorizon + static_cast<int>(std::lround((v - kHorizon) * nearer)), 0, picture.height_px - 1);
        for (int c = 0; c < 3; ++c) picture.at(u, v)[c] = day.at(from_u, from_v)[c];
      }
    }
    return picture;
  }
  /// A drive that saw the first place by night, as it is kept.
  db::Drive night_drive(db::Store& store, const std::string& mission) {
    const auto stored = store.load_map_contents(MapId(map));
    const auto eye = pipeline::Eye::create(testing::small_panorama_camera(), stored->map.feature_config);
    const auto seen = wire::encode_appearance(*eye->look(by_night()));
    const PlaceId first = map::find_place_of(stored->map, stored->map.images.front().id)->id;
    db::Drive drive{MissionId(mission), MapId(map), stored->map.feature_config_id, 1, {}};
    for (int i = 0; i < 5; ++i) drive.sights.push_back({first, seen});
    return drive;
  }
  void saw_by_night(const std::string& mission) {
    with_store([&](db::Store& store) { ASSERT_TRUE(store.add_drive(night_drive(store, mission))); });
  }
  std::size_t kept_drives() {
    std::size_t kept = 0;
    with_store([&](db::Store& store) { kept = store.drives(MapId(map))->size(); });
    return kept;
  }
  /// A mission during which the robot goes on seeing the first room; it ends as `state`.
  void drive(FakeAgent& agent, wire::DriveState state) {
    const Answer begun = send_home(take_lease(*admin));
    ASSERT_LT(begun.status, 300) << begun.body;
    const auto order = agent.await<wire::MissionOrder>();
    ASSERT_TRUE(order);
    agent.status(wire::DriveState::kDriving, order);
    for (int i = 0; i < 4; ++i) {
      const std::string picture = room_picture(1, static_cast<unsigned>(++agent.frame_seq) + 1000U);
      agent.say(wire::Frame{agent.frame_seq, agent.frame_seq * 2'000'000, {picture.begin(), picture.end()}});
      ASSERT_TRUE(agent.await<wire::BeliefReport>(milliseconds(60'000)));
    }
    agent.status(state, order);
    if (state == wire::DriveState::kFailed) {  // the only way there is is tried once more
      const auto again = agent.await<wire::MissionOrder>();
      ASSERT_TRUE(again);
      agent.status(wire::DriveState::kDriving, again);
      agent.status(state, again);
    }
    const std::string ended = state == wire::DriveState::kArrived ? "arrived" : "failed";
    EXPECT_EQ(wait_for_state(begun.json(), ended).at("state"), ended);
  }
};

TEST_F(LearningTest, AToursPicturesJoinAMap) {
  HOMEWARD_NOT_UNDER_THREAD_SANITIZER();
  map = built_map(3);
  const std::string first = graph(map).at("places")[0].at("id");
  const json rename = {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "porch"}}}}};
  ASSERT_EQ(admin->post(at(map) + "/edits", rename, {{"If-Match", "\"r1\""}}).status, 200);
  const json before = graph(map);
  const std::string tour = complete_tour(5);
  const json done = ended(learn(map, "add", {tour}));
  ASSERT_EQ(done.at("state"), "done") << done.dump();
  EXPECT_EQ(done.at("kind"), "add");
  EXPECT_EQ(done.at("notes")[0].at("code"), "tours_added");
  EXPECT_EQ(done.at("notes")[0].at("parameters").at("images"), 15) << done.dump();
  const json info = admin->get(at(map)).json();
  EXPECT_EQ(info.at("revision"), 3);
  EXPECT_EQ(info.at("images"), 24);
  ASSERT_EQ(info.at("tours").size(), 2U);
  EXPECT_EQ(info.at("tours")[1], tour);
  const json after = graph(map);
  ASSERT_GT(after.at("places").size(), before.at("places").size());
  for (std::size_t i = 0; i < before.at("places").size(); ++i) {
    EXPECT_EQ(after.at("places")[i].at("id"), before.at("places")[i].at("id"));
    EXPECT_EQ(after.at("places")[i].at("label"), before.at("places")[i].at("label"));
  }
  const std::string newest = after.at("places").back().at("id");
  EXPECT_EQ(admin->get(at(map) + "/places/" + newest + "/thumbnail").status, 200);
  EXPECT_EQ(admin->get(at(map) + "/history").json().at("edits").size(), 1U);

  EXPECT_EQ(learn(map, "add", {tour}).status, 409) << "it is in the map already";
  EXPECT_EQ(admin->send("DELETE", "/api/v1/tours/" + tour).status, 409) << "tours of a map stay";
  const json rebuilt = ended(admin->post(at(map) + "/builds"));
  EXPECT_EQ(rebuilt.at("state"), "done") << rebuilt.dump();
  EXPECT_EQ(admin->get(at(map)).json().at("images"), 24);
}

TEST_F(LearningTest, AMapThatIsEditedWhileItLearnsKeepsTheEditAndLearnsOnceMore) {
  HOMEWARD_NOT_UNDER_THREAD_SANITIZER();
  map = built_map(3);
  const std::string first = graph(map).at("places")[0].at("id");
  const std::string tour = complete_tour(6);
  const std::string job = learn(map, "add", {tour}).json().at("job").at("id");
  // Under way: the job has the map as it was in its hands.
  bool under_way = false;
  for (int i = 0; i < 2000 && !under_way; ++i) {
    const json state = admin->get("/api/v1/jobs/" + job).json();
    under_way = state.at("state") == "running" && state.at("progress").is_object() &&
                state.at("progress").at("share").get<double>() > 0.02;
    if (!under_way) std::this_thread::sleep_for(milliseconds(5));
  }
  ASSERT_TRUE(under_way);
  // Taken on the revision of before, so the job cannot have kept anything yet: what it is about to keep is stale.
  const json rename = {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "porch"}}}}};
  ASSERT_EQ(admin->post(at(map) + "/edits", rename, {{"If-Match", "\"r1\""}}).status, 200);
  const json done = wait_for_job(job);
  EXPECT_EQ(done.at("state"), "done") << done.dump();
  const json info = admin->get(at(map)).json();
  EXPECT_EQ(info.at("revision"), 3);
  EXPECT_EQ(info.at("images"), 27);
  EXPECT_EQ(info.at("tours").size(), 2U);
  EXPECT_EQ(graph(map).at("places")[0].at("label"), "porch");
  EXPECT_EQ(admin->get(at(map) + "/history").json().at("edits").size(), 1U);
}

TEST_F(LearningTest, WhatCannotBeLearntFromIsSaid) {
  map = taught_map();
  const std::string open_tour = add_tour();
  EXPECT_EQ(learn("none", "add", {open_tour}).status, 404);
  EXPECT_EQ(learn(map, "add", {"none"}).status, 404);
  EXPECT_EQ(learn(map, "add", {open_tour}).status, 409) << "not complete";
  EXPECT_EQ(learn(map, "add", {}).status, 422);
  EXPECT_EQ(learn(map, "refine", {}).status, 422);
  EXPECT_EQ(learn(map, "build", {open_tour}).status, 422);
  EXPECT_EQ(learn(map, "guess", {open_tour}).status, 422);
  auto viewer = signed_in("vera", "viewer");
  EXPECT_EQ(viewer.post(at(map) + "/builds", {{"kind", "add"}, {"tours", {open_tour}}}).status, 403);
  EXPECT_EQ(viewer.put(at(map) + "/refine", {{"refine", "auto"}}).status, 403);
  EXPECT_EQ(admin->put(at("none") + "/refine", {{"refine", "auto"}}).status, 404);
  EXPECT_EQ(admin->put(at(map) + "/refine", {{"refine", "always"}}).status, 422);
  EXPECT_EQ(admin->post("/api/v1/jobs/none/take").status, 404);

  // A map of another program's features.
  const auto file = config.data / "other.hwmap";
  std::ofstream(file, std::ios::binary) << admin->get(at(map) + "/export").body;
  auto stored = db::load_map(file);
  ASSERT_TRUE(stored);
  stored->map.feature_config_id = "hw1-w1024";
  ASSERT_TRUE(db::save_map(file, stored->map, stored->thumbnails));
  std::stringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  const Answer imported = admin->send("POST", "/api/v1/maps/import", bytes.str());
  ASSERT_EQ(imported.status, 201) << imported.body;
  const std::string other = imported.json().at("map").at("id");
  const std::string tour = complete_tour(2);
  for (const char* kind : {"add", "refine"}) {
    const json failed = ended(learn(other, kind, {tour}));
    EXPECT_EQ(failed.at("state"), "failed");
    EXPECT_EQ(failed.at("error").at("code"), "feature_config_mismatch") << failed.dump();
  }
  EXPECT_EQ(admin->get(at(other)).json().at("revision"), 1);
  EXPECT_TRUE(admin->get(at(other)).json().at("tours").empty());
  EXPECT_EQ(admin->post(at(other) + "/builds").status, 409) << "its pictures are not here";
}

TEST_F(LearningTest, AnAdditionIsCancelledOrOutlivesARestart) {
  map = built_map(3);
  const std::string tour = complete_tour(4);
  const std::string job = learn(map, "add", {tour}).json().at("job").at("id");
  EXPECT_EQ(learn(map, "add", {tour}).status, 409) << "one job of a map at a time";
  EXPECT_EQ(admin->post("/api/v1/jobs/" + job + "/cancel").status, 202);
  EXPECT_EQ(wait_for_job(job).at("state"), "cancelled");
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 1);
  EXPECT_EQ(admin->get(at(map)).json().at("state"), "ready");
  EXPECT_EQ(admin->get(at(map)).json().at("tours").size(), 1U);

  const std::string again = learn(map, "add", {tour}).json().at("job").at("id");
  restart();
  EXPECT_EQ(wait_for_job(again).at("state"), "done");
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 2);
  EXPECT_EQ(admin->get(at(map)).json().at("tours").size(), 2U);
}

TEST_F(LearningTest, AnImportedMapGainsToursButIsNotBuiltAnew) {
  HOMEWARD_NOT_UNDER_THREAD_SANITIZER();
  map = built_map(3);
  const Answer imported = admin->send("POST", "/api/v1/maps/import", admin->get(at(map) + "/export").body);
  const std::string copy = imported.json().at("map").at("id");
  const json refined = ended(learn(copy, "refine", {complete_tour(3)}));
  EXPECT_EQ(refined.at("state"), "done") << refined.dump();
  EXPECT_EQ(refined.at("gained"), 0) << "the same light says nothing new";
  EXPECT_EQ(admin->get(at(copy)).json().at("revision"), 1);
  EXPECT_EQ(ended(learn(copy, "add", {complete_tour(4)})).at("state"), "done");
  EXPECT_EQ(admin->get(at(copy)).json().at("tours").size(), 1U);
  EXPECT_EQ(admin->post(at(copy) + "/builds").status, 409) << "that would forget what was imported";
}

TEST_F(LearningTest, MissionsThatArrivedAreLookedThrough) {
  add_robot();
  put_on_map();
  std::optional<FakeAgent> agent;
  const auto connect = [&] {
    agent.emplace();
    EXPECT_EQ(agent->connect(app->port(), robot, token), 101);
    find_itself(*agent);
  };
  connect();
  const auto drive_jobs = [&] {
    std::vector<wire::JobView> found;
    agent.reset();
    with_store([&](db::Store& store) {
      const auto all = store.jobs();
      for (const wire::JobView& job : *all) {
        if (job.kind == wire::JobKind::kRefine) found.push_back(job);
      }
    });
    connect();
    return found;
  };
  EXPECT_EQ(admin->get(at(map)).json().at("refine"), "ask");
  drive(*agent, wire::DriveState::kFailed);
  EXPECT_TRUE(drive_jobs().empty()) << "a mission that failed teaches nothing";
  ASSERT_EQ(admin->put(at(map) + "/refine", {{"refine", "off"}}).status, 200);
  drive(*agent, wire::DriveState::kArrived);
  EXPECT_TRUE(drive_jobs().empty()) << "not wanted";
  ASSERT_EQ(admin->put(at(map) + "/refine", {{"refine", "ask"}}).status, 200);
  drive(*agent, wire::DriveState::kArrived);
  const auto jobs = drive_jobs();
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_EQ(jobs[0].map.str(), map);
  EXPECT_EQ(jobs[0].gained, 0) << "the same light says nothing new";
  app->work_off();
  EXPECT_EQ(admin->get("/api/v1/jobs/" + jobs[0].id.str()).json().at("state"), "done");
  EXPECT_EQ(kept_drives(), 0U);
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 1);
}

TEST_F(LearningTest, ADriveOffersWhatItSawAndAPersonTakesIt) {
  map = taught_map();
  const std::string first = graph(map).at("places")[0].at("id");
  saw_by_night("m1");
  const json offer = drive_job();
  ASSERT_FALSE(offer.is_null());
  ASSERT_EQ(offer.at("state"), "offered") << offer.dump();
  EXPECT_GE(offer.at("gained"), 1);
  EXPECT_EQ(offer.at("notes")[0].at("code"), "place_would_gain") << offer.dump();
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 1) << "nothing changes unasked";

  // A person edits meanwhile, and the server restarts; the offer stays and the edit too.
  const json rename = {{"edits", {{{"kind", "rename"}, {"place", first}, {"label", "porch"}}}}};
  ASSERT_EQ(admin->post(at(map) + "/edits", rename, {{"If-Match", "\"r1\""}}).status, 200);
  const json before = graph(map);
  restart();
  const std::string job = "/api/v1/jobs/" + offer.at("id").get<std::string>();
  EXPECT_EQ(admin->get(job).json().at("state"), "offered");
  auto viewer = signed_in("vera", "viewer");
  EXPECT_EQ(viewer.post(job + "/take").status, 403);
  ASSERT_EQ(admin->post(job + "/take").status, 202);
  const json done = wait_for_job(offer.at("id"));
  ASSERT_EQ(done.at("state"), "done") << done.dump();
  EXPECT_EQ(done.at("gained"), offer.at("gained"));
  EXPECT_EQ(done.at("notes")[0].at("code"), "place_gained") << done.dump();
  EXPECT_EQ(done.at("notes")[0].at("parameters").at("place").at("parameters").at("label"), "porch");
  EXPECT_EQ(admin->post(job + "/take").status, 409) << "once";
  json after = graph(map);
  EXPECT_EQ(after.at("revision"), 3);
  after["revision"] = before.at("revision");
  EXPECT_FALSE(before.at("places")[0].contains("learnt"));
  EXPECT_EQ(after.at("places")[0].at("learnt").size(), done.at("gained").get<std::size_t>());
  after["places"][0].erase("learnt");
  EXPECT_EQ(after, before) << "appearances alone";
  EXPECT_EQ(admin->get(at(map) + "/history").json().at("edits").size(), 1U);
  with_store([&](db::Store& store) {
    const auto stored = store.load_map_contents(MapId(map));
    const auto* place = map::find_place(stored->map, PlaceId(first));
    EXPECT_EQ(place->appearances.size(), 1U + done.at("gained").get<std::size_t>());
    EXPECT_TRUE(store.drives(MapId(map))->empty()) << "what was used is offered no more";
  });
  EXPECT_EQ(drive_job().at("state"), "done");
}

TEST_F(LearningTest, OneOfferForAMapIsDiscardedWithAllItCameFrom) {
  map = taught_map();
  saw_by_night("m1");
  const json offer = drive_job();
  ASSERT_EQ(offer.at("state"), "offered") << offer.dump();
  saw_by_night("m2");
  const json both = drive_job();
  EXPECT_EQ(both.at("id"), offer.at("id"));
  EXPECT_EQ(both.at("state"), "offered");
  const std::string job = "/api/v1/jobs/" + offer.at("id").get<std::string>();
  EXPECT_EQ(admin->post(job + "/cancel").status, 202);
  EXPECT_EQ(admin->get(job).json().at("state"), "cancelled");
  EXPECT_EQ(admin->post(job + "/take").status, 409);
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 1);
  EXPECT_EQ(kept_drives(), 0U);
}

TEST_F(LearningTest, AMapIsSetToLearnAtOnceOrNotAtAll) {
  map = taught_map();
  saw_by_night("m1");
  ASSERT_EQ(drive_job().at("state"), "offered");
  ASSERT_EQ(admin->put(at(map) + "/refine", {{"refine", "off"}}).json().at("refine"), "off");
  EXPECT_EQ(drive_job().at("state"), "cancelled") << "what waits is withdrawn";
  EXPECT_EQ(kept_drives(), 0U);
  ASSERT_EQ(admin->put(at(map) + "/refine", {{"refine", "auto"}}).status, 200);
  saw_by_night("m2");
  const json done = drive_job();
  EXPECT_EQ(done.at("state"), "done") << done.dump();
  EXPECT_GE(done.at("gained"), 1);
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 2);
  saw_by_night("m3");
  app->work_off();
  EXPECT_EQ(kept_drives(), 0U) << "it was looked through";
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 2) << "the same once more says nothing";
}

TEST_F(LearningTest, DrivesThatDoNotFitTheMapAnyMoreChangeNothing) {
  map = taught_map();
  with_store([&](db::Store& store) {
    db::Drive elsewhere = night_drive(store, "m1");
    for (db::DriveSight& sight : elsewhere.sights) sight.place = PlaceId("p999");
    ASSERT_TRUE(store.add_drive(elsewhere));
  });
  app->work_off();
  EXPECT_EQ(kept_drives(), 0U) << "places that are gone teach nothing";
  with_store([&](db::Store& store) {
    db::Drive older = night_drive(store, "m2");
    older.feature_config_id = "hw1-w1024";
    ASSERT_TRUE(store.add_drive(older));
  });
  const json failed = drive_job();
  EXPECT_EQ(failed.at("state"), "failed");
  EXPECT_EQ(failed.at("error").at("code"), "feature_config_mismatch") << failed.dump();
  EXPECT_EQ(admin->get(at(map)).json().at("revision"), 1);
  EXPECT_EQ(kept_drives(), 0U);
}

}  // namespace
}  // namespace homeward::server::learning_test
