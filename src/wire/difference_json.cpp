// SPDX-License-Identifier: Apache-2.0
#include "wire/difference_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/graph_json.hpp"
#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

template <typename Value>
const char* change_of(const std::optional<Value>& before, const std::optional<Value>& after) {
  if (!before) return "added";
  return after ? "changed" : "removed";
}

json place_of(const std::optional<map::Place>& place) {
  if (!place) return nullptr;
  return {{"label", place->label}, {"prototype", place->prototype.str()}, {"images", place->members.size()}};
}

json edge_of(const std::optional<map::Edge>& edge) {
  if (!edge) return nullptr;
  return {{"bearing_rad", edge->bearing_rad ? json(*edge->bearing_rad) : json(nullptr)},
          {"weak", edge->weak},
          {"blocked", edge->blocked},
          {"shortcut", edge->shortcut},
          {"by", map::kDeciderNames.name(edge->by)}};
}

json destination_of(const std::optional<map::Destination>& destination) {
  if (!destination) return nullptr;
  return {{"place", destination->place.str()},
          {"image", destination->image.str()},
          {"label", destination->label},
          {"pictogram", destination->pictogram}};
}

}  // namespace

json difference_to_json(const map::MapDifference& difference) {
  json value = {{"format", "homeward-difference"},
                {"version", 1},
                {"places", json::array()},
                {"edges", json::array()},
                {"destinations", json::array()},
                {"hypotheses", json::array()},
                {"parts_before", difference.parts_before},
                {"parts_after", difference.parts_after}};
  for (const map::PlaceDifference& one : difference.places) {
    value["places"].push_back({{"id", one.id.str()},
                               {"change", change_of(one.before, one.after)},
                               {"before", place_of(one.before)},
                               {"after", place_of(one.after)},
                               {"gained", ids_to_json(one.gained)},
                               {"left", ids_to_json(one.left)}});
  }
  for (const map::EdgeDifference& one : difference.edges) {
    value["edges"].push_back({{"from", one.from.str()},
                              {"to", one.to.str()},
                              {"change", change_of(one.before, one.after)},
                              {"before", edge_of(one.before)},
                              {"after", edge_of(one.after)}});
  }
  for (const map::DestinationDifference& one : difference.destinations) {
    value["destinations"].push_back({{"id", one.id.str()},
                                     {"change", change_of(one.before, one.after)},
                                     {"before", destination_of(one.before)},
                                     {"after", destination_of(one.after)}});
  }
  for (const map::DecisionDifference& one : difference.hypotheses) {
    value["hypotheses"].push_back({{"prototype_a", one.image_a.str()},
                                   {"prototype_b", one.image_b.str()},
                                   {"before", decision_name(one.before)},
                                   {"after", decision_name(one.after)}});
  }
  return value;
}

}  // namespace homeward::wire
