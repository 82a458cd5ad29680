// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"
#include "camera/camera.hpp"
#include "fuzz/targets/require.hpp"
#include "recording/memory_json.hpp"
#include "recording/settings_json.hpp"
#include "wire/camera_json.hpp"
#include "wire/edit_json.hpp"
#include "wire/graph_json.hpp"
#include "wire/mission_json.hpp"
#include "wire/problem_json.hpp"
#include "wire/reason_json.hpp"
#include "wire/rosbridge_json.hpp"
#include "wire/scans_json.hpp"
#include "wire/scenario_json.hpp"
#include "wire/tour_json.hpp"
#include "wire/world_json.hpp"

namespace homeward::fuzz {
namespace {

using nlohmann::json;

void camera_file(const std::string& text) {
  const auto camera = wire::parse_camera(text, "camera.json");
  require_value_or_sentence(camera);
  if (!camera) return;
  require(camera::problems(*camera).empty(), "a camera that was read is one");
  require(wire::camera_from_json(wire::camera_to_json(*camera)).has_value(), "a camera is read as it is written");
}

void scans_file(const std::string& text) {
  const auto scans = wire::parse_scans(text, "scans.json");
  require_value_or_sentence(scans);
  if (scans) require(wire::scans_from_json(wire::scans_to_json(*scans)).has_value(), "scans are read as written");
}

void marks_file(const std::string& text) {
  const auto marks = wire::parse_marks(text, "tour.json");
  require_value_or_sentence(marks);
  if (marks) require(wire::marks_from_json(wire::marks_to_json(*marks)).has_value(), "marks are read as written");
}

void edits(const json& value) {
  const auto list = wire::edits_from_json(value);
  require_value_or_sentence(list);
  if (list) require(wire::edits_from_json(wire::edits_to_json(*list)).has_value(), "edits are read as written");
}

void sweep(const json& value) {
  const auto read = wire::sweep_from_json(value);
  require_value_or_sentence(read);
  if (read) require(wire::sweep_from_json(wire::sweep_to_json(*read)).has_value(), "a sweep is read as written");
}

void reason(const json& value) {
  const auto read = wire::reason_from_json(value);
  require_value_or_sentence(read);
  if (read) require(wire::reason_from_json(wire::reason_to_json(*read)).has_value(), "a reason is read as written");
}

void mission(const json& value) {
  const auto read = wire::mission_from_json(value);
  require_value_or_sentence(read);
  if (read) require(wire::mission_from_json(wire::mission_to_json(*read)).has_value(), "a mission is read as written");
}

}  // namespace

void settings_files(Input input) {
  const Choice choice = choose(input, 6);
  const std::string text = choice.text();
  switch (choice.which) {
    case 0:
      return camera_file(text);
    case 1:
      return scans_file(text);
    case 2:
      return require_value_or_sentence(wire::parse_world(text, "world.json"));
    case 3:
      return require_value_or_sentence(wire::parse_scenario(text, "scenario.json"));
    case 4:
      return require_value_or_sentence(wire::parse_rosbridge(text, "robot.json"));
    default:
      return marks_file(text);
  }
}

void request_bodies(Input input) {
  const Choice choice = choose(input, 6);
  if (choice.which == 5) return require_value_or_sentence(wire::revision_from_tag(choice.text()));
  const auto value = wire::parse_json(choice.text(), "body");
  require_value_or_sentence(value);
  if (!value) return;
  switch (choice.which) {
    case 0:
      return edits(*value);
    case 1:
      return sweep(*value);
    case 2:
      return reason(*value);
    case 3:
      return mission(*value);
    default:
      return require_value_or_sentence(wire::problem_from_json(*value));
  }
}

void addresses(Input input) {
  const std::string text(input.begin(), input.end());
  const auto server = agent::parse_address(text);
  require_value_or_sentence(server);
  if (server) require(!server->host.empty() && !server->port.empty(), "a server has a host and a port");
  const auto socket = agent::parse_websocket_address(text);
  require_value_or_sentence(socket);
  if (socket) require(socket->path.starts_with("/"), "a path begins with a slash");
}

void recorded_texts(Input input) {
  const Choice choice = choose(input, 3);
  const std::string text = choice.text();
  if (choice.which == 0) {
    const auto config = recording::driving_from_json(text);
    if (config) require(recording::driving_from_json(recording::driving_to_json(*config)).has_value(), "as written");
    return require_value_or_sentence(config);
  }
  if (choice.which == 1) return require_value_or_sentence(recording::features_from_json(text));
  const auto memory = recording::memory_from_json(text);
  if (memory) require(recording::memory_from_json(recording::memory_to_json(*memory)).has_value(), "as written");
  require_value_or_sentence(memory);
}

}  // namespace homeward::fuzz
