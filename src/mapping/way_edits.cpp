// SPDX-License-Identifier: Apache-2.0
#include "mapping/way_edits.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "map/doubt.hpp"
#include "map/lookup.hpp"
#include "mapping/place_edits.hpp"
#include "mapping/shortcut_edges.hpp"
#include "mapping/tour_steps.hpp"

namespace homeward::mapping {
namespace {

using map::Edit;
using map::Place;
using map::TopologicalMap;

struct Ends {
  PlaceId from;
  PlaceId to;
};

Result<Ends> ends_of(const TopologicalMap& map, const Edit& edit) {
  const Place* from = map::find_place_of(map, edit.image_a);
  const Place* to = map::find_place_of(map, edit.image_b);
  if (from == nullptr) return no_place_with(edit.image_a);
  if (to == nullptr) return no_place_with(edit.image_b);
  if (from == to) return fail(ErrorCode::kInvalidInput, "Both images are in place " + from->id.str() + ".");
  return Ends{from->id, to->id};
}

Error no_edge(const Ends& ends) {
  return {ErrorCode::kNotFound, "The map has no edge from " + ends.from.str() + " to " + ends.to.str() + ".",
          ends.from.str()};
}

/// The images of the place of `image` that the tour drove through together with it.
std::vector<ImageId> run_around(const TopologicalMap& map, const Place& place, const ImageId& image) {
  const auto index = map::image_indices(map);
  const auto in_place = [&](int at) {
    if (at < 0 || at >= static_cast<int>(map.images.size())) return false;
    const ImageId& other = map.images[static_cast<std::size_t>(at)].id;
    return map::tour_name(other) == map::tour_name(image) &&
           std::ranges::find(place.members, other) != place.members.end();
  };
  int first = index.at(image);
  int last = first;
  while (in_place(first - 1)) --first;
  while (in_place(last + 1)) ++last;
  std::vector<ImageId> run;
  for (int at = first; at <= last; ++at) run.push_back(map.images[static_cast<std::size_t>(at)].id);
  return run;
}

/// The images that leave a place of which the two pictures of a hypothesis show two: the run around one of them. Those
/// that left when this was first applied, with what tours brought to their place since, leave again.
std::vector<ImageId> leaving_images(const TopologicalMap& map, const Edit& edit, const Place& place) {
  std::vector<ImageId> leaving;
  for (const ImageId& image : edit.images) {
    if (std::ranges::find(place.members, image) != place.members.end()) leaving.push_back(image);
  }
  if (!leaving.empty()) return leaving;
  leaving = run_around(map, place, edit.image_b);
  const bool holds_prototype = std::ranges::find(leaving, place.prototype) != leaving.end();
  return holds_prototype ? run_around(map, place, edit.image_a) : leaving;
}

Status part(EditScene& scene, const Place& place) {
  const Edit& edit = scene.edit();
  const std::vector<ImageId> leaving = leaving_images(scene.map(), edit, place);
  const auto leaves = [&](const ImageId& image) { return std::ranges::find(leaving, image) != leaving.end(); };
  if (leaves(edit.image_a) && leaves(edit.image_b)) {
    return fail(ErrorCode::kConflict,
                "The tour took " + edit.image_a.str() + " and " + edit.image_b.str() +
                    " one right after the other in place " + place.id.str() + ": split it where the places part.",
                place.id.str());
  }
  if (const Status parted = split_place(scene, edit.image_a, leaving); !parted) return parted;
  scene.keep_images(leaving);
  return {};
}

/// What a person says of two pictures about which the method asked nothing: no evidence but that.
map::Hypothesis own_hypothesis(const Edit& edit) {
  map::Hypothesis own;
  own.prototype_a = edit.image_a;
  own.prototype_b = edit.image_b;
  return own;
}

/// Whether another hypothesis on the places of the two pictures has that decision by a person: a build decides so those
/// of the passes that hold them.
bool decided_so(const TopologicalMap& map, const Edit& edit, map::Decision decision) {
  const auto places = [&](const ImageId& a, const ImageId& b) {
    const Place* one = map::find_place_of(map, a);
    const Place* other = map::find_place_of(map, b);
    return std::less<>()(one, other) ? std::pair(one, other) : std::pair(other, one);
  };
  const auto ends = places(edit.image_a, edit.image_b);
  return std::ranges::any_of(map.hypotheses, [&](const map::Hypothesis& h) {
    return h.by == map::Decider::kPerson && h.decision == decision && places(h.prototype_a, h.prototype_b) == ends;
  });
}

}  // namespace

Status add_edge(EditScene& scene) {
  TopologicalMap& map = scene.map();
  const auto ends = ends_of(map, scene.edit());
  if (!ends) return pass_on(ends);
  const std::size_t before = map.edges.size();
  join_both_ways(map, ends->from, ends->to, map::Decider::kPerson);
  if (map.edges.size() == before) {
    return scene.already_so({ErrorCode::kInvalidInput,
                             "The map has the way between " + ends->from.str() + " and " + ends->to.str() + " already.",
                             ends->from.str()});
  }
  for (std::size_t i = before; i < map.edges.size(); ++i) scene.see(map.edges[i]);
  return {};
}

Status remove_edge(EditScene& scene) {
  TopologicalMap& map = scene.map();
  const auto ends = ends_of(map, scene.edit());
  if (!ends) return pass_on(ends);
  const auto removed = std::erase_if(map.edges, [&](const map::Edge& edge) {
    return (edge.from == ends->from && edge.to == ends->to) || (edge.from == ends->to && edge.to == ends->from);
  });
  if (removed == 0) return scene.already_so(no_edge(*ends));
  reject_shortcuts(map, ends->from, ends->to, scene.edit().by);
  return {};
}

Status block_edge(EditScene& scene) {
  const Edit& edit = scene.edit();
  if (edit.text != "true" && edit.text != "false") {
    return fail(ErrorCode::kInvalidInput, "An edge is blocked with \"true\" or opened with \"false\".", "blocked");
  }
  const auto ends = ends_of(scene.map(), edit);
  if (!ends) return pass_on(ends);
  map::Edge* edge = map::find_edge(scene.map(), ends->from, ends->to);
  if (edge == nullptr) return tl::unexpected<Error>(no_edge(*ends));
  edge->blocked = edit.text == "true";
  return {};
}

Status decide_hypothesis(EditScene& scene) {
  TopologicalMap& map = scene.map();
  const Edit& edit = scene.edit();
  if (edit.text != "accept" && edit.text != "reject") {
    return fail(ErrorCode::kInvalidInput, "A hypothesis can be decided with \"accept\" or \"reject\".", "decision");
  }
  if (edit.image_a == edit.image_b) {
    return fail(ErrorCode::kInvalidInput, "A hypothesis is about two pictures.", edit.image_a.str());
  }
  const Place* a = map::find_place_of(map, edit.image_a);
  const Place* b = map::find_place_of(map, edit.image_b);
  if (a == nullptr) return no_place_with(edit.image_a);
  if (b == nullptr) return no_place_with(edit.image_b);
  const bool accept = edit.text == "accept";
  if (accept && a != b) {
    if (const Status merged = merge_places(scene, edit.image_a, edit.image_b); !merged) return merged;
  }
  if (!accept && a == b) {
    if (const Status parted = part(scene, *b); !parted) return parted;
  }
  const map::Decision decision = accept ? map::Decision::kAccepted : map::Decision::kRejected;
  auto decided = std::ranges::find_if(map.hypotheses, [&](const map::Hypothesis& h) {
    return (h.prototype_a == edit.image_a && h.prototype_b == edit.image_b) ||
           (h.prototype_a == edit.image_b && h.prototype_b == edit.image_a);
  });
  if (decided == map.hypotheses.end()) {
    if (decided_so(map, edit, decision)) return {};
    decided = map.hypotheses.insert(decided, own_hypothesis(edit));
  }
  decided->decision = decision;
  decided->by = map::Decider::kPerson;
  return {};
}

Status set_aside(EditScene& scene) {
  const Edit& edit = scene.edit();
  if (!map::kDoubtKindNames.find(edit.text)) {
    return fail(ErrorCode::kInvalidInput, "There is no doubt of the kind '" + edit.text + "'.", "about");
  }
  for (const ImageId& image : {edit.image_a, edit.image_b}) {
    if (map::find_place_of(scene.map(), image) == nullptr) return no_place_with(image);
  }
  return {};
}

}  // namespace homeward::mapping
