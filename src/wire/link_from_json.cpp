// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "wire/camera_json.hpp"
#include "wire/json_reader.hpp"
#include "wire/link_companion.hpp"
#include "wire/link_messages.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kMaxPathPlaces = 2000;
constexpr std::size_t kMostPossiblePlaces = 4;
constexpr double kFarthest_m = 1e6;  // of odometry from where it began
constexpr double kMostHeading_rad = 3.2;

std::vector<std::uint8_t> read_bytes(ObjectReader& reader, const std::string& key) {
  const json& value = reader.value(key);
  if (value.is_binary()) return value.get_binary();
  reader.problem(key, "'" + key + "' must be bytes.");
  return {};
}

Order read_order(ObjectReader& reader) { return {reader.integer("epoch", 0, kMost), reader.integer("seq", 0, kMost)}; }

std::optional<std::string> text_or_null(ObjectReader& reader, const std::string& key) {
  return reader.value(key).is_null() ? std::nullopt : std::optional(reader.text(key));
}

/// The reason of a message; words where it is of version 1, which says nothing by none.
std::optional<Reason> read_link_reason(ObjectReader& reader) {
  const json& value = reader.value("reason");
  if (value.is_null()) return std::nullopt;
  if (reader.value("v") != kOldestLinkVersion) {
    return reader.take(reason_from_json(value, reader.path_of("reason")));
  }
  std::string words = reader.text("reason");
  return words.empty() ? std::nullopt : std::optional(in_words(std::move(words)));
}

/// A stop whose reason cannot be read is still a stop.
std::optional<Reason> read_stop_reason(ObjectReader& reader) {
  const json& value = reader.value("reason");
  if (value.is_string()) {
    std::string words = reader.text("reason");
    return words.empty() ? std::nullopt : std::optional(in_words(std::move(words)));
  }
  const auto reason = reason_from_json(value);
  return reason ? std::optional(*reason) : std::nullopt;
}

/// The reason of a refusal, which must say one.
Reason read_refusal(ObjectReader& reader) {
  auto reason = read_link_reason(reader);
  if (!reason) reader.problem("reason", "'reason' must say why.");
  return reason ? std::move(*reason) : Reason{};
}

std::optional<double> number_or_null(ObjectReader& reader, const std::string& key) {
  return reader.value(key).is_null() ? std::nullopt : std::optional(reader.number(key));
}

Hello read_hello(ObjectReader& reader) {
  Hello m;
  m.agent = reader.line("agent", 100);
  m.robot_name = reader.line("robot_name", 200);
  m.session = reader.line("session", 200);
  m.camera = reader.take(camera_from_json(reader.value("camera"), reader.path_of("camera")));
  m.radius_m = reader.number("radius_m", 0.05, kMostRadius_m);
  m.max_speed_mps = reader.number("max_speed_mps", 0.0, 5.0);
  if (reader.has("explores")) m.explores = reader.boolean("explores");
  if (reader.has("repeats")) m.repeats = reader.boolean("repeats");
  return m;
}

Pose2 read_pose(ObjectReader& reader, const json& value, const std::string& path) {
  ObjectReader inner(value, path);
  const Pose2 pose{inner.number("x_m", -kFarthest_m, kFarthest_m), inner.number("y_m", -kFarthest_m, kFarthest_m),
                   inner.number("theta_rad", -kMostHeading_rad, kMostHeading_rad)};
  reader.close(inner);
  return pose;
}

std::optional<Pose2> read_odometry(ObjectReader& reader) {
  if (!reader.has("odometry")) return std::nullopt;
  return read_pose(reader, reader.value("odometry"), reader.path_of("odometry"));
}

Frame read_frame(ObjectReader& reader) {
  return {reader.integer("seq", 0, kMost), reader.integer("t_us", 0, kMost), read_bytes(reader, "jpeg"),
          read_odometry(reader)};
}

std::optional<HomeReport> read_home(ObjectReader& reader) {
  const json& value = reader.value("home");
  if (value.is_null()) return std::nullopt;
  ObjectReader inner(value, reader.path_of("home"));
  const HomeReport home{inner.number("bearing_rad", -3.2, 3.2), inner.number("confidence", 0.0, 1.0),
                        inner.integer("inliers", 0, 1'000'000)};
  if (const Status status = inner.finish(); !status) reader.take<int>(pass_on(status));
  return home;
}

