// SPDX-License-Identifier: Apache-2.0
#include "wire/graph_export.hpp"

#include <unordered_map>

#include "core/markup.hpp"
#include "map/lookup.hpp"
#include "wire/graph_json.hpp"
#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

std::string number_text(double value) { return json(value).dump(); }

std::string data(const char* key, const std::string& text) {
  return std::string("      <data key=\"") + key + "\">" + escape_xml(text) + "</data>\n";
}

std::string graphml_keys() {
  const auto key = [](const char* name, const char* target, const char* type) {
    return std::string("  <key id=\"") + name + "\" for=\"" + target + "\" attr.name=\"" + name + "\" attr.type=\"" +
           type + "\"/>\n";
  };
  return key("label", "node", "string") + key("prototype", "node", "string") + key("images", "node", "int") +
         key("x", "node", "double") + key("y", "node", "double") + key("bearing_rad", "edge", "double") +
         key("turn_rad", "edge", "double") + key("length_m", "edge", "double") + key("length_from", "edge", "string") +
         key("confidence", "edge", "double") + key("inliers", "edge", "int") + key("weak", "edge", "boolean") +
         key("blocked", "edge", "boolean");
}

std::string graphml(const map::TopologicalMap& map, const std::vector<Eigen::Vector2d>& layout) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n" +
      graphml_keys() + "  <graph id=\"" + escape_xml(map.name) + "\" edgedefault=\"directed\">\n";
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const map::Place& place = map.places[i];
    text += "    <node id=\"" + escape_xml(place.id.str()) + "\">\n" + data("label", place.label) +
            data("prototype", place.prototype.str()) + data("images", std::to_string(place.members.size())) +
            data("x", number_text(layout.at(i).x())) + data("y", number_text(layout.at(i).y())) + "    </node>\n";
  }
  for (const map::Edge& edge : map.edges) {
    text += "    <edge source=\"" + escape_xml(edge.from.str()) + "\" target=\"" + escape_xml(edge.to.str()) + "\">\n";
    if (edge.bearing_rad) text += data("bearing_rad", number_text(*edge.bearing_rad));
    if (edge.turn_rad) text += data("turn_rad", number_text(*edge.turn_rad));
    text += data("length_m", number_text(edge.length_m)) +
            data("length_from", std::string(length_source_name(edge.length_from))) +
            data("confidence", number_text(edge.confidence)) + data("inliers", std::to_string(edge.inliers)) +
            data("weak", edge.weak ? "true" : "false") + data("blocked", edge.blocked ? "true" : "false") +
            "    </edge>\n";
  }
  return text + "  </graph>\n</graphml>\n";
}

json feature(const char* type, json coordinates, json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

json geojson(const map::TopologicalMap& map, const std::vector<Eigen::Vector2d>& layout) {
  const auto position = [&](int place) -> json {
    const Eigen::Vector2d& at = layout.at(static_cast<std::size_t>(place));
    return json::array({at.x(), 1.0 - at.y()});
  };
  json features = json::array();
  const std::unordered_map<PlaceId, int> index = map::place_indices(map);
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const map::Place& place = map.places[i];
    features.push_back(feature("Point", position(static_cast<int>(i)),
                               {{"id", place.id.str()},
                                {"label", place.label},
                                {"prototype", place.prototype.str()},
                                {"images", place.members.size()}}));
  }
  for (const map::Edge& edge : map.edges) {
    const auto ends = map::ends_of(edge, index);
    if (!ends) continue;
    json properties = edge_to_json(edge);
    properties["blocked"] = edge.blocked;
    features.push_back(feature("LineString", json::array({position(ends->from), position(ends->to)}), properties));
  }
  return {{"type", "FeatureCollection"},
          {"name", map.name},
          {"coordinates_are", "a drawing in [0,1] x [0,1], tied to no place on the Earth"},
          {"features", std::move(features)}};
}

}  // namespace

std::optional<ExportFormat> export_format(std::string_view name) {
  if (name == "json") return ExportFormat::kJson;
  if (name == "graphml") return ExportFormat::kGraphMl;
  if (name == "geojson") return ExportFormat::kGeoJson;
  return std::nullopt;
}

std::string export_graph(const map::TopologicalMap& map, const std::vector<Eigen::Vector2d>& layout,
                         ExportFormat format) {
  switch (format) {
    case ExportFormat::kGraphMl:
      return graphml(map, layout);
    case ExportFormat::kGeoJson:
      return geojson(map, layout).dump(2) + "\n";
    case ExportFormat::kJson:
      break;
  }
  return graph_to_json(map, MapId(map.name), layout).dump(2) + "\n";
}

}  // namespace homeward::wire
