// SPDX-License-Identifier: Apache-2.0
#include "wire/link_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "support/sample_map.hpp"

namespace homeward::wire::link_messages_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

CompanionView companion_view() {
  CompanionView view{ExplorationId("x2"), 17, {}, {1, 2, 3}};
  view.view.t_us = 1'763'700'000'000'000;
  view.view.odometry = {1.5, -0.25, 3.0};
  view.view.odometry_moved = Pose2{-1.0, 0.5, 0.25};
  view.view.sweep = {{3.5F, 2.25F}, -1.5, 0.25, 12.0, {0.25, 0.0, 0.0}};
  view.view.driven_m = 7.5;
  view.view.explored_s = 30.25;
  return view;
}

CompanionState companion_state() {
  return {ExplorationId("x2"),
          18,
          {1.5, -0.25, 3.0},
          Eigen::Vector2d(2.5, 0.75),
          true,
          12,
          {{17, 4, {0.4, -0.1, 3.1}, true}}};
}

std::vector<AgentMessage> agent_messages() {
  AgentStatus driving;
  driving.seq = 3;
  driving.t_us = 1'763'700'000'000'000;
  driving.state = DriveState::kDriving;
  driving.mission = MissionId("m1");
  driving.epoch = 2;
  driving.path_index = 1;
  driving.speed_mps = 0.4;
  driving.home = HomeReport{-0.5, 0.75, 64};
  driving.min_range_m = 0.9;
  driving.vectors_per_s = 9.5;
  driving.arrival_probability = 0.0625;
  driving.estimate = EstimateReport{PlaceId("p5"), 0.875};
  driving.possible_places = {{PlaceId("p5"), 0.875}, {PlaceId("p8"), 0.0625}};
  driving.question = QuestionReport{2, PlaceId("p7"), "south hall", 41.5};
  driving.displaced = 2;
  driving.astray = true;
  AgentStatus stopped;
  stopped.state = DriveState::kStopped;
  stopped.reason = Reason{ReasonCode::kCameraSilent};
  const Hello hello{"homeward-agent/0.1.0", "Chair", "a1b2", homeward::testing::sample_map().camera, 0.35, 0.8};
  return {hello,
          Frame{7, 12, {0xFF, 0xD8, 0x00, 0xFF}},
          driving,
          stopped,
          Stopped{"s1", 12},
          MissionRefused{MissionId("m1"), {2, 9}, Reason{ReasonCode::kRiderSteers}},
          Frame{8, 13, {0xFF}, Pose2{1.5, -2.25, 0.5}},
          companion_view(),
          companion_state()};
}

Surroundings surroundings() {
  Surroundings around;
  around.path = {{1.5, -2.25, 0.5}, {2.5, -2.0, -3.125}};
  around.final_pose = {2.75, -2.0, 3.0};
  around.spread_m = 0.5;
  around.start_probability = 0.75;
  around.nearby = {{PlaceId("p8"), ImageId("t/8.jpg"), {-4.0, 0.25, 1.0}, {7, 7}},
                   {PlaceId("p9"), ImageId("t/9.jpg"), {}, {}}};
  around.ways = {{0, 1}, {3, 0}};
  return around;
}

std::vector<ServerMessage> server_messages() {
  MissionOrder mission;
  mission.mission = MissionId("m1");
  mission.order = {2, 9};
  mission.map = MapId("house");
  mission.revision = 4;
  mission.feature_config_id = "hw1";
  mission.valid_for_ms = 1500;
  mission.speed_limit_mps = 0.6;
  mission.label = "kitchen";
  mission.path = {{PlaceId("p1"), ImageId("t/1.jpg"), {1, 2, 3}, PathEdge{0.5, -0.25, std::nullopt, true, true}},
                  {PlaceId("p2"), ImageId("t/2.jpg"), {}, std::nullopt}};
  mission.final_image = ImageId("t/3.jpg");
  mission.final_appearance = {9, 8};
  mission.dock = true;
  MissionOrder placed = mission;
  placed.surroundings = surroundings();
  return {Welcome{"homeward-server/0.1.0", RobotId("r1"), 2, 200},
          mission,
          Permit{MissionId("m1"), {2, 10}, 1500},
          StopOrder{"s1", 2, in_words("pressed"), "anna"},
          BeliefReport{7, PlaceId("p1"), 0.9, false},
          BeliefReport{8, std::nullopt, 0.0, true},
          LinkError{"invalid_input", "'seq' is missing."},
          Answer{MissionId("m1"), 2, true},
          placed,
          Companion{ExplorationId("x1"), ExplorationId("x2")},
          companion_view(),
          companion_state(),
          RepeatOrder{MissionId("m2"), {2, 11}, MapId("house"), 4, 1500, 0.6, "kitchen", ImageId("t/3.jpg"), 9}};
}

