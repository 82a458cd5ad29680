// SPDX-License-Identifier: Apache-2.0
#include "wire/inspect_json.hpp"

#include <array>
#include <unordered_map>

#include "map/parts.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

json masses_to_json(const map::Masses& masses) {
  return {{"true", masses.is_true}, {"false", masses.is_false}, {"unknown", masses.unknown}};
}

json place_to_json(const map::Place& place) {
  const int features = place.appearances.empty() ? 0 : place.appearances.front().size();
  return {{"id", place.id.str()},
          {"label", place.label},
          {"prototype", place.prototype.str()},
          {"members", ids_to_json(place.members)},
          {"features", features},
          {"appearances", place.appearances.size()}};
}

json part_to_json(const map::MapPart& part) { return {{"places", ids_to_json(part.places)}, {"tours", part.tours}}; }

}  // namespace

std::string_view length_source_name(map::LengthSource source) {
  constexpr std::array<std::string_view, 4> kNames = {"unknown", "odometry", "tour_time", "tour_images"};
  return kNames[static_cast<std::size_t>(source)];
}

std::string_view decision_name(map::Decision decision) {
  constexpr std::array<std::string_view, 3> kNames = {"accepted", "rejected", "undecided"};
  return kNames[static_cast<std::size_t>(decision)];
}

json edge_to_json(const map::Edge& edge) {
  return {{"from", edge.from.str()},
          {"to", edge.to.str()},
          {"bearing_rad", or_null(edge.bearing_rad)},
          {"turn_rad", or_null(edge.turn_rad)},
          {"length_m", edge.length_m},
          {"length_from", length_source_name(edge.length_from)},
          {"confidence", edge.confidence},
          {"inliers", edge.inliers},
          {"weak", edge.weak},
          {"shortcut", edge.shortcut}};
}

std::string_view shortcut_state_name(map::ShortcutState state) {
  constexpr std::array<std::string_view, 3> kNames = {"proposed", "accepted", "rejected"};
  return kNames[static_cast<std::size_t>(state)];
}

json shortcuts_to_json(const map::TopologicalMap& map) {
  std::unordered_map<ImageId, PlaceId> place_of;
  for (const map::Place& place : map.places) {
    for (const ImageId& image : place.members) place_of.emplace(image, place.id);
  }
  json list = json::array();
  for (const map::Shortcut& shortcut : map.shortcuts) {
    list.push_back({{"image_a", shortcut.image_a.str()},
                    {"image_b", shortcut.image_b.str()},
                    {"place_a", place_of[shortcut.image_a].str()},
                    {"place_b", place_of[shortcut.image_b].str()},
                    {"bearing_rad", shortcut.bearing_rad},
                    {"turn_rad", shortcut.turn_rad},
                    {"length_m", shortcut.length_m},
                    {"way_m", shortcut.way_m},
                    {"clear_m", shortcut.clear_m},
                    {"confidence", shortcut.confidence},
                    {"inliers", shortcut.inliers},
                    {"state", shortcut_state_name(shortcut.state)},
                    {"by", shortcut.by}});
  }
  return list;
}

json hypothesis_to_json(const map::Hypothesis& hypothesis) {
  return {{"prototype_a", hypothesis.prototype_a.str()},
          {"prototype_b", hypothesis.prototype_b.str()},
          {"masses_before", masses_to_json(hypothesis.masses_before)},
          {"masses_after", masses_to_json(hypothesis.masses_after)},
          {"support", hypothesis.support},
          {"plausibility", hypothesis.plausibility},
          {"decision", decision_name(hypothesis.decision)},
          {"by", map::kDeciderNames.name(hypothesis.by)}};
}

json inspect_to_json(const map::TopologicalMap& map, std::int64_t bytes) {
  json value = {{"images", map.images.size()}, {"bytes", bytes},         {"build_seconds", map.build_seconds},
                {"places", json::array()},     {"edges", json::array()}, {"hypotheses", json::array()},
                {"components", json::array()}};
  for (const map::Place& place : map.places) value["places"].push_back(place_to_json(place));
  for (const map::Edge& edge : map.edges) value["edges"].push_back(edge_to_json(edge));
  for (const map::Hypothesis& h : map.hypotheses) value["hypotheses"].push_back(hypothesis_to_json(h));
  value["shortcuts"] = shortcuts_to_json(map);
  for (const map::MapPart& part : map::parts(map)) value["components"].push_back(part_to_json(part));
  return value;
}

}  // namespace homeward::wire