EstimateReport read_estimate(ObjectReader& reader, const json& value, const std::string& path) {
  ObjectReader inner(value, path);
  EstimateReport estimate{PlaceId(inner.text("place", 100)), inner.number("probability", 0.0, 1.0)};
  reader.close(inner);
  return estimate;
}

std::vector<EstimateReport> read_possible_places(ObjectReader& reader) {
  if (!reader.has("possible_places")) return {};
  const std::vector<json> items = reader.array("possible_places", kMostPossiblePlaces);
  std::vector<EstimateReport> places;
  for (std::size_t i = 0; i < items.size(); ++i) {
    places.push_back(read_estimate(reader, items[i], reader.path_of("possible_places") + "/" + std::to_string(i)));
  }
  return places;
}

std::optional<QuestionReport> read_question(ObjectReader& reader) {
  if (!reader.has("question")) return std::nullopt;
  constexpr double kLongest_s = 3600.0;
  ObjectReader inner(reader.value("question"), reader.path_of("question"));
  QuestionReport question{inner.integer("number", 1, kMost), PlaceId(inner.text("place", 100)),
                          inner.text("label", 400), inner.number("left_s", 0.0, kLongest_s)};
  reader.close(inner);
  return question;
}

AgentStatus read_status(ObjectReader& reader) {
  AgentStatus m;
  m.seq = reader.integer("seq", 0, kMost);
  m.t_us = reader.integer("t_us", 0, kMost);
  const std::string state = reader.choice("state", {"idle", "driving", "arrived", "stopped", "failed"});
  for (int i = 0; i < 5; ++i) {
    if (state == drive_state_name(static_cast<DriveState>(i))) m.state = static_cast<DriveState>(i);
  }
  if (const auto mission = text_or_null(reader, "mission")) m.mission = MissionId(*mission);
  m.epoch = reader.integer("epoch", 0, kMost);
  m.path_index = reader.integer("path_index", 0, kMaxPathPlaces);
  m.reason = read_link_reason(reader);
  m.speed_mps = reader.number("speed_mps", -5.0, 5.0);
  m.home = read_home(reader);
  m.min_range_m = number_or_null(reader, "min_range_m");
  m.vectors_per_s = reader.number("vectors_per_s", 0.0, 1000.0);
  if (reader.has("arrival_probability")) m.arrival_probability = reader.number("arrival_probability", 0.0, 1.0);
  if (reader.has("estimate")) m.estimate = read_estimate(reader, reader.value("estimate"), reader.path_of("estimate"));
  m.possible_places = read_possible_places(reader);
  m.question = read_question(reader);
  if (reader.has("displaced")) m.displaced = reader.integer("displaced", 0, kMost);
  if (reader.has("astray")) m.astray = reader.boolean("astray");
  return m;
}

std::optional<PathEdge> read_edge(ObjectReader& outer) {
  const json& value = outer.value("next");
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, outer.path_of("next"));
  PathEdge edge;
  edge.bearing_rad = number_or_null(reader, "bearing_rad");
  edge.turn_rad = number_or_null(reader, "turn_rad");
  edge.length_m = number_or_null(reader, "length_m");
  edge.weak = reader.boolean("weak");
  if (reader.has("shortcut")) edge.shortcut = reader.boolean("shortcut");
  if (const Status status = reader.finish(); !status) outer.take<int>(pass_on(status));
  return edge;
}

std::vector<std::array<int, 2>> read_ways(ObjectReader& reader, std::size_t views) {
  std::vector<std::array<int, 2>> ways;
  const std::vector<json> items = reader.array("ways", Surroundings::kMostWays);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const json& item = items[i];
    const auto names_view = [&](const json& number) {
      return number.is_number_integer() && number >= 0 && number < views;
    };
    if (!item.is_array() || item.size() != 2 || !std::ranges::all_of(item, names_view)) {
      reader.problem("ways/" + std::to_string(i), "A way must be the numbers of two views, of path and nearby ones.");
      return {};
    }
    ways.push_back({item[0].get<int>(), item[1].get<int>()});
  }
  return ways;
}