TEST(LinkMessages, ComeBackAsTheyWere) {
  for (const AgentMessage& message : agent_messages()) {
    const auto again = decode_agent_message(encode(message));
    ASSERT_TRUE(again) << again.error().message << " at " << again.error().where;
    EXPECT_EQ(again->index(), message.index());
    EXPECT_EQ(to_json(*again), to_json(message));
  }
  for (const ServerMessage& message : server_messages()) {
    const auto again = decode_server_message(encode(message));
    ASSERT_TRUE(again) << again.error().message << " at " << again.error().where;
    EXPECT_EQ(again->index(), message.index());
    EXPECT_EQ(to_json(*again), to_json(message));
  }
}

TEST(LinkMessages, KeepEveryFieldOfAnOrderToRepeat) {
  const auto decoded = decode_server_message(encode(server_messages().back()));
  ASSERT_TRUE(decoded) << decoded.error().message;
  const auto& order = std::get<RepeatOrder>(*decoded);
  EXPECT_EQ(order.order, (Order{2, 11}));
  EXPECT_EQ(order.map, MapId("house"));
  EXPECT_EQ(order.revision, 4);
  EXPECT_EQ(order.label, "kitchen");
  EXPECT_EQ(order.image, ImageId("t/3.jpg"));
  EXPECT_EQ(order.rounds, 9);
}

TEST(LinkMessages, KeepEveryFieldOfAMission) {
  const auto decoded = decode_server_message(encode(server_messages()[1]));
  const auto& mission = std::get<MissionOrder>(*decoded);
  EXPECT_EQ(mission.order, (Order{2, 9}));
  EXPECT_EQ(mission.path[0].appearance, (std::vector<std::uint8_t>{1, 2, 3}));
  ASSERT_TRUE(mission.path[0].next);
  EXPECT_EQ(mission.path[0].next->bearing_rad, 0.5);
  EXPECT_EQ(mission.path[0].next->length_m, std::nullopt);
  EXPECT_TRUE(mission.path[0].next->weak);
  EXPECT_TRUE(mission.path[0].next->shortcut);
  EXPECT_FALSE(mission.path[1].next);
  EXPECT_EQ(mission.final_appearance, (std::vector<std::uint8_t>{9, 8}));
  EXPECT_EQ(mission.final_image.str(), "t/3.jpg");
  EXPECT_TRUE(mission.dock);
  EXPECT_FALSE(mission.surroundings);
}

void expect_same(const Pose2& pose, const Pose2& expected) {
  EXPECT_EQ(pose.x_m, expected.x_m);
  EXPECT_EQ(pose.y_m, expected.y_m);
  EXPECT_EQ(pose.theta_rad, expected.theta_rad);
}

