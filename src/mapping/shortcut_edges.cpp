// SPDX-License-Identifier: Apache-2.0
#include "mapping/shortcut_edges.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/angles.hpp"
#include "map/lookup.hpp"

namespace homeward::mapping {
namespace {

using map::Shortcut;
using map::ShortcutState;
using map::TopologicalMap;

/// Whether what was seen of a shortcut still holds of two places of the map.
bool stands(const TopologicalMap& map, const Shortcut& shortcut) {
  const map::Place* a = map::find_place_of(map, shortcut.image_a);
  const map::Place* b = map::find_place_of(map, shortcut.image_b);
  if (a == nullptr || b == nullptr) return false;
  if (shortcut.state == ShortcutState::kRejected) return true;
  if (a == b || a->prototype != shortcut.image_a || b->prototype != shortcut.image_b) return false;
  return map::find_edge(map, a->id, b->id) == nullptr && map::find_edge(map, b->id, a->id) == nullptr;
}

map::Edge edge_of(const Shortcut& shortcut, const PlaceId& from, const PlaceId& to, bool back) {
  map::Edge edge;
  edge.from = from;
  edge.to = to;
  edge.bearing_rad = back ? shortcut.back_bearing_rad : shortcut.bearing_rad;
  edge.turn_rad = back ? wrap_angle(-shortcut.turn_rad) : shortcut.turn_rad;
  edge.length_m = shortcut.length_m;
  edge.length_from = map::LengthSource::kOdometry;
  edge.confidence = shortcut.confidence;
  edge.inliers = shortcut.inliers;
  edge.by = map::Decider::kPerson;
  edge.shortcut = true;
  return edge;
}

void decide(Shortcut& shortcut, const map::Edit& edit) {
  shortcut.state = edit.text == "accept" ? ShortcutState::kAccepted : ShortcutState::kRejected;
  shortcut.by = edit.by;
}

tl::unexpected<Error> no_shortcut(const map::Edit& edit) {
  return fail(ErrorCode::kNotFound,
              "The map has no shortcut between " + edit.image_a.str() + " and " + edit.image_b.str() + ".",
              edit.image_a.str());
}

}  // namespace

Shortcut* find_shortcut(TopologicalMap& map, const ImageId& image_a, const ImageId& image_b) {
  const auto found = std::ranges::find_if(map.shortcuts, [&](const Shortcut& shortcut) {
    return (shortcut.image_a == image_a && shortcut.image_b == image_b) ||
           (shortcut.image_a == image_b && shortcut.image_b == image_a);
  });
  return found == map.shortcuts.end() ? nullptr : &*found;
}

void settle_shortcuts(TopologicalMap& map) {
  if (map.shortcuts.empty() && std::ranges::none_of(map.edges, &map::Edge::shortcut)) return;
  std::set<std::pair<PlaceId, PlaceId>> blocked;
  for (const map::Edge& edge : map.edges) {
    if (edge.shortcut && edge.blocked) blocked.emplace(edge.from, edge.to);
  }
  std::erase_if(map.edges, [](const map::Edge& edge) { return edge.shortcut; });
  std::erase_if(map.shortcuts, [&](const Shortcut& shortcut) { return !stands(map, shortcut); });
  for (const Shortcut& shortcut : map.shortcuts) {
    if (shortcut.state != ShortcutState::kAccepted) continue;
    const PlaceId a = map::find_place_of(map, shortcut.image_a)->id;
    const PlaceId b = map::find_place_of(map, shortcut.image_b)->id;
    map.edges.push_back(edge_of(shortcut, a, b, false));
    map.edges.push_back(edge_of(shortcut, b, a, true));
    for (auto edge = map.edges.end() - 2; edge != map.edges.end(); ++edge) {
      edge->blocked = blocked.contains({edge->from, edge->to});
    }
  }
}

Status decide_shortcut(TopologicalMap& map, const map::Edit& edit) {
  if (edit.text != "accept" && edit.text != "reject") {
    return fail(ErrorCode::kInvalidInput, "A shortcut can be decided with \"accept\" or \"reject\".", "decision");
  }
  Shortcut* shortcut = find_shortcut(map, edit.image_a, edit.image_b);
  if (shortcut == nullptr) return no_shortcut(edit);
  Shortcut decided = *shortcut;
  decide(decided, edit);
  // As an edge it may be there already.
  const bool was_edge = shortcut->state == ShortcutState::kAccepted;
  if (decided.state == ShortcutState::kAccepted && !was_edge && !stands(map, decided)) {
    return fail(
        ErrorCode::kConflict,
        "What the tour saw of this shortcut holds no more: its pictures are not the prototypes of two places that "
        "no way joins.",
        edit.image_a.str());
  }
  *shortcut = std::move(decided);
  settle_shortcuts(map);
  return {};
}

void forget_decisions(TopologicalMap& map, const std::vector<map::Edit>& log) {
  for (const map::Edit& edit : log) {
    if (edit.kind != map::EditKind::kDecideShortcut) continue;
    Shortcut* shortcut = find_shortcut(map, edit.image_a, edit.image_b);
    if (shortcut == nullptr) continue;
    shortcut->state = ShortcutState::kProposed;
    shortcut->by = "method";
  }
  settle_shortcuts(map);
}

void reject_shortcuts(TopologicalMap& map, const PlaceId& from, const PlaceId& to, const std::string& by) {
  for (Shortcut& shortcut : map.shortcuts) {
    if (shortcut.state != ShortcutState::kAccepted) continue;
    const map::Place* a = map::find_place_of(map, shortcut.image_a);
    const map::Place* b = map::find_place_of(map, shortcut.image_b);
    if (a == nullptr || b == nullptr || std::minmax(a->id, b->id) != std::minmax(from, to)) continue;
    shortcut.state = ShortcutState::kRejected;
    shortcut.by = by;
  }
}

}  // namespace homeward::mapping
