// SPDX-License-Identifier: Apache-2.0
#include "wire/doubt_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wire/edit_json.hpp"
#include "wire/inspect_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

bool wanted(const map::Doubt& doubt, const DoubtFilter& filter) {
  if (filter.kind && doubt.kind != *filter.kind) return false;
  if (filter.place && doubt.place_a != *filter.place && doubt.place_b != *filter.place) return false;
  const bool decided = doubt.by == map::Decider::kPerson;
  switch (filter.about) {
    case DoubtsAbout::kAsked:
      return !decided;
    case DoubtsAbout::kUndecided:
      return !decided && doubt.state == map::Decision::kUndecided;
    case DoubtsAbout::kClose:
      return !decided && doubt.state != map::Decision::kUndecided;
    case DoubtsAbout::kDecided:
      return decided;
    case DoubtsAbout::kAll:
      break;
  }
  return true;
}

/// As a person would ask for it.
EditRequest request_of(const map::Edit& edit, const map::Doubt& doubt) {
  EditRequest request;
  request.kind = edit.kind;
  request.images = edit.images;
  request.yes = edit.text == "accept" || edit.text == "true";
  const bool swapped = edit.image_a == doubt.image_b;
  request.place = swapped ? doubt.place_b : doubt.place_a;
  request.other = swapped ? doubt.place_a : doubt.place_b;
  // The log names first the place that stays.
  if (edit.kind == map::EditKind::kMerge) std::swap(request.place, request.other);
  if (edit.kind == map::EditKind::kDecide) {
    request.prototype_a = edit.image_a;
    request.prototype_b = edit.image_b;
  }
  return request;
}

json edits_of(const std::vector<map::Edit>& edits, const map::Doubt& doubt) {
  std::vector<EditRequest> requests;
  requests.reserve(edits.size());
  for (const map::Edit& edit : edits) requests.push_back(request_of(edit, doubt));
  return edits_to_json(requests).at("edits");
}

json doubt_to_json(const map::Doubt& doubt, const map::TopologicalMap& map) {
  json value = {{"kind", map::kDoubtKindNames.name(doubt.kind)},
                {"image_a", doubt.image_a.str()},
                {"image_b", doubt.image_b.str()},
                {"place_a", doubt.place_a.str()},
                {"place_b", doubt.place_b.str()},
                {"state", decision_name(doubt.state)},
                {"by", map::kDeciderNames.name(doubt.by)},
                {"set_aside_by", doubt.set_aside_by.empty() ? json(nullptr) : json(doubt.set_aside_by)},
                {"probability", doubt.probability},
                {"effect", doubt.effect},
                {"weight", doubt.weight()},
                {"masses_before", nullptr},
                {"masses_after", nullptr},
                {"support", nullptr},
                {"plausibility", nullptr},
                {"neighbours", json::array()},
                {"reasons", json::array()},
                {"if_yes", edits_of(doubt.if_yes, doubt)},
                {"if_no", edits_of(doubt.if_no, doubt)}};
  for (const map::DoubtNeighbour& one : doubt.neighbours) {
    value["neighbours"].push_back({{"place_a", one.place_a.str()},
                                   {"place_b", one.place_b.str()},
                                   {"for", one.speaks_for},
                                   {"weight", one.weight}});
  }
  if (doubt.hypothesis) {
    const json hypothesis = hypothesis_to_json(map.hypotheses.at(*doubt.hypothesis));
    for (const char* key : {"masses_before", "masses_after", "support", "plausibility"})
      value[key] = hypothesis.at(key);
  }
  return value;
}

}  // namespace

json doubts_to_json(const std::vector<map::Doubt>& doubts, const map::TopologicalMap& map, const std::string& id,
                    const DoubtFilter& filter) {
  std::vector<const map::Doubt*> chosen;
  for (const map::Doubt& doubt : doubts) {
    if (wanted(doubt, filter)) chosen.push_back(&doubt);
  }
  json page = json::array();
  const std::size_t first = std::min(filter.offset, chosen.size());
  const std::size_t count = std::min({filter.limit, kMaxDoubts, chosen.size() - first});
  for (std::size_t i = first; i < first + count; ++i) page.push_back(doubt_to_json(*chosen[i], map));
  return {{"format", "homeward-doubts"}, {"version", 1},           {"map", id},
          {"revision", map.revision},    {"total", chosen.size()}, {"offset", filter.offset},
          {"doubts", std::move(page)}};
}

}  // namespace homeward::wire