TEST(LinkMessages, KeepEveryFieldOfTheSurroundingsOfAMission) {
  const auto decoded = decode_server_message(encode(server_messages()[8]));
  ASSERT_TRUE(decoded) << decoded.error().message << " at " << decoded.error().where;
  const auto& around = std::get<MissionOrder>(*decoded).surroundings;
  ASSERT_TRUE(around);
  const Surroundings expected = surroundings();
  ASSERT_EQ(around->path.size(), 2U);
  expect_same(around->path[0], expected.path[0]);
  expect_same(around->path[1], expected.path[1]);
  expect_same(around->final_pose, expected.final_pose);
  EXPECT_EQ(around->spread_m, 0.5);
  EXPECT_EQ(around->start_probability, 0.75);
  ASSERT_EQ(around->nearby.size(), 2U);
  EXPECT_EQ(around->nearby[0].place, PlaceId("p8"));
  EXPECT_EQ(around->nearby[0].image, ImageId("t/8.jpg"));
  expect_same(around->nearby[0].map_from_view, expected.nearby[0].map_from_view);
  EXPECT_EQ(around->nearby[0].appearance, (std::vector<std::uint8_t>{7, 7}));
  EXPECT_TRUE(around->nearby[1].appearance.empty());
  EXPECT_EQ(around->ways, expected.ways);
}

TEST(LinkMessages, RefuseSurroundingsThatDoNotFit) {
  const json mission = to_json(server_messages()[8]);
  const auto expect_refused = [&](const char* pointer, const json& wrong, const std::string& where) {
    json changed = mission;
    changed[json::json_pointer("/surroundings" + std::string(pointer))] = wrong;
    const auto refused = server_message_from_json(changed);
    ASSERT_FALSE(refused) << pointer << " " << wrong;
    EXPECT_EQ(refused.error().where, "message/surroundings" + where);
  };
  const json pose = mission["surroundings"]["final"];
  expect_refused("/path", json::array(), "/path");
  expect_refused("/path", json::array({pose}), "/path");  // one pose for two places
  expect_refused("/path", json::array({pose, pose, pose}), "/path");
  expect_refused("/path/1/x_m", 1.1e6, "/path/1/x_m");
  expect_refused("/path/0/y_m", -1.1e6, "/path/0/y_m");
  expect_refused("/final/theta_rad", 3.5, "/final/theta_rad");
  expect_refused("/final/theta_rad", std::nan(""), "/final/theta_rad");
  expect_refused("/nearby/1/pose/x_m", "far", "/nearby/1/pose/x_m");
  expect_refused("/spread_m", 0.0, "/spread_m");  // as if it were known without a doubt
  expect_refused("/start_probability", 1.5, "/start_probability");
  expect_refused("/surprise", 1, "/surprise");
  expect_refused("/final/z_m", 0.0, "/final/z_m");
  expect_refused("/path/0/z_m", 0.0, "/path/0/z_m");
  expect_refused("/nearby/0/label", "kitchen", "/nearby/0/label");
  expect_refused("/nearby/0/pose/z_m", 0.0, "/nearby/0/pose/z_m");
  expect_refused("/ways/1", json::array({0, 4}), "/ways/1");  // two views on the path, two nearby
  expect_refused("/ways/0", json::array({-1, 1}), "/ways/0");
  expect_refused("/ways/0", json::array({0}), "/ways/0");
  expect_refused("/ways/0", json::array({0, 1, 2}), "/ways/0");
  expect_refused("/ways/0", json::array({0.0, 1.0}), "/ways/0");
  expect_refused("/ways/0", "0-1", "/ways/0");
  expect_refused("/ways", std::vector<json>(8001, json::array({0, 1})), "/ways");
  expect_refused("/nearby", std::vector<json>(2001, mission["surroundings"]["nearby"][0]), "/nearby");
}

TEST(LinkMessages, EpochsGoBeforeSequenceNumbers) {
  EXPECT_LT((Order{1, 99}), (Order{2, 0}));
  EXPECT_LT((Order{2, 0}), (Order{2, 1}));
}

json without_bytes(json message) {
  message.erase("jpeg");
  message.erase("path");
  message.erase("final");
  message.erase("surroundings");
  return message;
}

/// Every key at any depth of a message, as the JSON path that errors use.
void collect_keys(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& keys) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) {
      keys.push_back(at / key);
      collect_keys(inner, at / key, keys);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect_keys(value[i], at / i, keys);
  }
}