std::optional<Surroundings> read_surroundings(ObjectReader& outer, std::size_t path_places) {
  if (!outer.has("surroundings")) return std::nullopt;
  ObjectReader reader(outer.value("surroundings"), outer.path_of("surroundings"));
  Surroundings around;
  const std::vector<json> path = reader.array("path", kMaxPathPlaces);
  for (std::size_t i = 0; i < path.size(); ++i) {
    around.path.push_back(read_pose(reader, path[i], reader.path_of("path") + "/" + std::to_string(i)));
  }
  if (path.size() != path_places)
    reader.problem("path", "'path' must have a pose for each place of the mission's path.");
  around.final_pose = read_pose(reader, reader.value("final"), reader.path_of("final"));
  around.spread_m = reader.number("spread_m", 0.01, 100.0);
  around.start_probability = reader.number("start_probability", 0.0, 1.0);
  const std::vector<json> nearby = reader.array("nearby", kMaxPathPlaces);
  for (std::size_t i = 0; i < nearby.size(); ++i) {
    ObjectReader inner(nearby[i], reader.path_of("nearby") + "/" + std::to_string(i));
    PlacedView view;
    view.place = PlaceId(inner.text("place", 100));
    view.image = ImageId(inner.text("image", 600));
    view.map_from_view = read_pose(inner, inner.value("pose"), inner.path_of("pose"));
    view.appearance = read_bytes(inner, "appearance");
    reader.close(inner);
    around.nearby.push_back(std::move(view));
  }
  if (reader.has("ways")) around.ways = read_ways(reader, around.path.size() + around.nearby.size());
  outer.close(reader);
  return around;
}

