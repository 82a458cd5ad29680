// SPDX-License-Identifier: Apache-2.0
#include "wire/graph_json.hpp"

#include <charconv>

#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

json place_to_json(const map::Place& place, const Eigen::Vector2d& position) {
  return {{"id", place.id.str()},
          {"label", place.label},
          {"prototype", place.prototype.str()},
          {"members", ids_to_json(place.members)},
          {"features", place.appearances.empty() ? 0 : place.appearances.front().size()},
          {"x", finite_or_null(position.x())},
          {"y", finite_or_null(position.y())}};
}

json edge_of_graph(const map::Edge& edge) {
  json value = edge_to_json(edge);
  value["blocked"] = edge.blocked;
  value["by"] = map::kDeciderNames.name(edge.by);
  return value;
}

}  // namespace

json graph_to_json(const map::TopologicalMap& map, const MapId& id, const std::vector<Eigen::Vector2d>& layout) {
  json value = {{"format", "homeward-graph"},
                {"version", 1},
                {"map", id.str()},
                {"revision", map.revision},
                {"places", json::array()},
                {"edges", json::array()},
                {"destinations", json::array()},
                {"hypotheses", json::array()}};
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    value["places"].push_back(place_to_json(map.places[i], layout.at(i)));
  }
  for (const map::Edge& edge : map.edges) value["edges"].push_back(edge_of_graph(edge));
  for (const map::Destination& destination : map.destinations) {
    value["destinations"].push_back({{"id", destination.id.str()},
                                     {"place", destination.place.str()},
                                     {"image", destination.image.str()},
                                     {"label", destination.label},
                                     {"pictogram", destination.pictogram}});
  }
  value["shortcuts"] = shortcuts_to_json(map);
  for (const map::Hypothesis& h : map.hypotheses) value["hypotheses"].push_back(hypothesis_to_json(h));
  return value;
}

std::string revision_tag(std::int64_t revision) { return "\"r" + std::to_string(revision) + "\""; }

Result<std::int64_t> revision_from_tag(const std::string& tag) {
  std::string_view text = tag;
  if (text.starts_with("W/")) text.remove_prefix(2);  // of an answer that was compressed; the number alone decides
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::int64_t revision = 0;
  const bool starts = text.size() > 1 && text.front() == 'r';
  if (starts) {
    const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), revision);
    if (problem == std::errc{} && end == text.data() + text.size() && revision >= 0) return revision;
  }
  return fail(ErrorCode::kInvalidInput, "If-Match must name a revision of the map, such as \"r12\".", "If-Match");
}

}  // namespace homeward::wire