template <class Decode>
void expect_every_field_to_be_checked(const json& message, const Decode& decode) {
  std::vector<json::json_pointer> keys;
  collect_keys(message, json::json_pointer(), keys);
  ASSERT_GE(keys.size(), 3U);
  for (const json::json_pointer& key : keys) {
    // A stop is obeyed whatever its reason says (AStopWhoseReasonCannotBeReadIsStillAStop).
    if (message["type"] == "stop" && key.to_string().starts_with("/reason")) continue;
    json wrong = message;
    wrong[key] = json::object({{"unexpected", true}});
    const auto refused = decode(wrong);
    ASSERT_FALSE(refused) << message["type"] << " took an object for " << key;
    EXPECT_THAT(refused.error().where, StartsWith("message" + key.to_string()));

    json missing = message;
    missing[key.parent_pointer()].erase(key.back());
    // Some keys of a camera may be absent, a robot need not have odometry, a map not know where its places lie, nor an
    // older server number its stops, nor an older robot say where it takes itself to be, nor a way that a tour drove
    // that it is no shortcut; nor need all ways be told.
    const auto read = decode(missing);
    if (key.to_string() == "/odometry" && read) continue;
    if (key.to_string() == "/surroundings" && read) continue;
    const bool states = key.to_string() == "/arrival_probability" || key.to_string() == "/estimate" ||
                        key.to_string() == "/question" || key.to_string() == "/displaced" ||
                        key.to_string() == "/astray" || key.to_string() == "/possible_places";
    if (states && read) continue;
    if ((key.back() == "shortcut" || key.to_string() == "/surroundings/ways") && read) continue;
    if (message["type"] == "stop" && key.to_string() == "/seq" && read) continue;
    if (key.to_string().find("/camera/") != std::string::npos && read) continue;
    ASSERT_FALSE(read) << message["type"] << " does without " << key;
    EXPECT_THAT(read.error().where, HasSubstr(key.back()));
  }
  json unknown = message;
  unknown["surprise"] = 1;
  ASSERT_FALSE(decode(unknown));
  EXPECT_EQ(decode(unknown).error().where, "message/surprise");
}

TEST(LinkMessages, NameTheFieldThatIsWrong) {
  for (const AgentMessage& message : agent_messages()) {
    expect_every_field_to_be_checked(to_json(message), agent_message_from_json);
  }
  for (const ServerMessage& message : server_messages()) {
    expect_every_field_to_be_checked(to_json(message), server_message_from_json);
  }
}

TEST(LinkMessages, RefuseNumbersThatAreNone) {
  json status = to_json(agent_messages()[2]);
  status["speed_mps"] = std::nan("");
  const auto refused = decode_agent_message(json::to_cbor(status));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "message/speed_mps");
}

TEST(LinkMessages, RefuseTextThatIsNotUtf8) {
  for (const char* wrong : {"\xFF", "caf\xE9", "\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82"}) {
    json stopped = to_json(agent_messages()[4]);
    stopped["stop_id"] = wrong;
    const auto refused = decode_agent_message(json::to_cbor(stopped));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().where, "message/stop_id");
    json unknown = to_json(agent_messages()[4]);
    unknown[wrong] = 1;
    EXPECT_NO_THROW(json(decode_agent_message(json::to_cbor(unknown)).error().message).dump());
  }
  json stopped = to_json(agent_messages()[4]);
  stopped["stop_id"] = "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\xA6\xBD";
  EXPECT_TRUE(decode_agent_message(json::to_cbor(stopped)));
}

TEST(LinkMessages, RefuseTheOtherDirection) {
  EXPECT_EQ(decode_server_message(encode(agent_messages()[0])).error().where, "message/type");
  EXPECT_EQ(decode_agent_message(encode(server_messages()[0])).error().where, "message/type");
}

TEST(LinkMessages, RefuseAnotherVersion) {
  json hello = to_json(agent_messages()[0]);
  hello["v"] = kLinkVersion + 1;
  const auto refused = agent_message_from_json(hello);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(refused.error().where, "message/v");
}

TEST(LinkMessages, ReadTheWordsOfVersionOne) {
  json stop = to_json(server_messages()[3]);
  ASSERT_EQ(stop["type"], "stop");
  stop["v"] = 1;
  stop["reason"] = "pressed";
  const auto read = server_message_from_json(stop);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(std::get<StopOrder>(*read).reason, in_words("pressed"));
  stop["reason"] = "";
  EXPECT_EQ(std::get<StopOrder>(server_message_from_json(stop).value()).reason, std::nullopt);
}

