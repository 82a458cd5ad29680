// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <thread>

#include "db/store.hpp"
#include "support/server_fixture.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::server::draft_test {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::HttpClient;

class DraftTest : public testing::ServerTest {
 protected:
  void teach(int rooms) {
    map_ = built_map(rooms);
    root_ = "/api/v1/maps/" + map_;
  }
  json graph(const std::string& of = "") { return admin->get(root_ + of + "/graph").json(); }
  std::string place(std::size_t index) { return graph().at("places").at(index).at("id"); }
  json begin(const std::string& name = "") {
    const Answer begun = admin->post(root_ + "/drafts", {{"name", name}});
    EXPECT_EQ(begun.status, 201) << begun.body;
    return begun.json();
  }
  Answer change(HttpClient& who, const json& draft, const std::string& what, const json& body = json::object()) {
    return who.post(path_of(draft) + what, body, {{"If-Match", tag_of(draft)}});
  }
  Answer change(const json& draft, const std::string& what, const json& body = json::object()) {
    return change(*admin, draft, what, body);
  }
  json edited(const json& draft, const json& edit) {
    const Answer answer = change(draft, "/edits", {{"edits", {edit}}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json();
  }
  json rename(std::size_t index, const std::string& label) {
    return {{"kind", "rename"}, {"place", place(index)}, {"label", label}};
  }
  [[nodiscard]] std::string path_of(const json& draft) const {
    return root_ + "/drafts/" + draft.at("id").get<std::string>();
  }
  static std::string tag_of(const json& draft) {
    return "\"d" + std::to_string(draft.at("version").get<std::int64_t>()) + "\"";
  }
  std::string relative(const json& draft) const { return "/drafts/" + draft.at("id").get<std::string>(); }

  std::string map_;
  std::string root_;
};

TEST_F(DraftTest, CountsForNobodyUntilItIsPublishedAndOutlivesARestart) {
  teach(4);
  const json before = graph();
  json draft = begin("names");
  EXPECT_EQ(draft.at("by"), "anna");
  EXPECT_EQ(draft.at("revision"), before.at("revision"));
  draft = edited(draft, rename(0, "porch"));
  draft = edited(draft, {{"kind", "merge"}, {"place", place(2)}, {"into", place(1)}});
  EXPECT_EQ(draft.at("version"), 3);
  EXPECT_EQ(draft.at("changes"), 2);
  EXPECT_EQ(graph(), before);
  restart();
  EXPECT_EQ(admin->get(path_of(draft)).json(), draft);
  const json drafted = graph(relative(draft));
  EXPECT_EQ(drafted.at("places").size(), before.at("places").size() - 1);
  EXPECT_EQ(drafted.at("places").at(0).at("label"), "porch");
  EXPECT_EQ(drafted.at("revision"), before.at("revision"));
  const json difference = admin->get(path_of(draft) + "/difference").json();
  EXPECT_GE(difference.at("places").size(), 3U);
  clock.pass(std::chrono::seconds(60));
  const Answer published = change(draft, "/publish");
  ASSERT_EQ(published.status, 200) << published.body;
  const std::int64_t drafted_us = draft.at("edits").back().at("t_us");
  for (const json history = admin->get(root_ + "/history").json(); const json& edit : history.at("edits")) {
    EXPECT_GE(edit.at("t_us").get<std::int64_t>(), drafted_us + 60'000'000) << "it counts from then on";
  }
  json now = graph();
  EXPECT_EQ(now.at("revision"), published.json().at("revision"));
  EXPECT_EQ(now.at("places").size(), drafted.at("places").size());
  EXPECT_EQ(now.at("edges"), drafted.at("edges"));
  EXPECT_EQ(admin->get(path_of(draft)).status, 404);
  // It is one change: one step takes it back.
  const Answer undone =
      admin->post(root_ + "/undo", json::object(), {{"If-Match", admin->get(root_ + "/graph").headers.at("etag")}});
  ASSERT_EQ(undone.status, 200);
  now = graph();
  now["revision"] = before.at("revision");
  EXPECT_EQ(now, before);
}

TEST_F(DraftTest, ChangesAreTakenBackAndMadeAgain) {
  teach(3);
  const json before = graph();
  json draft = begin();
  EXPECT_EQ(change(draft, "/undo").status, 404);
  draft = edited(draft, rename(0, "porch"));
  draft = edited(draft, rename(1, "hall"));
  const json both = graph(relative(draft));
  for (int i = 0; i < 2; ++i) draft = change(draft, "/undo").json();
  EXPECT_EQ(draft.at("changes"), 0);
  EXPECT_TRUE(draft.at("touches").empty());
  EXPECT_EQ(graph(relative(draft)), before);
  EXPECT_EQ(change(draft, "/publish").status, 409) << "it changes nothing";
  for (int i = 0; i < 2; ++i) draft = change(draft, "/redo").json();
  EXPECT_EQ(graph(relative(draft)), both);
  EXPECT_EQ(change(draft, "/redo").status, 404);
}

TEST_F(DraftTest, IsChangedOnlyByWhoHasSeenItsLatestVersion) {
  teach(3);
  const json draft = begin();
  const json body = {{"edits", {rename(0, "porch")}}};
  EXPECT_EQ(admin->post(path_of(draft) + "/edits", body).status, 428);
  EXPECT_EQ(admin->post(path_of(draft) + "/edits", body, {{"If-Match", "\"r1\""}}).status, 422);
  ASSERT_EQ(change(draft, "/edits", body).status, 200);
  const Answer late = change(draft, "/edits", body);
  EXPECT_EQ(late.status, 412);
  EXPECT_EQ(late.code(), "stale_revision");
  EXPECT_EQ(change(draft, "/publish").status, 412);
  const Answer refused =
      admin->post(path_of(draft) + "/edits", {{"edits", {{{"kind", "paint"}}}}}, {{"If-Match", "\"d2\""}});
  EXPECT_EQ(refused.status, 422) << refused.body;
}

TEST_F(DraftTest, OfTwoPeopleThatTouchTheSamePlacesAreShownToEachOther) {
  teach(5);
  HttpClient ben = signed_in("ben", "installer");
  json annas = begin("annas");
  annas = edited(annas, rename(0, "porch"));
  EXPECT_TRUE(annas.at("overlaps").empty());
  const json bens = ben.post(root_ + "/drafts", {{"name", "bens"}}).json();
  const Answer changed = change(ben, bens, "/edits", {{"edits", {rename(4, "study"), rename(0, "door")}}});
  ASSERT_EQ(changed.status, 200) << changed.body;
  const json overlap = changed.json().at("overlaps");
  ASSERT_EQ(overlap.size(), 1U);
  EXPECT_EQ(overlap.at(0).at("by"), "anna");
  EXPECT_EQ(overlap.at(0).at("places"), json::array({place(0)}));
  EXPECT_EQ(admin->get(path_of(annas)).json().at("overlaps").at(0).at("by"), "ben");
  EXPECT_EQ(admin->get(root_ + "/drafts").json().at("drafts").size(), 2U);
  // What is published under a draft stays in it where it still holds.
  ASSERT_EQ(change(ben, changed.json(), "/publish").status, 200);
  annas = admin->get(path_of(annas)).json();
  EXPECT_TRUE(annas.at("overlaps").empty());
  EXPECT_EQ(annas.at("revision"), graph().at("revision"));
  EXPECT_EQ(graph(relative(annas)).at("places").at(0).at("label"), "porch");
  EXPECT_EQ(graph(relative(annas)).at("places").at(4).at("label"), "study");
}

TEST_F(DraftTest, SaysWhatTheMapDoesNotTakeAnyMore) {
  teach(4);
  json draft = begin();
  draft = edited(draft, {{"kind", "merge"}, {"place", place(2)}, {"into", place(1)}});
  draft = edited(draft, rename(0, "porch"));
  const Answer gone = admin->post(root_ + "/edits", {{"edits", {{{"kind", "delete"}, {"place", place(2)}}}}},
                                  {{"If-Match", admin->get(root_ + "/graph").headers.at("etag")}});
  ASSERT_EQ(gone.status, 200) << gone.body;
  draft = admin->get(path_of(draft)).json();
  EXPECT_FALSE(draft.at("edits").at(0).at("lost").is_null());
  EXPECT_TRUE(draft.at("edits").at(1).at("lost").is_null());
  const Answer refused = change(draft, "/publish");
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_EQ(change(draft, "/publish", {{"leave_out_lost", true}}).status, 200);
  EXPECT_EQ(graph().at("places").at(0).at("label"), "porch");
}

TEST_F(DraftTest, IsTriedOnTheToursOfItsMap) {
  teach(4);
  json draft = begin();
  EXPECT_EQ(admin->get(path_of(draft) + "/check").status, 404);
  draft = edited(draft, {{"kind", "merge"}, {"place", place(3)}, {"into", place(0)}});
  const Answer asked = admin->post(path_of(draft) + "/check");
  ASSERT_EQ(asked.status, 202) << asked.body;
  const json job = asked.json().at("job");
  EXPECT_EQ(job.at("kind"), "check");
  EXPECT_EQ(wait_for_job(job.at("id")).at("state"), "done");
  const json found = admin->get(path_of(draft) + "/check").json();
  EXPECT_EQ(found.at("pictures"), 12);
  EXPECT_EQ(found.at("draft_version"), draft.at("version"));
  EXPECT_FALSE(found.at("harmless").get<bool>()) << found.dump();
  EXPECT_EQ(admin->get(path_of(draft)).json().at("check"),
            (json{{"job", job.at("id")}, {"version", draft.at("version")}}));
  restart();
  EXPECT_EQ(admin->get(path_of(draft) + "/check").json(), found);
}

TEST_F(DraftTest, IsPublishedWhileSomebodyElseEditsTheMap) {
  teach(3);
  HttpClient ben = signed_in("ben", "installer");
  std::atomic<bool> ended = false;
  std::atomic<int> edits = 0;
  const std::string first = place(0);
  std::jthread editor([&] {
    while (!ended) {
      const std::string tag = ben.get(root_ + "/graph").headers.at("etag");
      const json rename = {{"kind", "rename"}, {"place", first}, {"label", "hall " + std::to_string(edits)}};
      if (ben.post(root_ + "/edits", {{"edits", {rename}}}, {{"If-Match", tag}}).status == 200) ++edits;
    }
  });
  for (int i = 0; i < 10; ++i) {
    const json draft = edited(begin(), rename(2, "attic " + std::to_string(i)));
    const Answer published = change(draft, "/publish");
    EXPECT_EQ(published.status, 200) << published.body;
  }
  ended = true;
  editor.join();
  EXPECT_GT(edits, 10);
  EXPECT_EQ(graph().at("places").at(2).at("label"), "attic 9");
}

TEST_F(DraftTest, IsTriedOnWhatDrivesSawToo) {
  teach(4);
  app.reset();
  {
    const auto store = db::open_sqlite_store(config.data).value();
    const auto stored = store->load_map_contents(MapId(map_)).value();
    db::Drive drive{MissionId("m1"), MapId(map_), stored.map.feature_config_id, 1, {}};
    for (const map::Place& place : stored.map.places) {
      drive.sights.push_back({place.id, wire::encode_appearance(place.appearances.front())});
    }
    ASSERT_TRUE(store->add_drive(drive));
  }
  start();
  app->work_off();  // the map has learnt from it what it could
  const json draft = begin();
  const Answer asked = admin->post(path_of(draft) + "/check");
  ASSERT_EQ(asked.status, 202) << asked.body;
  EXPECT_EQ(wait_for_job(asked.json().at("job").at("id")).at("state"), "done");
  const json found = admin->get(path_of(draft) + "/check").json();
  EXPECT_EQ(found.at("sights"), graph().at("places").size());
  EXPECT_TRUE(found.at("harmless").get<bool>()) << found.dump();
}

TEST_F(DraftTest, IsDiscardedAndIsNoPartOfAnotherMap) {
  teach(3);
  const json draft = begin();
  EXPECT_EQ(admin->get("/api/v1/maps/other/drafts/" + draft.at("id").get<std::string>()).status, 404);
  EXPECT_EQ(admin->get("/api/v1/maps/other/drafts").status, 404);
  HttpClient viewer = signed_in("vera", "viewer");
  EXPECT_EQ(viewer.get(path_of(draft)).status, 200);
  EXPECT_EQ(viewer.send("DELETE", path_of(draft)).status, 403);
  EXPECT_EQ(admin->send("DELETE", path_of(draft)).status, 204);
  EXPECT_EQ(admin->send("DELETE", path_of(draft)).status, 404);
  for (const char* part : {"", "/graph", "/difference", "/check"}) {
    EXPECT_EQ(admin->get(path_of(draft) + part).status, 404) << part;
  }
}

TEST_F(DraftTest, IsToldToDashboardsWhenItChangesAndWhenItGoes) {
  teach(3);
  testing::SocketClient page;
  ASSERT_EQ(
      page.open(app->port(), "/api/v1/events", {{"Cookie", admin->cookie}, {"Origin", admin->defaults.at("Origin")}}),
      101);
  const auto told = [&](const std::string& type) {
    EXPECT_TRUE(page.take_in_all());
    json last;
    while (const auto message = page.receive(std::chrono::milliseconds(1))) {
      json event = json::parse(*message);
      if (event.at("type") == type) last = std::move(event);
    }
    return last;
  };
  json draft = begin();
  EXPECT_EQ(told("draft").at("draft"), draft);
  draft = edited(draft, rename(0, "porch"));
  EXPECT_EQ(told("draft").at("draft"), draft);
  EXPECT_EQ(admin->send("DELETE", path_of(draft)).status, 204);
  EXPECT_EQ(told("draft_gone").at("draft"), draft.at("id"));
}

}  // namespace
}  // namespace homeward::server::draft_test
