// SPDX-License-Identifier: Apache-2.0
#include "wire/graph_json.hpp"

#include <algorithm>
#include <cmath>

#include "map/place_names.hpp"
#include "wire/entity_tag.hpp"
#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

/// The mean of all colours, in hundredths: 0.33 to 0.75 in lit rooms, 0.12 to 0.42 by night, as cameras adapt.
double brightness(const features::Appearance& appearance) {
  const auto& moments = appearance.colour_moments;  // three of each colour, its mean first
  const double mean = (static_cast<double>(moments[0]) + moments[3] + moments[6]) / 3.0;
  return mean > 0.0 ? std::round(100.0 * std::min(mean, 1.0)) / 100.0 : 0.0;
}

json place_to_json(const map::Place& place, const std::string& name, const Eigen::Vector2d& position) {
  json value = {{"id", place.id.str()},
                {"label", place.label},
                {"name", name},
                {"prototype", place.prototype.str()},
                {"members", ids_to_json(place.members)},
                {"features", place.appearances.empty() ? 0 : place.appearances.front().size()},
                {"x", finite_or_null(position.x())},
                {"y", finite_or_null(position.y())}};
  const auto& appearances = place.appearances.entries();
  if (!appearances.empty()) value["brightness"] = brightness(*appearances.front().appearance);
  for (std::size_t i = 1; i < appearances.size(); ++i) {
    const ImageId& image = appearances[i].image;
    value["learnt"].push_back({{"image", image.empty() ? json() : json(image.str())},
                               {"brightness", brightness(*appearances[i].appearance)}});
  }
  return value;
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
  const std::vector<std::string> names = map::place_names(map);
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    value["places"].push_back(place_to_json(map.places[i], names[i], layout.at(i)));
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

std::string revision_tag(std::int64_t revision) { return entity_tag('r', revision); }

Result<std::int64_t> revision_from_tag(const std::string& tag) {
  if (const auto revision = number_in_tag('r', tag)) return *revision;
  return fail(ErrorCode::kInvalidInput, "If-Match must name a revision of the map, such as \"r12\".", "If-Match");
}

}  // namespace homeward::wire