TEST(LinkMessages, RefuseReasonsThatNobodyKnows) {
  json refused = to_json(AgentMessage(MissionRefused{MissionId("m1"), {2, 9}, Reason{ReasonCode::kRiderSteers}}));
  refused["reason"] = {{"code", "the_moon_is_full"}, {"parameters", json::object()}};
  EXPECT_EQ(agent_message_from_json(refused).error().where, "message/reason/code");
  refused["reason"] = {{"code", "stopped_by"}, {"parameters", json::object()}};
  EXPECT_EQ(agent_message_from_json(refused).error().where, "message/reason/parameters/by");
  refused["reason"] = "No.";
  EXPECT_EQ(agent_message_from_json(refused).error().where, "message/reason");
  refused["reason"] = nullptr;
  EXPECT_EQ(agent_message_from_json(refused).error().where, "message/reason");
}

TEST(LinkMessages, AStopWhoseReasonCannotBeReadIsStillAStop) {
  json stop = to_json(server_messages()[3]);
  ASSERT_EQ(stop["type"], "stop");
  for (const json& reason : {json(7), json{{"code", "the_moon_is_full"}, {"parameters", json::object()}}}) {
    stop["reason"] = reason;
    const auto read = server_message_from_json(stop);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(std::get<StopOrder>(*read).reason, std::nullopt);
  }
}