MissionOrder read_mission(ObjectReader& reader) {
  MissionOrder m;
  m.mission = MissionId(reader.text("mission", 100));
  m.order = read_order(reader);
  m.map = MapId(reader.text("map", 100));
  m.revision = reader.integer("revision", 0, kMost);
  m.feature_config_id = reader.text("feature_config_id", 200);
  m.valid_for_ms = reader.integer("valid_for_ms", 1, 60'000);
  m.speed_limit_mps = reader.number("speed_limit_mps", 0.0, 5.0);
  m.label = reader.text("label", 400);
  const std::vector<json> path = reader.array("path", kMaxPathPlaces);
  for (std::size_t i = 0; i < path.size(); ++i) {
    ObjectReader inner(path[i], reader.path_of("path") + "/" + std::to_string(i));
    PathPlace place;
    place.place = PlaceId(inner.text("place", 100));
    place.image = ImageId(inner.text("image", 600));
    place.appearance = read_bytes(inner, "appearance");
    place.next = read_edge(inner);
    if (const Status status = inner.finish(); !status) reader.take<int>(pass_on(status));
    m.path.push_back(std::move(place));
  }
  if (m.path.empty()) reader.problem("path", "'path' must name at least one place.");
  ObjectReader last(reader.value("final"), reader.path_of("final"));
  m.final_image = ImageId(last.text("image", 600));
  m.final_appearance = read_bytes(last, "appearance");
  m.dock = last.boolean("dock");
  if (const Status status = last.finish(); !status) reader.take<int>(pass_on(status));
  m.surroundings = read_surroundings(reader, m.path.size());
  return m;
}

BeliefReport read_belief(ObjectReader& reader) {
  BeliefReport m;
  m.frame_seq = reader.integer("frame_seq", 0, kMost);
  if (const auto place = text_or_null(reader, "place")) m.place = PlaceId(*place);
  m.probability = reader.number("probability", 0.0, 1.0);
  m.lost = reader.boolean("lost");
  return m;
}

/// An id that must not be empty.
std::string read_id(ObjectReader& reader, const std::string& key) {
  std::string id = reader.text(key, 100);
  if (id.empty()) reader.problem(key, "'" + key + "' must not be empty.");
  return id;
}

std::optional<double> limit_or_null(ObjectReader& reader, const std::string& key, double least, double most) {
  return reader.value(key).is_null() ? std::nullopt : std::optional(reader.number(key, least, most));
}

ExploreOrder read_explore(ObjectReader& reader) {
  ExploreOrder m;
  m.mission = MissionId(read_id(reader, "mission"));
  m.order = read_order(reader);
  m.valid_for_ms = reader.integer("valid_for_ms", 1, 60'000);
  m.speed_limit_mps = reader.number("speed_limit_mps", 0.0, 5.0);
  m.exploration = ExplorationId(read_id(reader, "exploration"));
  m.goes_on = reader.boolean("goes_on");
  m.limit_m = limit_or_null(reader, "limit_m", 1.0, 1e5);
  m.limit_s = limit_or_null(reader, "limit_s", 10.0, 1e6);
  m.back_after_s = limit_or_null(reader, "back_after_s", 10.0, 1e6);
  return m;
}

RepeatOrder read_repeat(ObjectReader& reader) {
  constexpr std::int64_t kMostRounds = 1000;
  RepeatOrder m;
  m.mission = MissionId(read_id(reader, "mission"));
  m.order = read_order(reader);
  m.map = MapId(read_id(reader, "map"));
  m.revision = reader.integer("revision", 0, kMost);
  m.valid_for_ms = reader.integer("valid_for_ms", 1, 60'000);
  m.speed_limit_mps = reader.number("speed_limit_mps", 0.0, 5.0);
  m.label = reader.text("label");
  m.image = ImageId(reader.text("image"));
  if (m.image.str().empty()) reader.problem("image", "'image' must not be empty.");
  m.rounds = reader.integer("rounds", 0, kMostRounds);
  return m;
}

Fences read_fences(ObjectReader& reader) {
  return {ExplorationId(read_id(reader, "exploration")),
          reader.take(fences_from_json(reader.value("fences"), reader.path_of("fences")))};
}

Welcome read_welcome(ObjectReader& reader) {
  Welcome m;
  m.server = reader.text("server", 100);
  m.robot = RobotId(reader.text("robot", 100));
  m.epoch = reader.integer("epoch", 0, kMost);
  m.frame_period_ms = reader.integer("frame_period_ms", 10, 60'000);
  return m;
}

/// Reads "type" and "v", then what `read` makes of the type; `read` says nothing for a type it does not know.
template <class Message, class Read>
Result<Message> read_message(const json& value, const Read& read) {
  ObjectReader reader(value, "message");
  const std::string type = reader.text("type", 40);
  const json& version = reader.value("v");
  if (version.is_number_integer() && (version < kOldestLinkVersion || version > kLinkVersion)) {
    return fail(ErrorCode::kUnsupportedFormat,
                "Version " + shown(version) + " of the link is not spoken here, only up to " +
                    std::to_string(kLinkVersion) + ".",
                "message/v");
  }
  reader.integer("v", kOldestLinkVersion, kLinkVersion);
  std::optional<Message> message = read(type, reader);
  if (!message) {
    reader.problem("type", "'" + shown(type) + "' is no type of message on this link.");
    message.emplace();
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return std::move(*message);
}

}  // namespace

Result<AgentMessage> agent_message_from_json(const json& value) {
  return read_message<AgentMessage>(value, [](const std::string& type, ObjectReader& r) -> std::optional<AgentMessage> {
    if (type == "hello") return read_hello(r);
    if (type == "frame") return read_frame(r);
    if (type == "status") return read_status(r);
    if (type == "stopped") return Stopped{r.text("stop_id", 100), r.integer("t_us", 0, kMost)};
    if (type == "mission_refused") {
      return MissionRefused{MissionId(r.text("mission", 100)), read_order(r), read_refusal(r)};
    }
    if (type == "explored") {
      return Explored{r.take(exploration_from_json(r.value("exploration"), r.path_of("exploration")))};
    }
    if (type == "companion_view") return read_companion_view(r);
    if (type == "companion_state") return read_companion_state(r);
    return std::nullopt;
  });
}

Result<ServerMessage> server_message_from_json(const json& value) {
  return read_message<ServerMessage>(
      value, [](const std::string& type, ObjectReader& r) -> std::optional<ServerMessage> {
        if (type == "welcome") return read_welcome(r);
        if (type == "mission") return read_mission(r);
        if (type == "permit") {
          return Permit{MissionId(r.text("mission", 100)), read_order(r), r.integer("valid_for_ms", 1, 60'000)};
        }
        if (type == "stop") {
          return StopOrder{r.text("stop_id", 100), r.integer("epoch", 0, kMost), read_stop_reason(r), r.text("by", 200),
                           r.has("seq") ? r.integer("seq", 0, kMost) : 0};
        }
        if (type == "belief") return read_belief(r);
        if (type == "answer") {
          return Answer{MissionId(r.text("mission", 100)), r.integer("question", 1, kMost), r.boolean("here")};
        }
        if (type == "explore") return read_explore(r);
        if (type == "repeat") return read_repeat(r);
        if (type == "fences") return read_fences(r);
        if (type == "finish") return Finish{ExplorationId(read_id(r, "exploration"))};
        if (type == "companion") return read_companion(r);
        if (type == "companion_view") return read_companion_view(r);
        if (type == "companion_state") return read_companion_state(r);
        if (type == "error") return LinkError{r.text("code", 100), r.text("message")};
        return std::nullopt;
      });
}

}  // namespace homeward::wire
