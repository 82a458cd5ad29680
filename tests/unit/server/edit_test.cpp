// SPDX-License-Identifier: Apache-2.0
#include "support/server_fixture.hpp"

namespace homeward::server::edit_test {
namespace {

using nlohmann::json;
using testing::Answer;

class EditTest : public testing::ServerTest {
 protected:
  void teach(int rooms) {
    map_ = built_map(rooms);
    root_ = "/api/v1/maps/" + map_;
  }
  json graph() { return admin->get(root_ + "/graph").json(); }
  /// What edits change, without where it is drawn and by which revision.
  json state() {
    json now = graph();
    for (json& place : now.at("places")) {
      place.erase("x");
      place.erase("y");
    }
    now.erase("revision");
    return now;
  }
  Answer change(const std::string& what, const json& body = json::object()) {
    const std::string tag = admin->get(root_ + "/graph").headers.at("etag");
    return admin->post(root_ + what, body, {{"If-Match", tag}});
  }
  Answer edit(const json& one) { return change("/edits", {{"edits", {one}}}); }
  std::string place(std::size_t index) { return graph().at("places").at(index).at("id"); }

  std::string map_;
  std::string root_;
};

TEST_F(EditTest, EveryKindIsAppliedAndAllOfThemAreTakenBackAndMadeAgain) {
  teach(5);
  const json first = state();
  const json places = first.at("places");
  ASSERT_GE(places.size(), 5U);
  const auto id = [&](std::size_t i) { return places.at(i).at("id").get<std::string>(); };
  const auto members = [&](std::size_t i) { return places.at(i).at("members"); };
  ASSERT_GE(members(0).size(), 2U);
  ASSERT_GE(members(1).size(), 2U);
  const json edge = first.at("edges").at(0);
  const json added = {{"kind", "add_destination"}, {"image", members(0).at(0)}, {"label", "hall"}};
  const Answer hall = edit(added);
  ASSERT_EQ(hall.status, 200) << hall.body;
  const std::string destination = graph().at("destinations").back().at("id");
  std::vector<json> edits = {
      {{"kind", "rename"}, {"place", id(0)}, {"label", "porch"}},
      {{"kind", "name_destination"}, {"destination", destination}, {"label", "big hall"}},
      {{"kind", "set_pictogram"}, {"destination", destination}, {"pictogram", "door"}},
      {{"kind", "set_destination_picture"}, {"destination", destination}, {"image", members(1).at(0)}},
      {{"kind", "block_edge"}, {"from", edge.at("from")}, {"to", edge.at("to")}, {"blocked", true}},
      {{"kind", "split"}, {"place", id(0)}, {"images", {members(0).at(1)}}},
      {{"kind", "move"}, {"images", {members(0).at(1)}}, {"into", id(1)}},
      {{"kind", "merge"}, {"place", id(3)}, {"into", id(2)}},
      {{"kind", "add_edge"}, {"from", id(0)}, {"to", id(4)}},
      {{"kind", "remove_edge"}, {"from", id(0)}, {"to", id(4)}},
      {{"kind", "delete"}, {"place", id(4)}},
      {{"kind", "remove_destination"}, {"destination", destination}},
  };
  // The image that was split off is alone in its place: moved away nothing would be left of that.
  edits[6] = {{"kind", "move"}, {"images", {members(1).at(1)}}, {"into", id(0)}};
  for (const json& one : edits) {
    const json before = state();
    const Answer made = edit(one);
    ASSERT_EQ(made.status, 200) << one.dump() << made.body;
    EXPECT_NE(state(), before) << one.dump();
  }
  const json last = state();
  EXPECT_EQ(last.at("places").at(0).at("label"), "porch");
  restart();
  EXPECT_EQ(state(), last);
  const json history = admin->get(root_ + "/history").json().at("edits");
  ASSERT_EQ(history.size(), edits.size() + 1);
  for (const json& logged : history) EXPECT_TRUE(logged.at("lost").is_null()) << logged.dump();
  std::size_t undone = 0;
  while (change("/undo").status == 200) ++undone;
  EXPECT_EQ(undone, history.size());
  EXPECT_EQ(state(), first);
  restart();
  while (change("/redo").status == 200) --undone;
  EXPECT_EQ(undone, 0U);
  EXPECT_EQ(state(), last);
}

TEST_F(EditTest, ARequestIsAppliedWholeOrNotAtAll) {
  teach(3);
  const json first = state();
  const std::string tag = admin->get(root_ + "/graph").headers.at("etag");
  const Answer refused = change("/edits", {{"edits",
                                            {{{"kind", "merge"}, {"place", place(0)}, {"into", place(1)}},
                                             {{"kind", "delete"}, {"place", place(2)}},
                                             {{"kind", "rename"}, {"place", "p999"}, {"label", "x"}}}}});
  EXPECT_EQ(refused.status, 404);
  EXPECT_EQ(refused.code(), "unknown_place");
  EXPECT_EQ(refused.json().at("where"), "body/edits/2");
  EXPECT_EQ(state(), first);
  EXPECT_EQ(admin->get(root_ + "/graph").headers.at("etag"), tag);
  EXPECT_EQ(admin->get(root_ + "/history").json().at("edits").size(), 0U);
}

TEST_F(EditTest, WhatCannotHoldIsRefusedWithThePicturesConcerned) {
  teach(3);
  const json places = graph().at("places");
  const std::string whole = places.at(0).at("id");
  const Answer emptied = edit({{"kind", "split"}, {"place", whole}, {"images", places.at(0).at("members")}});
  EXPECT_EQ(emptied.status, 422) << emptied.body;
  const std::string elsewhere = places.at(1).at("members").at(0);
  const Answer absent = edit({{"kind", "split"}, {"place", whole}, {"images", {elsewhere}}});
  EXPECT_EQ(absent.status, 404) << absent.body;
  EXPECT_NE(absent.json().at("detail").get<std::string>().find(elsewhere), std::string::npos) << absent.body;
  EXPECT_EQ(edit({{"kind", "remove_destination"}, {"destination", "d99"}}).status, 404);
  EXPECT_EQ(edit({{"kind", "merge"}, {"place", whole}, {"into", whole}}).status, 422);
  // A map from elsewhere has no pictures here: what is to be known by one of them would be known by nothing.
  const Answer file = admin->get(root_ + "/export");
  ASSERT_EQ(admin->send("DELETE", root_).status, 204);
  const json tours = admin->get("/api/v1/tours").json().at("tours");
  for (const json& tour : tours) {
    ASSERT_EQ(admin->send("DELETE", "/api/v1/tours/" + tour.at("id").get<std::string>()).status, 204);
  }
  const Answer imported = admin->send("POST", "/api/v1/maps/import?name=copy", file.body);
  ASSERT_EQ(imported.status, 201) << imported.body;
  root_ = "/api/v1/maps/" + imported.json().at("map").at("id").get<std::string>();
  std::string leaving;
  for (const json& image : places.at(0).at("members")) {
    if (image != places.at(0).at("prototype")) leaving = image;
  }
  const Answer unseen = edit({{"kind", "split"}, {"place", whole}, {"images", {leaving}}});
  EXPECT_EQ(unseen.status, 409) << unseen.body;
  EXPECT_NE(unseen.json().at("detail").get<std::string>().find(leaving), std::string::npos) << unseen.body;
  EXPECT_EQ(edit({{"kind", "merge"}, {"place", whole}, {"into", places.at(1).at("id")}}).status, 200);
}

TEST_F(EditTest, ARebuildKeepsEveryEditWithItsIds) {
  teach(4);
  const json places = graph().at("places");
  std::string large;
  std::string leaving;
  for (const json& one : places) {
    for (const json& image : one.at("members")) {
      if (!leaving.empty() || image == one.at("prototype")) continue;
      large = one.at("id");
      leaving = image;
    }
  }
  ASSERT_EQ(edit({{"kind", "split"}, {"place", large}, {"images", {leaving}}}).status, 200);
  ASSERT_EQ(edit({{"kind", "merge"}, {"place", places.at(3).at("id")}, {"into", places.at(2).at("id")}}).status, 200);
  ASSERT_EQ(edit({{"kind", "rename"}, {"place", places.at(1).at("id")}, {"label", "porch"}}).status, 200);
  const json before = state();
  const Answer begun = admin->post(root_ + "/builds");
  ASSERT_EQ(begun.status, 202) << begun.body;
  const json job = wait_for_job(begun.json().at("job").at("id"));
  EXPECT_EQ(job.at("state"), "done") << job.dump();
  EXPECT_EQ(job.dump().find("edit_lost"), std::string::npos) << job.dump();
  EXPECT_EQ(state().at("places"), before.at("places"));
  EXPECT_EQ(state().at("destinations"), before.at("destinations"));
  while (change("/undo").status == 200) {
  }
  EXPECT_EQ(state().at("places").size(), places.size());
}

}  // namespace
}  // namespace homeward::server::edit_test