TEST(LinkMessages, KeepEveryFieldOfWhatCompanionsTell) {
  const auto view = std::get<CompanionView>(decode_server_message(encode(AgentMessage(companion_view()))).value());
  EXPECT_EQ(view.exploration, ExplorationId("x2"));
  EXPECT_EQ(view.index, 17);
  EXPECT_EQ(view.appearance, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(kept_view_to_json(view.view), kept_view_to_json(companion_view().view));
  const auto state = std::get<CompanionState>(decode_server_message(encode(AgentMessage(companion_state()))).value());
  EXPECT_EQ(state.exploration, ExplorationId("x2"));
  EXPECT_EQ(state.pictures, 18);
  EXPECT_EQ(state.odometry.theta_rad, 3.0);
  EXPECT_EQ(state.target_m, Eigen::Vector2d(2.5, 0.75));
  EXPECT_TRUE(state.drives);
  EXPECT_EQ(state.has, 12);
  ASSERT_EQ(state.agreements.size(), 1U);
  EXPECT_EQ(state.agreements[0].own, 17);
  EXPECT_EQ(state.agreements[0].others, 4);
  EXPECT_EQ(state.agreements[0].own_from_others.theta_rad, 3.1);
  EXPECT_TRUE(state.agreements[0].own_looked);
}

TEST(LinkMessages, ACompanionOfVersion4HasFoundNothingOfHowTheFloorsLie) {
  json state = to_json(AgentMessage(companion_state()));
  state["v"] = 4;
  EXPECT_EQ(agent_message_from_json(state).error().where, "message/agreements") << "which it did not know";
  state.erase("agreements");
  const auto read = agent_message_from_json(state);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(std::get<CompanionState>(*read).agreements.empty());
  state["v"] = 5;
  EXPECT_EQ(agent_message_from_json(state).error().where, "message/agreements");
}

TEST(LinkMessages, AnExplorationMayBeSharedWithNoneAndACompanionDriveNowhere) {
  const ServerMessage alone = Companion{ExplorationId("x1"), std::nullopt};
  EXPECT_EQ(std::get<Companion>(decode_server_message(encode(alone)).value()).with, std::nullopt);
  CompanionState stands = companion_state();
  stands.target_m.reset();
  stands.drives = false;
  const auto read = decode_agent_message(encode(AgentMessage(stands)));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(std::get<CompanionState>(*read).target_m);
  EXPECT_FALSE(std::get<CompanionState>(*read).drives);
}

TEST(LinkMessages, RefuseOfACompanionWhatIsOutOfAllMeasure) {
  json view = to_json(AgentMessage(companion_view()));
  view["appearance"] = json::binary(std::vector<std::uint8_t>(kMostCompanionBytes + 1));
  EXPECT_EQ(decode_agent_message(json::to_cbor(view)).error().where, "message/appearance");
  view = to_json(AgentMessage(companion_view()));
  view["index"] = 100'000;
  EXPECT_EQ(decode_agent_message(json::to_cbor(view)).error().where, "message/index");
  view = to_json(AgentMessage(companion_view()));
  view["exploration"] = "";
  EXPECT_EQ(decode_agent_message(json::to_cbor(view)).error().where, "message/exploration");
  CompanionState agrees = companion_state();
  agrees.agreements.resize(kMostCompanionAgreements + 1);
  EXPECT_EQ(decode_agent_message(encode(AgentMessage(agrees))).error().where, "message/agreements");
  agrees.agreements.resize(1);
  agrees.agreements[0].own_from_others.x_m = 1e4;
  EXPECT_EQ(decode_agent_message(encode(AgentMessage(agrees))).error().where,
            "message/agreements/0/own_from_others/x_m");
  json state = to_json(AgentMessage(companion_state()));
  state["target"] = {2e5, 0.0};
  EXPECT_EQ(decode_agent_message(json::to_cbor(state)).error().where, "message/target");
  state = to_json(AgentMessage(companion_state()));
  state["odometry"]["theta_rad"] = 4.0;
  EXPECT_EQ(decode_agent_message(json::to_cbor(state)).error().where, "message/odometry/theta_rad");
}

TEST(LinkMessages, RefuseBytesThatAreNoMessage) {
  EXPECT_FALSE(decode_agent_message({}));
  EXPECT_FALSE(decode_agent_message(std::vector<std::uint8_t>{0x05}));      // a number
  EXPECT_FALSE(decode_agent_message(std::vector<std::uint8_t>(64, 0x81)));  // lists in lists, cut off
  EXPECT_FALSE(decode_agent_message(std::vector<std::uint8_t>{0x5B, 0, 0, 0, 9, 0, 0, 0, 0}));  // bytes that never come
  std::vector<std::uint8_t> longer = encode(agent_messages()[4]);
  longer.push_back(0);
  EXPECT_FALSE(decode_agent_message(longer));
  EXPECT_EQ(decode_agent_message(std::vector<std::uint8_t>(kMaxLinkMessageBytes + 1)).error().code,
            ErrorCode::kTooLarge);
}

TEST(LinkMessages, SurviveDeepNesting) {
  EXPECT_FALSE(decode_agent_message(std::vector<std::uint8_t>(2'000'000, 0x81)));
}

TEST(LinkMessages, SurviveChangedBytes) {
  std::mt19937 random(20);
  std::vector<std::vector<std::uint8_t>> originals;
  for (const AgentMessage& message : agent_messages()) originals.push_back(encode(message));
  for (const ServerMessage& message : server_messages()) originals.push_back(encode(message));
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bytes = originals[random() % originals.size()];
    const std::size_t changes = 1 + random() % 4;
    for (std::size_t k = 0; k < changes; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) bytes.resize(random() % bytes.size());
    const auto agent = decode_agent_message(bytes);
    const auto server = decode_server_message(bytes);
    EXPECT_TRUE(!agent || decode_agent_message(encode(*agent)));
    EXPECT_TRUE(!server || decode_server_message(encode(*server)));
    // What was read can be told to a browser, and so can what was wrong.
    if (agent) {
      EXPECT_NO_THROW(without_bytes(to_json(*agent)).dump());
    } else {
      EXPECT_NO_THROW(json(agent.error().message + agent.error().where).dump());
    }
    if (!agent && !server) {
      ++refused;
      EXPECT_FALSE(agent.error().message.empty());
    }
  }
  EXPECT_GT(refused, 10'000);
  EXPECT_LT(refused, 20'000) << "some changes only alter a text";
}

}  // namespace
}  // namespace homeward::wire::link_messages_test
